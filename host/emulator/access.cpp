#include "host/emulator/access.hpp"

#include <fmt/format.h>

namespace eyeray::engine::emulator {

void report_outside(Group& group, const Operation& o, uint32_t lane, const std::string& what) {
  const std::string& name = group.root(o).name;
  const std::string in = name.empty() ? "" : fmt::format(" in '{}'", name);
  group.report(o, lane, Fault::out_of_bounds, what + in);
}

void report_outside(Group& group, const Operation& o, uint32_t lane, uint64_t size) {
  const Source& pointer = o.from[0];
  const uint32_t offset = group.read(pointer, 0)[lane];
  if (offset == nowhere)
    return report_outside(
        group, o, lane,
        fmt::format("index {} of {}", int32_t(group.read(pointer, 1)[lane]), group.read(pointer, 2)[lane]));
  const Space space = group.root(o).space;
  const char* const unit = space == Space::own || space == Space::shared ? "number" : "byte";
  report_outside(group, o, lane, fmt::format("{} {} of {}", unit, offset, size));
}

void note(Group& group, const Operation& o, uint32_t lane, size_t byte, uint32_t size, bool writes,
          bool atomic) {
  const Root& root = group.root(o);
  Accesses* const accesses = group.accesses(root);
  if (!accesses) return;
  const Moment now = group.moment(lane);
  const uint32_t unit = accesses->unit();
  for (size_t at = byte / unit; at * unit < byte + size; ++at) {
    const std::optional<Moment> other = accesses->note(at, now, writes, atomic);
    if (!other) continue;
    group.report(o, lane, Fault::race,
                 fmt::format("two invocations access {} {} of '{}', one of them writes, and no barrier is in "
                             "between; the other is invocation {} of work group {}",
                             root.space == Space::image ? "texel" : "number",
                             at - (root.space == Space::shared ? root.at : 0), root.name, other->invocation,
                             other->group));
  }
}

}  // namespace eyeray::engine::emulator
