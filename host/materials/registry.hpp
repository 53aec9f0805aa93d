// The kinds of materials, as scene files and the manual know them.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "host/reading/table_reader.hpp"
#include "host/scene/material.hpp"

namespace eyeray::engine::materials {

// The types by which each kind declares and reads its keys.
using reading::Key, reading::KeyType, reading::TableReader;

struct MaterialType {
  std::string_view name;  // `type` in a [[material]] table, and the name of the kind's .glsl
  std::string_view manual;
  std::span<const Key> keys;  // beside `name` and `type`
  std::unique_ptr<Material> (*parse)(TableReader& table);
};

// Every kind of material, in registry order.
std::span<const MaterialType* const> types();

}  // namespace eyeray::engine::materials
