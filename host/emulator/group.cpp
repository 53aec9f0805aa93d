#include "host/emulator/group.hpp"

#include <algorithm>

#include <fmt/ranges.h>

#include "host/core/error.hpp"
#include "host/emulator/bits.hpp"
#include "host/emulator/executes.hpp"

namespace eyeray::engine::emulator {
namespace {

constexpr uint32_t most_calls = 200;        // within each other
constexpr uint32_t most_births_each = 256;  // births of an operation with numbers of their own

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

std::array<uint32_t, 3> Group::global_id(const std::array<uint32_t, 3>& group, uint32_t lane) const {
  std::array<uint32_t, 3> id = local_id(lane);
  for (size_t axis = 0; axis < 3; ++axis) id[axis] += group[axis] * dispatch_.program.group[axis];
  return id;
}

std::array<uint32_t, 3> Group::global_id(const Moment& moment) const {
  const std::array<uint32_t, 3>& groups = dispatch_.groups;
  return global_id(
      {moment.group % groups[0], moment.group / groups[0] % groups[1], moment.group / groups[0] / groups[1]},
      moment.invocation);
}

Accesses* Group::accesses(const Root& root) {
  if (!dispatch_.work.findings) return nullptr;
  if (root.space == Space::shared) return &shared_accesses_;
  const auto found = dispatch_.accesses.find(root.at);
  return found == dispatch_.accesses.end() ? nullptr : &found->second;
}

std::span<std::byte> Group::buffer(uint32_t binding) const {
  const auto found = dispatch_.work.buffers.find(binding);
  return found == dispatch_.work.buffers.end() ? std::span<std::byte>() : found->second;
}

Image Group::image(uint32_t binding) const {
  const auto found = dispatch_.work.images.find(binding);
  if (found != dispatch_.work.images.end()) return found->second;
  const Format texels;
  const std::span<std::byte> bytes = buffer(binding);
  return {.extent = {uint32_t(bytes.size() / texels.bytes()), 1, 1}, .format = texels, .bytes = bytes};
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
  dispatch_.work.findings->add({.fault = fault,
                                .location = describe(location, dispatch_.program.files),
                                .invocation = global_id(id_, lane),
                                .detail = std::move(detail)});
}

bool Group::any_unset(const Source& source) const {
  if (source.constant) return false;
  const auto first = may_be_unset_.begin() + source.at;
  return std::any_of(first, first + source.words, [](uint8_t each) { return each != 0; });
}

void Group::spread_unset(const Operation& operation, uint32_t components) {
  const Source result{.at = operation.to, .words = operation.words};
  const auto any = [&](const Source& source) { return any_unset(source); };
  if (!any(result) && std::ranges::none_of(operation.from, any)) return;
  const uint32_t result_words = operation.words / components;
  for (uint32_t component = 0; component < components; ++component)
    each([&](uint32_t lane) {
      bool is_unset = false;
      for (const Source& source : operation.from) {
        const bool same = source.words % components == 0;
        const uint32_t words = same ? source.words / components : source.words;
        const uint32_t first = same ? component * words : 0;
        for (uint32_t word = first; word < first + words; ++word)
          is_unset = is_unset || unset(source, word, lane);
      }
      for (uint32_t word = 0; word < result_words; ++word)
        set_unset(operation.to + component * result_words + word, lane, is_unset);
    });
}

void Group::needs_set(const Operation& operation, const Source& source, const char* as) {
  if (!any_unset(source)) return;
  for (const uint32_t lane : active_)
    for (uint32_t word = 0; word < source.words; ++word)
      if (unset(source, word, lane)) report(operation, lane, Fault::uninitialised, as);
}

uint32_t Group::birth(const Operation& operation, std::vector<double> operands) {
  auto& [count, last] = births_of_[&operation];
  if (count > most_births_each) return last;
  if (births_.size() == most_births) return 0;
  // Births that share a number have no operands.
  if (count++ == most_births_each) operands.clear();
  births_.push_back({&operation, std::move(operands)});
  return last = uint32_t(births_.size());
}

void Group::report_birth(const Operation& operation, uint32_t lane, uint32_t number) {
  if (number > births_.size()) return;
  const Birth& birth = births_[number - 1];
  const std::string of =
      birth.operands.empty() ? "" : fmt::format("{} give ", fmt::join(birth.operands, " and "));
  report(birth.operation->location, lane, Fault::not_a_number,
         fmt::format("{}NaN, which reaches '{}' at {}", of, root(operation).name,
                     describe(operation.location, dispatch_.program.files)));
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
        for (uint32_t axis = 0; axis < 3; ++axis) set(axis, lane, global_id(id, lane)[axis]);
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
      case spv::BuiltInSubgroupEqMask:
      case spv::BuiltInSubgroupGeMask:
      case spv::BuiltInSubgroupGtMask:
      case spv::BuiltInSubgroupLeMask:
      case spv::BuiltInSubgroupLtMask: {
        const uint64_t all = size == 64 ? UINT64_MAX : (uint64_t{1} << size) - 1;
        const uint64_t self = uint64_t{1} << lane % size, below = self - 1;
        const uint64_t mask = built_in.kind == spv::BuiltInSubgroupEqMask   ? self
                              : built_in.kind == spv::BuiltInSubgroupGeMask ? all & ~below
                              : built_in.kind == spv::BuiltInSubgroupGtMask ? all & ~below & ~self
                              : built_in.kind == spv::BuiltInSubgroupLeMask ? below | self
                                                                            : below;
        for (uint32_t word = 0; word < 4; ++word)
          set(word, lane, word < 2 ? uint32_t(mask >> (32 * word)) : 0);
        break;
      }
      default:
        throw Error(ExitCode::bad_input, "the emulator does not have the built-in variable {}",
                    int(built_in.kind));
    }
  }
}

