// The kinds of lights, as scene files and the manual know them.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "host/reading/table_reader.hpp"
#include "host/scene/light.hpp"

namespace eyeray::engine::lights {

// The words that each kind declares its keys with, and reads them.
using reading::Key, reading::KeyType, reading::TableReader;

struct LightType {
  std::string_view name;  // `type` in a [[light]] table, and its .glsl
  std::string_view manual;
  std::span<const Key> keys;                            // beside `type` and `intensity`
  std::unique_ptr<Light> (*parse)(TableReader& table);  // null after an error, which is reported to the table
};

// The `type` of lights that are shapes. The loader makes these: they are no kind of Light.
inline constexpr std::string_view area_type = "area";

// Every kind of Light, in registry order.
std::span<const LightType* const> types();

}  // namespace eyeray::engine::lights
