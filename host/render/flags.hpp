// The meaning of samples' flags, for people.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "host/core/pixel.hpp"

namespace eyeray::engine::render {

struct FlagText {
  SampleFlag flag;
  std::string_view name;
  std::string_view text;
};

std::span<const FlagText> flag_texts();

// "3 pixels may be wrong: …", where `flags` are those of all `pixels` together; "" if there are none.
std::string flag_warning(uint32_t flags, uint64_t pixels);

}  // namespace eyeray::engine::render
