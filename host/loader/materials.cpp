#include "host/loader/materials.hpp"

#include <algorithm>

#include "host/loader/kinds.hpp"
#include "host/materials/make.hpp"
#include "host/materials/normal_map.hpp"
#include "host/materials/registry.hpp"

namespace eyeray::engine::loader {

using reading::Key, reading::KeyType;

namespace {

constexpr std::string_view alpha_modes[] = {"mask", "blend"};

constexpr size_t most_media = 255;  // a medium's number is a byte in the shaders' stack of media

void bend_normals(reading::TableReader& reader, Material& material) {
  material.normal_map = materials::read_normal_map(reader, "normal", "normal_scale");
  if (const TexturePtr bump = reader.has("bump") ? materials::as_data(reader.texture("bump")) : nullptr) {
    const double width = reader.has("bump_width") ? reader.number("bump_width") : bump->detail();
    material.bump_map = BumpMap{bump, reader.number("bump_height"), width};
  }
  for (const std::string_view key : {"bump_height", "bump_width"})
    if (reader.has(key) && !reader.has("bump")) reader.error(key, "this key needs a `bump`");
}

}  // namespace

std::span<const Key> material_keys() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const materials::MaterialType* type : materials::types()) all.push_back(type->name);
    return all;
  }();
  static const Key keys[] = {
      {.name = "name",
       .type = KeyType::string,
       .doc = "Name by which shapes refer to the material, unique in the scene."},
      {.name = "type", .type = KeyType::choice, .doc = "Kind; see below.", .choices = names},
      {.name = "alpha",
       .type = KeyType::texture,
       .doc = "Opacity of the surface. The first component of a color counts, and the alpha of an image. "
              "Only for planes, triangles, polygons, parallelograms, disks and meshes, whose faces a ray "
              "hits at most once.",
       .max = 1,
       .optional = true},
      {.name = "alpha_mode",
       .type = KeyType::choice,
       .doc = "\"mask\": the surface does not exist where `alpha` is below `alpha_cutoff`. \"blend\": a ray "
              "hits the surface with probability `alpha`, so that on average the surface transmits the rest.",
       .fallback = "\"mask\"",
       .choices = alpha_modes},
      {.name = "alpha_cutoff",
       .type = KeyType::number,
       .doc = "Smallest `alpha` at which the surface exists in the mode \"mask\".",
       .fallback = "0.5",
       .min = 0,
       .max = 1,
       .above_min = true},
      {.name = "emission_side",
       .type = KeyType::choice,
       .doc = "Sides of the surface that emit light: both, or only the side to which the normals point.",
       .fallback = "\"both\"",
       .choices = emission_sides},
      {.name = "emission_sampled",
       .type = KeyType::boolean,
       .doc = "Send shadow rays of `path` to the surfaces that emit. With `false` paths find their light by "
              "chance, which is "
              "better for a surface as dim as its surroundings.",
       .fallback = "true"},
      {.name = "normal",
       .type = KeyType::texture,
       .doc =
           "A normal map, as in glTF: the apparent direction of the surface in tangent space, red along u, "
           "green along v, with [0.5, 0.5, 1] straight out. Codes of an image are used without conversion.",
       .max = 1,
       .optional = true},
      {.name = "normal_scale",
       .type = KeyType::number,
       .doc = "Strength of the normal map. A negative value bends the normals in the opposite direction.",
       .fallback = "1",
       .min = -1000,
       .max = 1000},
      {.name = "bump",
       .type = KeyType::texture,
       .doc = "Bump map: apparent heights of the surface, 0 where the map is black. The luminance of a color "
              "counts. Codes of an image are used without conversion.",
       .max = 1,
       .optional = true},
      {.name = "bump_height",
       .type = KeyType::number,
       .doc = "Height of white in the bump map, in world units. With a negative value the surface sinks.",
       .fallback = "0.1"},
      {.name = "bump_width",
       .type = KeyType::number,
       .doc = "Distance to each side at which heights are compared, and so half the width of the slope at a "
              "step. It is in uv, or in world units for patterns in space. When absent: one texel of an "
              "image, 0.03 units of a pattern, or 0.01 of uv.",
       .min = 0,
       .above_min = true,
       .optional = true},
  };
  return keys;
}

