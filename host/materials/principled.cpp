#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>

#include "host/materials/normal_map.hpp"
#include "host/materials/physical.hpp"
#include "host/materials/principled_keys.hpp"
#include "host/materials/registry.hpp"

namespace eyeray::engine::materials {

extern const MaterialType principled_type;
extern const MaterialType plastic_type;

namespace {

class Principled final : public Physical {
 public:
  Principled(const PrincipledValues& values, std::unique_ptr<Material> stand_in, uint32_t kind)
      : Physical(std::move(stand_in)),
        values_(values),
        kind_(kind),
        shown_as_glass_(Physical::medium() || Physical::thin()) {}

  std::optional<Medium> medium() const override {
    return transmits() && !values_.thin ? own_medium() : Physical::medium();
  }
  bool thin() const override { return transmits() && values_.thin; }
  bool emits() const override { return constant_emission() != Vec3(0); }
  std::optional<Vec3> constant_emission() const override { return values_.emission->constant(); }

  Scattering scattering(const ScatteringContext& context) const override {
    Scattering scattering = Physical::scattering(context);
    if (shown_as_glass_) scattering.emitted = values_.emission->at(context.point) * context.color;
    return scattering;
  }

  Vec3 base_color(const TextureContext& point) const override {
    return (shown_as_glass_ ? Physical::base_color(point) : values_.color->at(point)) +
           values_.emission->at(point);
  }

  Bsdf bsdf(const ScatteringContext& context, const Scattering&) const override {
    const Vec3 color = values_.color->at(context.point) * context.color;
    const double metallic = values_.metallic->at(context.point).z;
    const double level = values_.specular->at(context.point).x;
    const Vec3 f0 = mirrored(values_.specular_color->at(context.point), level), edge(level);
    const double through = values_.transmission->at(context.point).x * (1 - metallic);
    Bsdf bsdf{.layer = optics::schlick(f0, edge),
              .layered = 1 - metallic,
              .metal = optics::schlick(color, Vec3(1)),
              .metallic = metallic,
              .roughness = values_.roughness->at(context.point).y,
              .coat = values_.coat->at(context.point).x,
              .coat_roughness = values_.coat_roughness->at(context.point).y,
              .coat_normal = context.coat_normal,
              .sheen = values_.sheen->at(context.point),
              .sheen_roughness = values_.sheen_roughness->at(context.point).y};
    add_body(1 - metallic - through, color, context, bsdf);
    add_anisotropy(context.point, bsdf);
    add_film(context.point, bsdf);
    if (through == 0) return bsdf;
    if (values_.thin) {
      (bsdf.roughness == 0 ? bsdf.passed : bsdf.thin) = color * through;
      return bsdf;
    }
    bsdf.layered -= through;
    bsdf.ior_from = context.ior_from;
    bsdf.ior_to = context.ior_to;
    if (bsdf.roughness == 0 || context.ior_from == context.ior_to) {
      const double mirrored =
          optics::dielectric_reflectance(context.cos_view, context.ior_from, context.ior_to);
      bsdf.mirror = Vec3(through * mirrored);
      bsdf.transmitted = color * (through * (1 - mirrored));
    } else {
      bsdf.glass = Vec3(through);
      bsdf.glass_color = color;
    }
    return bsdf;
  }