void Group::start(const std::array<uint32_t, 3>& id) {
  check_effort(may_be_unset_.size() + shared_.size(),
               dispatch_.program.functions[dispatch_.program.entry].blocks[0].location);
  id_ = id;
  number_ = (id[2] * dispatch_.groups[1] + id[1]) * dispatch_.groups[0] + id[0];
  after_group_ = ++dispatch_.barriers;
  after_subgroup_.assign((lanes_ + subgroup_size() - 1) / subgroup_size(), after_group_);
  active_ = all_;
  births_.clear();
  births_of_.clear();
  std::ranges::fill(may_be_unset_, uint8_t{0});
  std::ranges::fill(shared_, 0u);
  std::ranges::fill(shared_unset_, uint8_t{1});
  if (dispatch_.work.findings) shared_accesses_.restart(shared_.size() * 4, 4);
  for (const auto& [at, words] : dispatch_.program.privates) forget(at, words, all_);
  for (const BuiltIn& each : dispatch_.program.built_ins) set_built_in(each, id);
  for (const Operation& each : dispatch_.program.prelude) each.execute(*this, each);
}

void Group::run(const std::array<uint32_t, 3>& id) {
  start(id);
  traced_.reset();
  if (dispatch_.tracer)
    for (const uint32_t lane : all_)
      if (global_id(id, lane) == dispatch_.tracer->invocation()) traced_ = lane;
  run_function(dispatch_.program.functions[dispatch_.program.entry], all_);
  if (traced_) dispatch_.tracer->finish();
}

void Group::check_effort(uint64_t operations, const Location& location) {
  const uint64_t before = dispatch_.operations;
  dispatch_.operations += operations;
  if (!dispatch_.work.watch || before / watched_operations == dispatch_.operations / watched_operations)
    return;
  try {
    dispatch_.work.watch(dispatch_.operations);
  } catch (const Error& error) {
    if (error.code() != ExitCode::timed_out) throw;
    throw Error(ExitCode::timed_out, "{}; kernel '{}' was at {}", error.what(), dispatch_.name,
                describe(location, dispatch_.program.files));
  }
}

void Group::run_function(const Function& function, std::vector<uint32_t> lanes) {
  for (const auto& [at, words] : function.variables) forget(at, words, lanes);
  // Invocations that wait at each block. The first block with any runs next.
  std::vector<std::vector<uint32_t>> waiting(function.blocks.size());
  waiting[0] = std::move(lanes);
  const auto send = [&](const Way& way, std::vector<uint32_t>& some) {
    if (some.empty()) return;
    if (!way.moves.empty()) go(way, some);
    std::vector<uint32_t>& there = waiting[way.block];
    if (there.empty())
      there.swap(some);
    else
      there.insert(there.end(), some.begin(), some.end());
  };
  std::vector<std::vector<uint32_t>> ways;
  for (uint32_t at = 0; at < waiting.size();) {
    if (waiting[at].empty()) {
      ++at;
      continue;
    }
    active_.swap(waiting[at]);
    waiting[at].clear();
    if (!std::ranges::is_sorted(active_)) std::ranges::sort(active_);
    const Block& block = function.blocks[at];
    run_block(block);
    if (block.ways.empty()) {
      leave(function, block);
      continue;
    }
    uint32_t next = at + 1;
    for (const Way& way : block.ways) next = std::min(next, way.block);
    if (block.ways.size() == 1) {
      send(block.ways[0], active_);
    } else {
      choose(block, ways);
      for (size_t way = 0; way < block.ways.size(); ++way) send(block.ways[way], ways[way]);
    }
    at = next;
  }
}

