// The BSDFs for tests of lobes, in the reference's form and in the shaders'.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "host/optics/metals.hpp"
#include "host/pack/albedo_records.hpp"
#include "host/scene/bsdf.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"

namespace eyeray::engine::test {

struct Named {
  std::string name;
  Bsdf bsdf;
};

inline Bsdf conductor(const optics::Fresnel& fresnel, double roughness) {
  return {.metal = fresnel, .metallic = 1, .roughness = roughness};
}
inline Bsdf plastic(double color, double roughness, double coat = 0) {
  const optics::Fresnel surface = optics::schlick(Vec3(0.04), Vec3(1));
  return {.diffuse = Vec3(color), .layer = surface, .roughness = roughness, .coat = coat};
}
inline Bsdf glass(double roughness, double from, double to) {
  return {.roughness = roughness, .glass = Vec3(1), .ior_from = from, .ior_to = to};
}
inline Bsdf cloth(double sheen, double roughness) {
  return {.diffuse = Vec3(1), .sheen = Vec3(sheen), .sheen_roughness = roughness};
}
inline Bsdf pane(double color, double roughness) {
  const optics::Fresnel surface = optics::schlick(Vec3(0.08), Vec3(1));
  return {.layer = surface, .roughness = roughness, .thin = Vec3(color)};
}
// Half glass and half a body under a surface, with a coat over both.
inline Bsdf opal(double roughness) {
  Bsdf bsdf = plastic(0.3, roughness, 0.5);
  bsdf.coat_roughness = 0.4;
  bsdf.layered = 0.5;
  bsdf.glass = Vec3(0.5);
  bsdf.glass_color = {1, 0.8, 0.5};
  bsdf.ior_to = 1.5;
  return bsdf;
}
// A leaf: a body that scatters light to both sides, under a surface.
inline Bsdf leaf(double color, double through, double roughness) {
  Bsdf bsdf = plastic(color * (1 - through), roughness);
  bsdf.translucent = Vec3(color * through);
  return bsdf;
}
// `bsdf` with microfacets that are wider along x. The roughness is that of even ones that lose as much light.
inline Bsdf brushed(Bsdf bsdf) {
  const double width = std::max(bsdf.roughness * bsdf.roughness, 1e-3);
  bsdf.widths = {std::min(1.0, 2 * width), width / 2};
  const double sum = bsdf.widths.x + bsdf.widths.y;
  bsdf.roughness = std::sqrt(0.75 * std::hypot(bsdf.widths.x, bsdf.widths.y) / std::sqrt(2.0) + sum / 8);
  return bsdf;
}
inline Bsdf filmed(Bsdf bsdf, double thickness, double ior, double share = 1) {
  bsdf.layered = 1 - bsdf.metallic;  // or the film over a layer that is not there would count
  bsdf.film = {.share = share, .thickness = thickness, .ior = ior};
  return bsdf;
}
inline optics::Fresnel perfect() {
  return optics::schlick(Vec3(1), Vec3(1));
}
inline optics::Fresnel gold() {
  return optics::conductor(optics::metals[2].n, optics::metals[2].k);
}

inline std::vector<Named> examples(double roughness) {
  Bsdf matte{.diffuse = {0.9, 0.5, 0.1}, .diffuse_roughness = roughness};
  Bsdf car = plastic(0.4, roughness, 1);
  car.coat_roughness = 0.4;
  Bsdf lacquer = car;
  lacquer.coat_normal = glm::normalize(Vec3(0.5, -0.3, 1));
  Bsdf velvet = plastic(0.4, 0.7, 0.3);
  velvet.sheen = {0.9, 0.5, 0.3};
  velvet.sheen_roughness = roughness;
  Bsdf diamond_leaf = leaf(0.8, 0.6, roughness);
  diamond_leaf.layer = optics::schlick(Vec3(0.24), Vec3(1));
  return {
      {"matte", matte},
      {"gold", conductor(gold(), roughness)},
      {"plastic", plastic(0.6, roughness)},
      {"coated", car},
      {"coated aslant", lacquer},
      {"glass from outside", glass(roughness, 1, 1.5)},
      {"glass from inside", glass(roughness, 1.5, 1)},
      {"velvet", velvet},
      {"pane", pane(0.8, roughness)},
      {"opal", opal(roughness)},
      {"leaf", leaf(0.8, 0.6, roughness)},
      {"brushed gold", brushed(conductor(gold(), roughness))},
      {"brushed glass", brushed(glass(roughness, 1, 1.5))},
      {"brushed pane", brushed(pane(0.8, roughness))},
      {"oil on paint", filmed(plastic(0.6, roughness), 350, 1.4, 0.7)},
      {"film on copper", filmed(conductor(optics::schlick({0.9, 0.6, 0.4}, Vec3(1)), roughness), 500, 1.8)},
      {"film on a diamond leaf", filmed(diamond_leaf, 2, 1.3, 0.5)},
      {"bubble", filmed(pane(0.9, roughness), 300, 1.33)}};
}

// The shaders' record of the BSDF, seen from o.
inline shader::Bsdf packed(const Bsdf& bsdf, const glm::vec3& o) {
  const auto fresnel = [](const optics::Fresnel& from) {
    return shader::Fresnel{glm::vec3(from.f0), glm::vec3(from.f90), glm::vec3(from.mean), from.conductor};
  };
  shader::Bsdf record = shader::black_bsdf();
  record.diffuse = glm::vec3(bsdf.diffuse);
  record.diffuse_roughness = float(bsdf.diffuse_roughness);
  record.layer = fresnel(bsdf.layer);
  record.layered = float(bsdf.layered);
  record.metal = fresnel(bsdf.metal);
  record.metallic = float(bsdf.metallic);
  record.roughness = float(bsdf.roughness);
  record.albedo = shader::ggx_albedo(o.z, record.roughness);
  record.coat = float(bsdf.coat);
  record.coat_roughness = float(bsdf.coat_roughness);
  record.coat_normal = glm::vec3(bsdf.coat_normal);
  record.coat_albedo =
      shader::ggx_albedo(std::max(glm::dot(o, record.coat_normal), LEAST_COSINE), record.coat_roughness);
  record.sheen = glm::vec3(bsdf.sheen);
  record.sheen_roughness = float(bsdf.sheen_roughness);
  record.sheen_albedo = shader::sheen_table(o.z, record.sheen_roughness);
  record.thin = glm::vec3(bsdf.thin);
  record.translucent = glm::vec3(bsdf.translucent);
  record.widths = glm::vec2(bsdf.widths);
  if (bsdf.widths.x > 0) record.albedo = shader::facets_albedo(o, record.widths, record.roughness);
  record.glass = glm::vec3(bsdf.glass);
  record.glass_color = glm::vec3(bsdf.glass_color);
  record.ior_from = float(bsdf.ior_from);
  record.ior_to = float(bsdf.ior_to);
  if (bsdf.glass != Vec3(0))
    record.glass_albedo = shader::glass_table(o.z, record.roughness, record.ior_from, record.ior_to);
  if (bsdf.film.share > 0) {
    shader::Film film = shader::no_film();
    film.share = float(bsdf.film.share);
    film.thickness = float(bsdf.film.thickness);
    film.ior = float(bsdf.film.ior);
    record = shader::under_film(record, film, o.z);
  }
  return record;
}

inline records::PackedScene scene_with_albedos() {
  records::PackedScene scene;
  scene.lobes = {shader::LOBE_glossy, shader::LOBE_sheen, shader::LOBE_rough_glass};
  scene.media.push_back({});
  scene.media.back().ior = 1.5f;
  pack::pack_albedos(scene);
  scene.linear_ends.resize(shader::SHAPE_KINDS);
  return scene;
}

inline Vec3 towards(double cosine, double turn = 0.7) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(turn), sine * std::sin(turn), cosine};
}

}  // namespace eyeray::engine::test
