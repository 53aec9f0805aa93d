// The kinds of lights, as scene files and the manual know them.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "host/reading/table_reader.hpp"
#include "host/scene/light.hpp"

namespace eyeray::engine::lights {

// The types with which each kind declares and reads its keys.
using reading::Key, reading::KeyType, reading::TableReader;

struct LightType {
  std::string_view name;  // the value of `type` in a [[light]] table, and the name of its .glsl
  std::string_view manual;
  std::span<const Key> keys;                            // beside `type` and `intensity`
  std::unique_ptr<Light> (*parse)(TableReader& table);  // null after an error, which is reported to the table
};

// The `type` of lights that are shapes. The loader makes these: they are no kind of Light.
inline constexpr std::string_view area_type = "area";

// Every kind of Light, in registry order.
std::span<const LightType* const> types();

}  // namespace eyeray::engine::lights