  void pack(records::Packer& packer) const override {
    const uint32_t color = values_.color->pack(packer), metallic = values_.metallic->pack(packer),
                   roughness = values_.roughness->pack(packer), coat = values_.coat->pack(packer),
                   coat_roughness = values_.coat_roughness->pack(packer),
                   transmission = values_.transmission->pack(packer), sheen = values_.sheen->pack(packer),
                   sheen_roughness = values_.sheen_roughness->pack(packer),
                   emission = values_.emission->pack(packer),
                   diffuse_transmission = values_.diffuse_transmission->pack(packer),
                   diffuse_transmission_color = values_.diffuse_transmission_color->pack(packer),
                   anisotropy = values_.anisotropy->pack(packer),
                   iridescence = values_.iridescence->pack(packer),
                   iridescence_thickness = values_.iridescence_thickness->pack(packer);
    // Constant `specular` and `specular_color` are multiplied here; their textures are then white.
    const std::optional<Vec3> level = values_.specular->constant(), tint = values_.specular_color->constant();
    const TexturePtr white = textures::make_constant(Vec3(1));
    const uint32_t specular_level = (level ? white : values_.specular)->pack(packer);
    const uint32_t specular_color = (tint ? white : values_.specular_color)->pack(packer);
    shader::Material& record = pack_stand_in(kind_, packer);
    if (shown_as_glass_) {
      record.flags |= MATERIAL_CLEAR;
      record.base = color;
      record.a.x = float(own_medium().ior);
      record.emission = emission;
    } else {
      record.color = color;
      if (const auto filling = medium()) record.medium = packer.add_medium(*filling);
    }
    record.transmission = transmission;
    record.diffuse_transmission = diffuse_transmission;
    record.diffuse_transmission_color = diffuse_transmission_color;
    record.anisotropy = anisotropy;
    record.iridescence = iridescence;
    record.iridescence_thickness = iridescence_thickness;
    record.iridescence_least = float(values_.iridescence_least);
    record.iridescence_most = float(values_.iridescence_most);
    record.iridescence_ior = float(values_.iridescence_ior);
    record.sheen = sheen;
    record.sheen_roughness = sheen_roughness;
    record.specular_level = specular_level;
    record.specular_color = specular_color;
    record.metallic = metallic;
    record.roughness = roughness;
    record.coat = coat;
    record.coat_roughness = coat_roughness;
    const double constant_level = level.value_or(Vec3(1)).x;
    record.b = records::to_vec4(mirrored(tint.value_or(Vec3(1)), constant_level), constant_level);
    packer.scene.lobes.insert({shader::LOBE_diffuse, shader::LOBE_glossy, shader::LOBE_multiple});
    std::set<uint32_t>& lobes = packer.scene.lobes;
    if (values_.coat->constant() != Vec3(0)) lobes.insert(shader::LOBE_coat);
    if (values_.sheen->constant() != Vec3(0)) lobes.insert(shader::LOBE_sheen);
    if (values_.diffuse_transmission->constant() != Vec3(0)) lobes.insert(shader::LOBE_translucent);
    packer.scene.has_films |= values_.iridescence->constant() != Vec3(0);
    if (transmits() &&
        (values_.roughness->constant() != Vec3(0) || values_.anisotropy->constant() != Vec3(0)))
      lobes.insert(values_.thin ? shader::LOBE_thin : shader::LOBE_rough_glass);
  }

 private:
  bool transmits() const { return values_.transmission->constant() != Vec3(0); }
  Medium own_medium() const {
    return {.ior = std::max(1.0, values_.ior),
            .absorption = values_.absorption,
            .dispersion = values_.dispersion};
  }
  // The light that the body, which is that share of the surface, scatters back and lets through evenly. A
  // Lambert body lets as much light through from the side of the greater index as from the other: there, the
  // part that is reflected totally is scattered back, too.
  void add_body(double body, const Vec3& color, const ScatteringContext& context, Bsdf& bsdf) const {
    const double share = values_.diffuse_transmission->at(context.point).x;
    const double leaves = std::min(1.0, std::pow(context.ior_to / context.ior_from, 2));
    const Vec3 through = share * values_.diffuse_transmission_color->at(context.point);
    bsdf.translucent = body * leaves * through;
    bsdf.diffuse = body * ((1 - share) * color + (1 - leaves) * through);
  }
  // KHR_materials_anisotropy: the slopes' width grows towards 1 along one direction. The roughness is that of
  // even microfacets that lose about as much light to each other: a fit.
  void add_anisotropy(const TextureContext& point, Bsdf& bsdf) const {
    const double strength = values_.anisotropy->at(point).z;
    const double width = std::max(bsdf.roughness * bsdf.roughness, 1e-3);
    const double along = std::lerp(width, 1.0, strength * strength);
    if (!(along > width)) return;
    bsdf.widths = {along, width};
    bsdf.roughness =
        std::sqrt(0.75 * std::sqrt((along * along + width * width) / 2) + 0.25 * (along + width) / 2);
  }
  void add_film(const TextureContext& point, Bsdf& bsdf) const {
    bsdf.film = {.share = values_.iridescence->at(point).x,
                 .thickness = std::lerp(values_.iridescence_least, values_.iridescence_most,
                                        values_.iridescence_thickness->at(point).y),
                 .ior = values_.iridescence_ior};
    if (bsdf.film.thickness == 0) bsdf.film.share = 0;
  }
  // The reflectance of the non-metal part at perpendicular incidence.
  Vec3 mirrored(const Vec3& tint, double level) const {
    const double r = (values_.ior - 1) / (values_.ior + 1);
    return glm::min(Vec3(1), r * r * tint) * level;
  }

