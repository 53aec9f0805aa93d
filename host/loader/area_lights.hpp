// [[light]] tables of type "area": shapes that emit light, written as lights.
#pragma once

#include <toml++/toml.h>

#include <string_view>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/sections.hpp"
#include "host/reading/table_reader.hpp"
#include "host/reading/value.hpp"
#include "host/scene/shape.hpp"

namespace eyeray::engine::loader {

// A shape that an area light may have.
struct AreaShape {
  std::string_view name;  // `shape` in the light's table
  Section section;        // the keys to read the table by: the shape's, and those of area lights
};

// The shapes in the order of the manual.
std::span<const AreaShape> area_shapes();

// The keys that all area lights have in addition to those of every light.
std::span<const reading::Key> area_keys();

// The manual's text about area lights in Markdown, without the keys.
std::string_view area_manual();

bool is_area_light(const toml::table& light);

// The radiance that an area light's table states. `shape`: made of the same table.
Vec3 radiance_of(const Shape& shape, reading::TableReader& light);

// The shape that an area light's table names. Null after an error, which is in the log.
const AreaShape* area_shape(const toml::table& light, const reading::ValueSources& sources,
                            DiagnosticLog& log);

}  // namespace eyeray::engine::loader
