#include "host/emulator/group.hpp"

#include <algorithm>

#include "host/core/error.hpp"

namespace eyeray::engine::emulator {
namespace {

constexpr uint64_t watched_operations =
    1 << 22;  // operations of single invocations between two calls of Work::watch

}  // namespace

Group::Group(Dispatch& dispatch)
    : dispatch_(dispatch),
      lanes_(dispatch.program.invocations()),
      registers_(size_t{dispatch.program.registers} * lanes_),
      unset_(registers_.size()),
      may_be_unset_(dispatch.program.registers),
      shared_(dispatch.program.shared),
      shared_unset_(dispatch.program.shared),
      roots_(dispatch.program.roots) {
  for (uint32_t lane = 0; lane < lanes_; ++lane) all_.push_back(lane);
}

std::array<uint32_t, 3> Group::local_id(uint32_t lane) const {
  const std::array<uint32_t, 3>& size = dispatch_.program.group;
  return {lane % size[0], lane / size[0] % size[1], lane / size[0] / size[1]};
}

Accesses* Group::accesses(uint32_t binding) {
  const auto found = dispatch_.accesses.find(binding);
  return found == dispatch_.accesses.end() ? nullptr : &found->second;
}

std::span<std::byte> Group::buffer(uint32_t binding) const {
  const auto found = dispatch_.work.buffers.find(binding);
  return found == dispatch_.work.buffers.end() ? std::span<std::byte>() : found->second;
}

Moment Group::moment(uint32_t lane) const {
  const uint32_t subgroup = lane / subgroup_size();
  return {number_, subgroup, lane, after_group_, after_subgroup_[subgroup]};
}

void Group::pass_barrier(bool of_group) {
  ++dispatch_.barriers;
  if (of_group) after_group_ = dispatch_.barriers;
  for (const uint32_t lane : active_) after_subgroup_[lane / subgroup_size()] = dispatch_.barriers;
}

void Group::report(const Location& location, uint32_t lane, Fault fault, std::string detail) {
  if (!dispatch_.work.findings) return;
  std::array<uint32_t, 3> invocation = local_id(lane);
  for (size_t axis = 0; axis < 3; ++axis) invocation[axis] += id_[axis] * dispatch_.program.group[axis];
  dispatch_.work.findings->add({.fault = fault,
                                .location = describe(location, dispatch_.program.files),
                                .invocation = invocation,
                                .detail = std::move(detail)});
}

bool Group::any_unset(const Source& source) const {
  if (source.constant) return false;
  const auto first = may_be_unset_.begin() + source.at;
  return std::any_of(first, first + source.words, [](uint8_t each) { return each != 0; });
}

void Group::spread_unset(const Operation& operation) {
  const Source result{.at = operation.to, .words = operation.words};
  const auto any = [&](const Source& source) { return any_unset(source); };
  if (!any(result) && std::ranges::none_of(operation.from, any)) return;
  // A component depends on the same component of operands of the same size, and on all of other operands.
  for (uint32_t word = 0; word < operation.words; ++word)
    each([&](uint32_t lane) {
      bool is_unset = false;
      for (const Source& source : operation.from) {
        if (source.words == operation.words) {
          is_unset = is_unset || unset(source, word, lane);
        } else {
          for (uint32_t other = 0; other < source.words; ++other)
            is_unset = is_unset || unset(source, other, lane);
        }
      }
      set_unset(operation.to + word, lane, is_unset);
    });
}

void Group::needs_set(const Operation& operation, const Source& source, const char* as) {
  if (!any_unset(source)) return;
  for (const uint32_t lane : active_)
    for (uint32_t word = 0; word < source.words; ++word)
      if (unset(source, word, lane)) report(operation, lane, Fault::uninitialised, as);
}

void Group::forget(uint32_t at, uint32_t words, std::span<const uint32_t> lanes) {
  for (uint32_t word = at; word < at + words; ++word)
    for (const uint32_t lane : lanes) set_unset(word, lane, true);
}

void Group::set_built_in(const BuiltIn& built_in, const std::array<uint32_t, 3>& id) {
  const auto set = [&](uint32_t word, uint32_t lane, uint32_t value) {
    row(built_in.at + word)[lane] = value;
  };
  const uint32_t size = subgroup_size();
  for (uint32_t lane = 0; lane < lanes_; ++lane) {
    const std::array<uint32_t, 3> local = local_id(lane);
    switch (built_in.kind) {
      case spv::BuiltInNumWorkgroups:
        for (uint32_t axis = 0; axis < 3; ++axis) set(axis, lane, dispatch_.groups[axis]);
        break;
      case spv::BuiltInWorkgroupId:
        for (uint32_t axis = 0; axis < 3; ++axis) set(axis, lane, id[axis]);
        break;
      case spv::BuiltInLocalInvocationId:
        for (uint32_t axis = 0; axis < 3; ++axis) set(axis, lane, local[axis]);
        break;
      case spv::BuiltInGlobalInvocationId:
        for (uint32_t axis = 0; axis < 3; ++axis)
          set(axis, lane, id[axis] * dispatch_.program.group[axis] + local[axis]);
        break;
      case spv::BuiltInLocalInvocationIndex:
        set(0, lane, lane);
        break;
      case spv::BuiltInSubgroupSize:
        set(0, lane, size);
        break;
      case spv::BuiltInNumSubgroups:
        set(0, lane, (lanes_ + size - 1) / size);
        break;
      case spv::BuiltInSubgroupId:
        set(0, lane, lane / size);
        break;
      case spv::BuiltInSubgroupLocalInvocationId:
        set(0, lane, lane % size);
        break;
      default:
        throw Error(ExitCode::bad_input, "the emulator does not have the built-in variable {}",
                    int(built_in.kind));
    }
  }
}

void Group::start(const std::array<uint32_t, 3>& id) {
  id_ = id;
  number_ = (id[2] * dispatch_.groups[1] + id[1]) * dispatch_.groups[0] + id[0];
  after_group_ = ++dispatch_.barriers;
  after_subgroup_.assign((lanes_ + subgroup_size() - 1) / subgroup_size(), after_group_);
  active_ = all_;
  std::ranges::fill(may_be_unset_, uint8_t{0});
  std::ranges::fill(shared_, 0u);
  std::ranges::fill(shared_unset_, uint8_t{1});
  shared_accesses_.restart(shared_.size());
  for (const auto& [at, words] : dispatch_.program.privates) forget(at, words, all_);
  for (const BuiltIn& each : dispatch_.program.built_ins) set_built_in(each, id);
  for (const Operation& each : dispatch_.program.prelude) each.execute(*this, each);
}

void Group::run(const std::array<uint32_t, 3>& id) {
  start(id);
  run_function(dispatch_.program.functions[dispatch_.program.entry], all_);
}

void Group::check_effort(size_t operations) {
  const uint64_t before = dispatch_.operations;
  dispatch_.operations += operations;
  if (dispatch_.work.watch && before / watched_operations != dispatch_.operations / watched_operations)
    dispatch_.work.watch(dispatch_.operations);
}

void Group::run_function(const Function& function, std::vector<uint32_t> lanes) {
  for (const auto& [at, words] : function.variables) forget(at, words, lanes);
  // Invocations that wait at each block. The first block with any runs next.
  std::vector<std::vector<uint32_t>> waiting(function.blocks.size());
  waiting[0] = std::move(lanes);
  const auto send = [&](const Way& way, std::vector<uint32_t>& some) {
    if (some.empty()) return;
    go(way, some);
    std::vector<uint32_t>& there = waiting[way.block];
    there.insert(there.end(), some.begin(), some.end());
  };
  for (uint32_t at = 0; at < waiting.size();) {
    if (waiting[at].empty()) {
      ++at;
      continue;
    }
    active_ = std::move(waiting[at]);
    waiting[at].clear();
    std::ranges::sort(active_);
    const Block& block = function.blocks[at];
    run_block(block);
    std::vector<uint32_t> here = active_;
    if (block.end == spv::OpReturnValue)
      for (uint32_t word = 0; word < block.condition.words; ++word)
        for (const uint32_t lane : here) {
          row(function.result + word)[lane] = read(block.condition, word)[lane];
          set_unset(function.result + word, lane, unset(block.condition, word, lane));
        }
    if (block.end == spv::OpUnreachable)
      for (const uint32_t lane : here)
        report(block.location, lane, Fault::unreachable, "an invocation comes here");
    if (block.ways.empty()) continue;

    std::vector<std::vector<uint32_t>> ways(block.ways.size());
    const bool decides = block.end != spv::OpBranch;
    for (const uint32_t lane : here) {
      size_t way = 0;
      if (decides) {
        if (unset(block.condition, 0, lane))
          report(block.location, lane, Fault::uninitialised,
                 "a branch depends on a value that was never set");
        const uint32_t value = read(block.condition, 0)[lane];
        if (block.end == spv::OpBranchConditional) {
          way = value ? 0 : 1;
        } else {
          const auto found = std::ranges::find(block.cases, value);
          way = found == block.cases.end() ? 0 : size_t(found - block.cases.begin()) + 1;
        }
      }
      ways[way].push_back(lane);
    }
    uint32_t next = at + 1;
    for (size_t way = 0; way < ways.size(); ++way) {
      if (ways[way].empty()) continue;
      send(block.ways[way], ways[way]);
      next = std::min(next, block.ways[way].block);
    }
    at = next;
  }
}

// Copies the values of phis, all of an invocation at once, since they may name each other.
void Group::go(const Way& way, std::span<const uint32_t> lanes) {
  for (const uint32_t lane : lanes) {
    moved_.clear();
    for (const Move& move : way.moves)
      for (uint32_t word = 0; word < move.from.words; ++word) {
        moved_.push_back(read(move.from, word)[lane]);
        moved_.push_back(unset(move.from, word, lane));
      }
    size_t next = 0;
    for (const Move& move : way.moves)
      for (uint32_t word = 0; word < move.from.words; ++word) {
        row(move.to + word)[lane] = moved_[next++];
        set_unset(move.to + word, lane, moved_[next++] != 0);
      }
  }
}

void Group::run_block(const Block& block) {
  check_effort((block.operations.size() + 1) * active_.size());
  for (const Operation& each : block.operations) {
    if (each.execute)
      each.execute(*this, each);
    else
      call(each);
  }
}

void Group::call(const Operation& operation) {
  const Function& function = dispatch_.program.functions[operation.literals[0]];
  for (size_t n = 0; n < function.parameters.size(); ++n) {
    const Source& argument = operation.from[n];
    if (function.roots[n] != no_root) roots_[function.roots[n]] = roots_[operation.literals[n + 1]];
    for (uint32_t word = 0; word < argument.words; ++word) {
      const Row from = read(argument, word);
      uint32_t* to = row(function.parameters[n] + word);
      each([&](uint32_t lane) {
        to[lane] = from[lane];
        set_unset(function.parameters[n] + word, lane, unset(argument, word, lane));
      });
    }
  }
  const std::vector<uint32_t> caller = active_;
  run_function(function, caller);
  active_ = caller;
  for (uint32_t word = 0; word < operation.words; ++word) {
    const uint32_t* from = row(function.result + word);
    uint32_t* to = row(operation.to + word);
    each([&](uint32_t lane) {
      to[lane] = from[lane];
      set_unset(operation.to + word, lane,
                unset({.at = function.result, .words = operation.words}, word, lane));
    });
  }
}

Kernel::Kernel(std::span<const uint32_t> spirv, std::string name)
    : name_(std::move(name)), program_(std::make_unique<const Program>(lower(spirv))) {}

Kernel::~Kernel() = default;

void Kernel::run(const Work& work, const std::array<uint32_t, 3>& groups) const {
  Findings findings;
  Work watched = work;
  if (work.findings) watched.findings = &findings;
  Dispatch dispatch{.program = *program_, .work = watched, .groups = groups, .accesses = {}};
  for (const uint32_t binding : program_->written)
    if (const auto buffer = work.buffers.find(binding); buffer != work.buffers.end())
      dispatch.accesses[binding].restart(buffer->second.size() / 4);
  if (uint64_t{groups[0]} * groups[1] * groups[2] > 0) {
    Group group(dispatch);
    for (uint32_t z = 0; z < groups[2]; ++z)
      for (uint32_t y = 0; y < groups[1]; ++y)
        for (uint32_t x = 0; x < groups[0]; ++x) group.run({x, y, z});
  }
  for (Finding each : findings.all()) {
    each.kernel = name_;
    work.findings->add(std::move(each));
  }
}

}  // namespace eyeray::engine::emulator
