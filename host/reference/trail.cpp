#include "host/reference/trail.hpp"

#include <fmt/format.h>

namespace eyeray::engine::reference {

uint32_t trail_of(std::span<const uint32_t> events) {
  uint32_t trail = 1;
  for (const uint32_t event : events) trail = with_event(trail, event);
  return trail;
}

std::string describe_event(uint32_t event) {
  const uint32_t value = event & 0x0fffffff;
  switch (Event(event >> 28)) {
    case Event::hit:
      if (value == in_medium) return "is scattered by a medium";
      return value == 0 ? "hits nothing" : fmt::format("hits primitive {}", value - 1);
    case Event::light: {
      if (value == 0) return "samples no light";
      const std::string light = value / 2 == 1 ? "the environment" : fmt::format("light {}", value / 2 - 2);
      return light + (value % 2 == 1 ? " is seen" : " is hidden");
    }
    case Event::way: {
      if (value == 0) return "ends";
      if (value == way_in_medium + 1) return "continues through the medium";
      return fmt::format("continues by lobe {}{}", (value & ~through) - 1,
                         value & through ? ", through" : "");
    }
    case Event::aim:
      return fmt::format("aims at {} of {} targets", value % 32, value / 32);
  }
  return "has an unknown event";
}

}  // namespace eyeray::engine::reference
