#include "host/emulator/memory.hpp"

namespace eyeray::engine::emulator {

void Accesses::restart(size_t bytes, uint32_t unit) {
  unit_ = unit;
  units_.assign(bytes / unit, {});
}

bool Accesses::conflicts(const Access& access, const Moment& now, bool atomic) {
  return access.kind != none && !(atomic && access.kind == by_atomic) && !access.moment.ordered_with(now);
}

std::optional<Moment> Accesses::note(size_t at, const Moment& now, bool writes, bool atomic) {
  Unit& unit = units_[at];
  const Access access{now, atomic ? by_atomic : plain};
  std::optional<Moment> other;
  if (conflicts(unit.writer, now, atomic)) other = unit.writer.moment;
  if (writes) {
    for (const Access& reader : {unit.reader, unit.other_reader})
      if (!other && conflicts(reader, now, atomic)) other = reader.moment;
    unit.writer = access;
    return other;
  }
  const bool same = unit.reader.kind != none && unit.reader.moment.group == now.group &&
                    unit.reader.moment.invocation == now.invocation;
  if (unit.reader.kind != none && !same) unit.other_reader = unit.reader;
  unit.reader = access;
  return other;
}

std::optional<Moment> Accesses::writer(size_t at) const {
  if (at >= units_.size() || units_[at].writer.kind == none) return std::nullopt;
  return units_[at].writer.moment;
}

}  // namespace eyeray::engine::emulator