void Materials::add(const Section& section, const toml::table& table) {
  auto [type, reader] = read_kind(section, &table, materials::types(), values_, log_);
  std::unique_ptr<Material> material = type ? type->parse(reader) : nullptr;

  // Enter the name even after an error, so that shapes that use it are not reported too.
  const std::string name = reader.string("name");
  if (!reader.valid("name")) return;
  if (name.empty()) return reader.error("name", "a material's name must not be empty");
  const auto [entry, fresh] = by_name_.try_emplace(name, Named{-1, reader.position()});
  if (!fresh) {
    const SourcePosition& first = entry->second.position;
    return reader.error("name", fmt::format("material \"{}\" is defined twice; the first is at {}:{}", name,
                                            first.file, first.line));
  }
  if (!material) return;
  if (material->medium() && ++media_ > most_media) {
    reader.error("type",
                 fmt::format("a scene can have at most {} materials that light passes through", most_media));
  }
  if (reader.has("alpha")) {
    if (material->medium())
      reader.error("alpha",
                   "a material that light passes through fills its shape, which cannot have cutouts");
    material->mask = AlphaMask{.alpha = reader.texture("alpha"),
                               .cutoff = reader.number("alpha_cutoff"),
                               .blends = reader.choice("alpha_mode") == 1};
    if (material->mask->alpha && material->mask->alpha->in_space())
      reader.error("alpha", "a pattern in space cannot be an `alpha`");
    if (material->mask->blends && reader.has("alpha_cutoff"))
      reader.error(
          "alpha_cutoff",
          "a material that blends has no cutoff: leave out `alpha_cutoff`, or set `alpha_mode` to \"mask\"");
  } else {
    for (const std::string_view key : {"alpha_cutoff", "alpha_mode"})
      if (reader.has(key)) reader.error(key, fmt::format("`{}` needs an `alpha`", key));
  }
  material->emits_in_front = reader.choice("emission_side") == 1;
  if (material->emits_in_front && !material->emits())
    reader.error("emission_side", "`emission_side` needs an `emission`");
  material->samples_emission = reader.boolean("emission_sampled");
  bend_normals(reader, *material);
  material->name = name;
  entry->second.index = static_cast<int>(scene_.materials.size());
  scene_.materials.push_back(std::move(material));
}

int Materials::find(reading::TableReader& shape) {
  if (!shape.valid("material")) return 0;
  const std::string name = shape.string("material");
  const auto found = by_name_.find(name);
  if (found != by_name_.end()) {
    found->second.used = true;
    return std::max(0, found->second.index);
  }
  if (log_.damaged()) return 0;
  std::vector<std::string_view> names;
  for (const auto& [known, material] : by_name_) names.push_back(known);
  const std::string nearest = nearest_name(name, names);
  shape.error("material", fmt::format("no [[material]] is named \"{}\"{}", name,
                                      nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", nearest)));
  return 0;
}

void Materials::check_opaque(reading::TableReader& shape, int index) const {
  if (index < 0 || size_t(index) >= scene_.materials.size()) return;
  const Material& material = *scene_.materials[size_t(index)];
  const bool transmits = material.medium() || material.thin() || material.shadow_transmittance() > 0;
  if (transmits || material.mask)
    shape.error("material",
                fmt::format("points and lines may overlap, so their material must be opaque: {}",
                            transmits ? "light passes through this one" : "this one has an `alpha`"));
}

int Materials::emitter(const Vec3& radiance, bool in_front) {
  const auto [entry, fresh] =
      emitters_.try_emplace({radiance.x, radiance.y, radiance.z, in_front}, int(scene_.materials.size()));
  if (!fresh) return entry->second;
  auto material = materials::make_phong(
      {.diffuse = textures::make_constant(Vec3(0)), .emission = textures::make_constant(radiance)});
  material->emits_in_front = in_front;
  scene_.materials.push_back(std::move(material));
  return entry->second;
}

void Materials::check() const {
  const auto is_medium = [](const auto& material) { return material->medium().has_value(); };
  if (std::ranges::count_if(scene_.materials, is_medium) > std::ptrdiff_t{most_media}) {
    log_.error({},
               fmt::format("a scene can have at most {} materials that light passes through, those of its "
                           "mesh files included",
                           most_media));
  }
  for (const auto& [name, material] : by_name_) {
    if (!material.used) log_.warning(material.position, fmt::format("material \"{}\" is not used", name));
  }
}

}  // namespace eyeray::engine::loader
