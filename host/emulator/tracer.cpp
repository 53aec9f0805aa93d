#include "host/emulator/tracer.hpp"

#include <algorithm>
#include <cstring>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/emulator/bits.hpp"
#include "host/emulator/group.hpp"
#include "host/emulator/types.hpp"

namespace eyeray::engine::emulator {
namespace {

using TracedKind = TracedValue::Kind;

constexpr size_t most_shown = 16;  // numbers of a value

// The text of a value's numbers, which `words` has from `at` on.
class ValueText {
 public:
  ValueText(const Types& types, std::span<const uint32_t> words) : types_(types), words_(words) {}

  std::string show(uint32_t id) {
    const Type& type = types_.at(id);
    if (type.members.empty() && type.count == 0) return number(type);
    std::vector<std::string> parts;
    const size_t count = std::max<size_t>(type.members.size(), type.count);
    for (size_t n = 0; n < count && at_ < words_.size(); ++n) {
      if (shown_ >= most_shown) {
        parts.push_back("…");
        break;
      }
      parts.push_back(show(type.members.empty() ? type.element : type.members[n]));
    }
    return fmt::format("({})", fmt::join(parts, ", "));
  }

 private:
  std::string number(const Type& type) {
    ++shown_;
    const uint32_t words = std::max(1u, type.number_words());
    if (at_ + words > words_.size()) return "";
    const uint32_t low = words_[at_], high = words_[at_ + words - 1];
    at_ += words;
    if (type.op == spv::OpTypeBool) return low ? "true" : "false";
    if (type.real) {
      if (type.bits == 64) return fmt::format("{}", number_of<double>(low, without_birth(high, 64)));
      const uint32_t bits = without_birth(low, type.bits);
      return fmt::format("{}", type.bits == 16 ? half_to_float(bits) : number_of<float>(bits));
    }
    const uint64_t whole = words == 2 ? uint64_t{high} << 32 | low : low;
    if (!type.is_signed) return fmt::format("{}", whole);
    return fmt::format("{}", int64_t(whole << (64 - type.bits)) >> (64 - type.bits));
  }