  PrincipledValues values_;
  uint32_t kind_;
  bool shown_as_glass_;  // whether the stand-in is glass
};

std::unique_ptr<Material> make(const PrincipledValues& values, std::unique_ptr<Material> stand_in_material,
                               uint32_t kind) {
  if (!stand_in_material && values.transmission->constant() != Vec3(0) &&
      values.transmission->constant().value_or(values.transmission->at(Vec2(0.5))).x >= 0.5) {
    stand_in_material = make_dielectric({.ior = std::max(1.0, values.ior),
                                         .thin = values.thin,
                                         .absorption = values.absorption,
                                         .dispersion = values.dispersion});
  }
  if (!stand_in_material) {
    const double metallic = values.metallic->constant().value_or(values.metallic->at(Vec2(0.5))).z;
    const double roughness = typical(*values.roughness), r = (values.ior - 1) / (values.ior + 1);
    const Vec3 color = values.color->constant().value_or(values.color->at(Vec2(0.5)));
    const Vec3 f0 = glm::mix(Vec3(r * r), color, metallic);
    const double scattered = 1 - metallic * (1 - roughness) * (1 - roughness);
    PhongValues phong =
        stand_in(scattered == 1 ? values.color : textures::make_constant(color * scattered), f0, roughness);
    phong.emission = values.emission;
    stand_in_material = make_phong(phong);
  }
  auto material = std::make_unique<Principled>(values, std::move(stand_in_material), kind);
  if (values.anisotropy->constant() != Vec3(0)) material->rough_axis = RoughAxis{};
  return material;
}

PrincipledValues read_body(const TableReader& table) {
  return {.color = table.texture("color"),
          .roughness = table.texture("roughness"),
          .ior = table.number("ior"),
          .emission = table.texture("emission")};
}

// One error for each of `keys` that is set without `needed`.
void need(TableReader& table, const char* needed, std::initializer_list<const char*> keys) {
  for (const char* key : keys)
    if (table.has(key) && !table.has(needed))
      table.error(key, fmt::format("`{}` has no effect without `{}`", key, needed));
}

void read_directions(TableReader& table, PrincipledValues& values) {
  need(table, "diffuse_transmission", {"diffuse_transmission_color"});
  need(table, "anisotropy", {"anisotropy_rotation", "anisotropy_direction"});
  values.diffuse_transmission = table.texture("diffuse_transmission");
  values.diffuse_transmission_color = table.texture("diffuse_transmission_color");
  values.anisotropy = table.texture("anisotropy");
}

RoughAxis read_rough_axis(const TableReader& table) {
  RoughAxis axis{.turn = table.number("anisotropy_rotation") * M_PI / 180};
  if (table.has("anisotropy_direction")) axis.texture = as_data(table.texture("anisotropy_direction"));
  return axis;
}

void read_film(TableReader& table, PrincipledValues& values) {
  need(table, "iridescence", {"iridescence_ior", "iridescence_thickness", "iridescence_thickness_map"});
  need(table, "iridescence_thickness_map", {"iridescence_thickness_least"});
  values.iridescence = table.texture("iridescence");
  values.iridescence_ior = table.number("iridescence_ior");
  values.iridescence_most = table.number("iridescence_thickness");
  if (!table.has("iridescence_thickness_map")) return;
  values.iridescence_least = table.number("iridescence_thickness_least");
  values.iridescence_thickness = as_data(table.texture("iridescence_thickness_map"));
}

std::unique_ptr<Material> parse_principled(TableReader& table) {
  if (table.failed()) return nullptr;
  PrincipledValues values = read_body(table);
  values.metallic = table.texture("metallic");
  values.specular = table.texture("specular");
  values.specular_color = table.texture("specular_color");
  values.transmission = table.texture("transmission");
  values.thin = table.boolean("thin");
  values.absorption = table.color("absorption");
  values.sheen = table.texture("sheen_color");
  values.sheen_roughness = table.texture("sheen_roughness");
  if (values.thin && table.has("absorption"))
    table.error("absorption", "a thin pane has no inside that absorbs; tint it by its `color`");
  for (const char* key : {"thin", "absorption"})
    if (table.has(key) && !table.has("transmission"))
      table.error(key, fmt::format("`{}` applies to transmitted light, so it needs `transmission`", key));
  if (table.failed()) return nullptr;
  values.dispersion = table.number("dispersion");
  if (values.dispersion > 0 && (values.thin || !table.has("transmission")))
    table.error("dispersion",
                "dispersion is that of glass with an inside: it needs `transmission`, without `thin`");
  read_directions(table, values);
  read_film(table, values);
  if (table.failed()) return nullptr;
  values.coat = table.texture("coat");
  values.coat_roughness = table.texture("coat_roughness");
  std::unique_ptr<Material> material = make(values, nullptr, shader::MATERIAL_principled);
  if (material->rough_axis) material->rough_axis = read_rough_axis(table);
  material->coat_normal_map = read_normal_map(table, "coat_normal", "coat_normal_scale");
  if (material->coat_normal_map && !table.has("coat"))
    table.error("coat_normal", "`coat_normal` needs a `coat`");
  return material;
}

std::unique_ptr<Material> parse_plastic(TableReader& table) {
  if (table.failed()) return nullptr;
  return make(read_body(table), nullptr, shader::MATERIAL_plastic);
}

}  // namespace

extern const MaterialType principled_type{
    .name = "principled", .manual = principled_manual, .keys = principled_keys, .parse = parse_principled};
extern const MaterialType plastic_type{
    .name = "plastic", .manual = plastic_manual, .keys = plastic_keys, .parse = parse_plastic};

std::unique_ptr<Material> make_principled(const PrincipledValues& values,
                                          std::unique_ptr<Material> stand_in) {
  return make(values, std::move(stand_in), shader::MATERIAL_principled);
}

}  // namespace eyeray::engine::materials