// Returns from a function, or comes to code that cannot be reached.
void Group::leave(const Function& function, const Block& block) {
  if (block.end == spv::OpReturnValue) copy(*this, function.result, block.condition);
  if (block.end == spv::OpUnreachable)
    for (const uint32_t lane : active_)
      report(block.location, lane, Fault::unreachable, "an invocation comes here");
}

// The active invocations that take each way.
void Group::choose(const Block& block, std::vector<std::vector<uint32_t>>& ways) {
  ways.resize(block.ways.size());
  for (std::vector<uint32_t>& each : ways) each.clear();
  const Row condition = read(block.condition, 0);
  const bool marked = any_unset(block.condition);
  for (const uint32_t lane : active_) {
    if (marked && unset(block.condition, 0, lane))
      report(block.location, lane, Fault::uninitialised, "a branch depends on a value that was never set");
    size_t way = condition[lane] ? 0 : 1;
    if (block.end == spv::OpSwitch) {
      const auto found = std::ranges::find(block.cases, condition[lane]);
      way = found == block.cases.end() ? 0 : size_t(found - block.cases.begin()) + 1;
    }
    ways[way].push_back(lane);
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
  check_effort(block.effort * active_.size(), block.location);
  if (traced_ && std::ranges::binary_search(active_, *traced_)) return run_traced(block);
  for (const Operation& each : block.operations) execute(each);
}

void Group::call(const Operation& operation) {
  const Function& function = dispatch_.program.functions[operation.literals[0]];
  for (size_t n = 0; n < function.parameters.size(); ++n) {
    if (function.roots[n] != no_root) roots_[function.roots[n]] = roots_[operation.literals[n + 1]];
    copy(*this, function.parameters[n], operation.from[n]);
  }
  if (++depth_ > most_calls)
    throw Error(ExitCode::bad_input, "kernel '{}' calls functions that call others, more than {} deep",
                dispatch_.name, most_calls);
  const std::vector<uint32_t> caller = active_;
  run_function(function, caller);
  --depth_;
  active_ = caller;
  copy(*this, operation.to, {.at = function.result, .words = operation.words});
}

Kernel::Kernel(std::span<const uint32_t> spirv, std::string name)
    : name_(std::move(name)), program_(std::make_unique<const Program>(lower(spirv))) {}

Kernel::~Kernel() = default;

void Kernel::run(const Work& work, const std::array<uint32_t, 3>& groups) const {
  Findings findings;
  Work watched = work;
  if (work.findings) watched.findings = &findings;
  Dispatch dispatch{.name = name_, .program = *program_, .work = watched, .groups = groups, .accesses = {}};
  std::optional<Tracer> tracer;
  if (work.trace) dispatch.tracer = &tracer.emplace(*program_, *work.trace);
  for (const auto& [binding, image] : work.images)
    if (image.bytes.size() / image.format.bytes() / std::max(1u, image.extent[0]) /
            std::max(1u, image.extent[1]) <
        image.extent[2])
      throw Error(ExitCode::bad_input, "the image at binding {} has too few bytes for its texels", binding);
  for (const auto& [binding, use] : program_->uses) {
    if (!use.writes || !work.findings) continue;
    if (const auto image = work.images.find(binding); image != work.images.end())
      dispatch.accesses[binding].restart(image->second.bytes.size(), image->second.format.bytes());
    else if (const auto buffer = work.buffers.find(binding); buffer != work.buffers.end())
      dispatch.accesses[binding].restart(buffer->second.size(), use.unit);
  }
  if (groups[0] > 0 && groups[1] > 0 && groups[2] > 0) {
    Group group(dispatch);
    const auto at = [&](uint32_t n, size_t axis) {
      return work.order == Order::ascending ? n : groups[axis] - 1 - n;
    };
    for (uint32_t z = 0; z < groups[2]; ++z)
      for (uint32_t y = 0; y < groups[1]; ++y)
        for (uint32_t x = 0; x < groups[0]; ++x) group.run({at(x, 0), at(y, 1), at(z, 2)});
  }
  for (Finding each : findings.all()) {
    each.kernel = name_;
    work.findings->add(std::move(each));
  }
}

}  // namespace eyeray::engine::emulator