  const Types& types_;
  std::span<const uint32_t> words_;
  size_t at_ = 0, shown_ = 0;
};

// The part of a variable that begins at an offset and has the type `until`: ".bodies[3].mass". The offset is
// in bytes in memory with a layout, else in words.
std::string part_at(const Types& types, uint32_t id, uint32_t offset, bool bytes, uint32_t until) {
  std::string text;
  Placement in;
  while (id != until) {
    const Type& type = types.at(id);
    uint32_t step = 0;
    if (type.op == spv::OpTypeStruct) {
      const auto start = [&](uint32_t n) {
        return bytes ? type.placements[n].offset : types.words_before(type, n);
      };
      std::optional<uint32_t> found;
      for (uint32_t n = 0; n < type.members.size(); ++n)
        if (start(n) <= offset && (!found || start(n) >= start(*found))) found = n;
      if (!found) return text;
      text += type.names[*found].empty() ? fmt::format(".{}", *found) : "." + type.names[*found];
      offset -= start(*found);
      in = type.placements[*found];
      id = type.members[*found];
      continue;
    }
    const bool rows = bytes && in.row_major && in.matrix_stride > 0;
    if (type.op == spv::OpTypeMatrix)
      step = rows ? type.bits / 8 : bytes ? in.matrix_stride : types.at(type.element).words;
    else if (type.op == spv::OpTypeVector)
      step = rows ? in.matrix_stride : bytes ? type.bits / 8 : type.number_words();
    else if (type.op == spv::OpTypeArray || type.op == spv::OpTypeRuntimeArray)
      step = bytes ? type.stride : types.at(type.element).words;
    if (step == 0) return text;
    // The columns of a row-major matrix lie within its first row.
    const bool column_of_rows = rows && type.op == spv::OpTypeMatrix;
    const uint32_t index = (column_of_rows ? offset % in.matrix_stride : offset) / step;
    offset -= index * step;
    text += type.op == spv::OpTypeVector && index < 4 ? fmt::format(".{}", "xyzw"[index])
                                                      : fmt::format("[{}]", index);
    id = type.element;
  }
  return text;
}

// The block's member is named alone, as in the source, if the block has no name of its own.
std::string full_name(const Root& root, const std::string& part) {
  return root.anonymous && part.starts_with('.') ? part.substr(1) : root.name + part;
}

bool has_layout(const Root& root) {
  return root.space == Space::buffer || root.space == Space::pushed;
}

spv::Op opcode(const Operation& o) {
  return spv::Op(o.location.opcode);
}
bool is_atomic(const Operation& o) {
  return (opcode(o) >= spv::OpAtomicLoad && opcode(o) <= spv::OpAtomicXor) ||
         opcode(o) == spv::OpAtomicFAddEXT || opcode(o) == spv::OpAtomicFMinEXT ||
         opcode(o) == spv::OpAtomicFMaxEXT;
}
bool is_texel_access(const Operation& o) {
  return opcode(o) == spv::OpImageRead || opcode(o) == spv::OpImageFetch || opcode(o) == spv::OpImageWrite;
}
bool reads(const Operation& o) {
  return o.words > 0 && opcode(o) != spv::OpVariable;
}
bool writes(const Operation& o) {
  return opcode(o) == spv::OpVariable || (is_atomic(o) && opcode(o) != spv::OpAtomicLoad) || o.words == 0;
}

// The name of the variable or the part of it that the invocation accesses, and where that begins. Nothing for
// an access that is out of bounds.
struct Accessed {
  std::string name;
  std::optional<uint32_t> offset{};
};

Accessed accessed_of(Group& group, const Types& types, const Operation& o, uint32_t lane) {
  const Root& root = group.root(o);
  if (opcode(o) == spv::OpVariable) return {root.name, 0};
  const Source& at = o.from[0];
  if (is_texel_access(o)) {
    std::vector<int32_t> texel;
    for (uint32_t axis = 0; axis < at.words; ++axis) texel.push_back(int32_t(group.read(at, axis)[lane]));
    return {fmt::format("{}[{}]", root.name, fmt::join(texel, ", "))};
  }
  const uint32_t offset = group.read(at, 0)[lane];
  if (offset == nowhere)
    return {fmt::format("{}[index {} of {}]", root.name, int32_t(group.read(at, 1)[lane]),
                        group.read(at, 2)[lane])};
  if (root.space == Space::image) return {root.name, offset};  // by a pointer to a texel
  return {full_name(root, part_at(types, root.type, offset, has_layout(root), o.type)), offset};
}

// The last writer of a word of the value at an offset, if any.
std::optional<Moment> writer_of(Group& group, const Operation& o, uint32_t offset, uint32_t word) {
  const Root& root = group.root(o);
  const bool shared = root.space == Space::shared;
  if (root.space == Space::own || root.space == Space::pushed) return std::nullopt;
  const Accesses* const accesses = group.accesses(root);
  if (!accesses) return std::nullopt;
  const size_t byte = shared ? (size_t{root.at} + offset + word) * 4
                             : size_t{offset} + (o.cells.empty() ? 0 : o.cells[word].byte);
  return accesses->writer(byte / accesses->unit());
}

// True if `name` is the variable that is followed, or one of its elements or members.
bool is_part(const std::string& name, const std::string& of) {
  return name.starts_with(of) &&
         (name.size() == of.size() || name[of.size()] == '.' || name[of.size()] == '[');
}

}  // namespace

bool is_access(const Operation& o) {
  return o.execute &&
         (opcode(o) == spv::OpLoad || opcode(o) == spv::OpStore || opcode(o) == spv::OpCopyMemory ||
          opcode(o) == spv::OpVariable || is_atomic(o) || is_texel_access(o));
}

Tracer::Tracer(const Program& program, Trace& trace) : program_(program), trace_(trace) {
  for (const Function& function : program.functions)
    for (const Block& block : function.blocks)
      for (const Operation& each : block.operations) has_lines_ = has_lines_ || each.location.line > 0;
  for (const Root& root : program.roots) {
    if (!root.name.empty()) trace.names.insert(root.name);
    if (root.anonymous && root.type)
      for (const std::string& member : program.types->at(root.type).names) trace.names.insert(member);
  }
}

void Tracer::enter(const Block& block) {
  // A loop shows its lines again. The line of its head may have begun after the body, with the step.
  const std::less<> precedes;
  if (has_lines_ && block_ && !precedes(block_, &block) && !precedes(&block, line_block_)) finish();
  block_ = &block;
}

void Tracer::go_to(const Location& location) {
  if (has_lines_ && location.line == 0) return;
  const std::string& file = has_lines_ ? program_.files[location.file] : line_.file;
  if (in_line_ && has_lines_ && line_.line == location.line && line_.file == file) return;
  finish();
  in_line_ = true;
  line_block_ = block_;
  if (has_lines_)
    line_ = {.file = file, .line = location.line};
  else
    line_ = {.instruction = describe(location, program_.files)};
}

void Tracer::finish() {
  if (in_line_ && (trace_.follow.empty() || matches_)) {
    if (trace_.lines.size() < most_traced_lines)
      trace_.lines.push_back(std::move(line_));
    else
      trace_.cut = true;
  }
  line_ = {};
  in_line_ = matches_ = false;
}

void Tracer::add(TracedValue value) {
  if (in_line_) line_.values.push_back(std::move(value));
}

std::string Tracer::text_in_registers(Group& group, const Source& source, uint32_t type,
                                      uint32_t lane) const {
  std::vector<uint32_t> words;
  for (uint32_t word = 0; word < source.words; ++word) {
    if (group.unset(source, word, lane)) return "never set";
    words.push_back(group.read(source, word)[lane]);
  }
  return ValueText(*program_.types, words).show(type);
}

void Tracer::before(Group& group, const Operation& o, uint32_t lane) {
  writer_.reset();
  const Accessed accessed = accessed_of(group, *program_.types, o, lane);
  if (!reads(o) || !accessed.offset) return;
  const Moment now = group.moment(lane);
  for (uint32_t word = 0; word < o.words && !writer_; ++word)
    if (const std::optional<Moment> last = writer_of(group, o, *accessed.offset, word);
        last && (last->group != now.group || last->invocation != now.invocation))
      writer_ = group.global_id(*last);
}

void Tracer::after(Group& group, const Operation& o, uint32_t lane) {
  go_to(o.location);
  const Root& root = group.root(o);
  if (root.name.empty() && has_lines_) return;  // a temporary of the compiler
  const Accessed accessed = accessed_of(group, *program_.types, o, lane);
  const bool followed =
      !trace_.follow.empty() && (is_part(accessed.name, trace_.follow) || is_part(root.name, trace_.follow));
  matches_ = matches_ || followed;
  // A variable's value is known where it was written.
  if (reads(o) && (root.space != Space::own || followed || !has_lines_))
    add({.kind = TracedKind::read,
         .name = accessed.name,
         .value = text_in_registers(group, {.at = o.to, .words = o.words}, o.type, lane),
         .writer = writer_});
  if (writes(o)) add_write(group, o, lane, accessed.name);
}

// The value is that in memory, after the write.
void Tracer::add_write(Group& group, const Operation& o, uint32_t lane, const std::string& name) {
  const Root& root = group.root(o);
  const std::optional<uint32_t> offset = accessed_of(group, *program_.types, o, lane).offset;
  const Source value = o.from.back();
  TracedValue written{.kind = TracedKind::write, .name = name};
  std::vector<uint32_t> words;
  if (opcode(o) == spv::OpVariable || !offset || root.space == Space::own) {
    written.value = text_in_registers(group, value, o.type, lane);
  } else if (root.space == Space::shared) {
    const uint32_t count = program_.types->at(o.type).words;
    for (uint32_t word = root.at + *offset; word < root.at + *offset + count && word < group.shared().size();
         ++word) {
      words.push_back(group.shared()[word]);
      if (group.shared_unset()[word]) written.value = "never set";
    }
    if (written.value.empty()) written.value = ValueText(*program_.types, words).show(o.type);
  } else {
    const std::span<const std::byte> bytes = group.memory(root);
    const std::vector<Cell> texel(1);
    for (const Cell& cell : root.space == Space::image ? texel : o.cells) {
      const uint64_t byte = uint64_t{*offset} + cell.byte;
      if (byte + cell.size > bytes.size()) break;
      std::memcpy(&words.emplace_back(), &bytes[size_t(byte)], cell.size);
      const std::pair<uint32_t, uint64_t> at(root.at, byte);
      if (root.space == Space::image) continue;
      if (trace_.written.size() < most_written_words || trace_.written.contains(at))
        trace_.written[at] = {trace_.writes++, line_.file, line_.line};
    }
    written.value = ValueText(*program_.types, words).show(o.type);
  }
  add(std::move(written));
}

void Tracer::end(Group& group, const Block& block, uint32_t lane) {
  // A function's own end is no step. Compilers differ about its line.
  const bool last = std::ranges::any_of(program_.functions,
                                        [&](const Function& each) { return &block == &each.blocks.back(); });
  if (!(has_lines_ && last && block.end == spv::OpReturn)) go_to(block.location);
  const bool branches = block.end == spv::OpBranchConditional || block.end == spv::OpSwitch;
  if (branches || block.end == spv::OpReturnValue)
    add({.kind = branches ? TracedKind::branch : TracedKind::result,
         .value = text_in_registers(group, block.condition, block.type, lane)});
}

void Tracer::result(Group& group, const Operation& o, uint32_t lane) {
  if (!o.execute) return go_to(o.location);
  go_to(o.location);
  if (opcode(o) == spv::OpControlBarrier) add({.kind = TracedKind::barrier});
  const spv::Op kind = o.type ? program_.types->at(o.type).op : spv::OpTypeVoid;
  if (!has_lines_ && o.words > 0 && kind != spv::OpTypePointer)
    add({.kind = TracedKind::result,
         .name = fmt::format("%{}", o.location.id),
         .value = text_in_registers(group, {.at = o.to, .words = o.words}, o.type, lane)});
}

// Accesses run one invocation after the other, so that the traced one sees memory as it is at its turn.
void Group::run_traced(const Block& block) {
  Tracer& tracer = *dispatch_.tracer;
  const uint32_t lane = *traced_;
  const std::vector<uint32_t> all = active_;
  const auto turn = std::ranges::lower_bound(all, lane);
  tracer.enter(block);
  for (const Operation& each : block.operations) {
    if (!is_access(each)) {
      execute(each);
      tracer.result(*this, each, lane);
      continue;
    }
    const auto execute_for = [&](auto first, auto last) {
      active_.assign(first, last);
      if (!active_.empty()) execute(each);
    };
    execute_for(all.begin(), turn);
    tracer.before(*this, each, lane);
    execute_for(turn, turn + 1);
    tracer.after(*this, each, lane);
    execute_for(turn + 1, all.end());
    active_ = all;
  }
  tracer.end(*this, block, lane);
}

}  // namespace eyeray::engine::emulator
