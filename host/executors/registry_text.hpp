// The rows of the shaders' registries, and the registries of one scene as GLSL, with only the rows that the
// scene uses.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "host/records/records.hpp"

namespace eyeray::engine::executors {

struct Row {
  std::string_view name;
  uint32_t number;
  std::string_view traits = "";  // the text of the row's traits
};
// The rows of each registry, in its order.
namespace rows {

#define ROW(name, number, ...) {#name, number, #__VA_ARGS__},
inline constexpr Row shapes[] = {SHAPES(ROW)};
inline constexpr Row immediate_leaves[] = {IMMEDIATE_LEAVES(ROW)};
inline constexpr Row deferred_leaves[] = {DEFERRED_LEAVES(ROW)};
inline constexpr Row deferred_shapes[] = {DEFERRED_SHAPES(ROW)};
inline constexpr Row textures[] = {TEXTURES(ROW)};
inline constexpr Row lobes[] = {LOBES(ROW)};
inline constexpr Row materials[] = {MATERIALS(ROW)};
inline constexpr Row panes[] = {PANES(ROW)};
inline constexpr Row cameras[] = {CAMERAS(ROW)};
inline constexpr Row lights[] = {LIGHTS(ROW)};
inline constexpr Row emitters[] = {EMITTERS(ROW)};
inline constexpr Row integrators[] = {INTEGRATORS(ROW)};
inline constexpr Row samplers[] = {SAMPLERS(ROW)};
#undef ROW

struct MaterialTexture {
  std::string_view name;
  uint32_t shader::Material::* texture;
};
#define ROW(name) {#name, &shader::Material::name},
inline constexpr MaterialTexture material_textures[] = {MATERIAL_TEXTURES(ROW)};
#undef ROW

}  // namespace rows

// The registry macro `list` with the rows that are used, and the files of `folder` that they need.
std::string registry_text(std::string_view list, std::string_view folder, std::span<const Row> rows,
                          const std::set<uint32_t>& used);
// Only the macro, without the files.
std::string list_text(std::string_view list, std::span<const Row> rows, const std::set<uint32_t>& used);

}  // namespace eyeray::engine::executors
