#include "host/loader/mesh_reading.hpp"

#include <optional>
#include <string>

#include "host/loader/mesh_imports.hpp"

namespace eyeray::engine::loader {

importers::ImportOptions read_mesh_reading(const reading::TableReader& reader) {
  const auto number = [&](const char* key) {
    return reader.has(key) ? std::optional(reader.number(key)) : std::nullopt;
  };
  const auto text = [&](const char* key) {
    return reader.has(key) ? std::optional(reader.string(key)) : std::nullopt;
  };
  return {.smooth = number("smooth"),
          .point_shape = importers::PointShape(reader.choice("point_shape")),
          .point_size = number("point_size"),
          .line_width = number("line_width"),
          .up = importers::UpAxis(reader.choice("up")),
          .playing = {.animation = text("animation"), .loop = reader.boolean("loop")},
          .gltf_scene = text("gltf_scene"),
          .variant = text("variant")};
}

void write_mesh_reading(const importers::ImportOptions& options, toml::table& mesh) {
  const auto write = [&](const char* key, const auto& value) {
    if (value) mesh.insert(key, *value);
  };
  write("smooth", options.smooth);
  if (options.point_shape != importers::PointShape::sphere)
    mesh.insert("point_shape", importers::point_shape_names[size_t(options.point_shape)]);
  write("point_size", options.point_size);
  write("line_width", options.line_width);
  if (options.up != importers::UpAxis::y) mesh.insert("up", importers::up_names[size_t(options.up)]);
  write("gltf_scene", options.gltf_scene);
  write("variant", options.variant);
}

bool check_mesh_names(const importers::ImportOptions& options, const importers::ImportedScene& import,
                      reading::TableReader& reader) {
  const auto check = [&](const char* key, const std::optional<std::string>& wanted, const char* kind,
                         const std::vector<std::string>& names) {
    const bool known = !wanted || importers::find_named(names, *wanted);
    if (!known) reader.error(key, no_such(kind, *wanted, names));
    return known;
  };
  const auto& animation = options.playing.animation;
  const bool plays = animation && *animation != no_animation;
  bool found = check("animation", plays ? animation : std::nullopt, "animation", import.animations);
  found = check("gltf_scene", options.gltf_scene, "scene", import.scenes) && found;
  return check("variant", options.variant, "variant", import.variants) && found;
}

}  // namespace eyeray::engine::loader
