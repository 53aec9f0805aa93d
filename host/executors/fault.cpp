#include "host/executors/fault.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

#include "host/core/embedded_shaders.hpp"
#include "host/core/error.hpp"

namespace eyeray::executors {

struct FaultType {
  std::string_view name;
  // A shader's text `from` becomes `to`.
  std::string_view file = "", from = "", to = "";
  void (*scene)(records::PackedScene&) = nullptr;
  void (*samples)(std::span<PixelSample>) = nullptr;
  uint32_t shift = 0;
  bool contracts = false;
};

namespace {

using shader::Primitive;

constexpr FaultType types[] = {
    // Geometry.
    {.name = "near_root", .file = "shapes/sphere.glsl", .from = "ENTERS(ray, low) ? low : high", .to = "low"},
    {.name = "edge",
     .file = "shapes/triangle.glsl",
     .from = "minimum(edges.u, minimum(edges.v, edges.w)) >= 0.0f",
     .to = "minimum(edges.v, edges.w) >= 0.0f"},
    {.name = "steps",
     .file = "shapes/superellipsoid.glsl",
     .from = "SUPERELLIPSOID_STEPS 64u",
     .to = "SUPERELLIPSOID_STEPS 4u"},
    {.name = "position",
     .file = "kernels/pixel.glsl",
     .from = "positive_zeros(surface.p)",
     .to = "positive_zeros(surface.p * 1.0001f)"},
    {.name = "normal",
     .file = "geometry/surface.glsl",
     .from = "  return surface;",
     .to = "  surface.normal = -surface.normal;\n  return surface;"},
    {.name = "uv",
     .file = "geometry/surface.glsl",
     .from = "  return surface;",
     .to = "  surface.uv = vec2(surface.uv.y, surface.uv.x);\n  return surface;"},
    {.name = "ids",
     .file = "kernels/pixel.glsl",
     .from = "result.primitive = hit.id;",
     .to = "result.primitive = hit.id ^ 1u;"},
    {.name = "camera",
     .file = "cameras/camera.glsl",
     .from = "* frame.pixel_width;",
     .to = "* frame.pixel_width * 1.001f;"},
    {.name = "lens",
     .file = "cameras/lens.glsl",
     .from = "return at * frame.aperture;",
     .to = "return at * frame.aperture * 1.01f;"},
    {.name = "blades", .file = "cameras/lens.glsl", .from = "sqrt(u.y)", .to = "u.y"},
    {.name = "focus",
     .file = "cameras/perspective.glsl",
     .from = "start * frame.sharpness",
     .to = "start * frame.sharpness * 1.01f"},
    {.name = "fisheye",
     .file = "cameras/fisheye.glsl",
     .from = "sine_cosine(angle)",
     .to = "sine_cosine(0.999f * angle)"},
    {.name = "circle",
     .file = "cameras/camera.glsl",
     .from = "<= dot3(frame.forward, frame.forward)",
     .to = "<= 0.99f * dot3(frame.forward, frame.forward)"},
    {.name = "panorama",
     .file = "cameras/panorama.glsl",
     .from = "level * above.y + v * above.x",
     .to = "level * above.y + v * (0.999f * above.x)"},
    {.name = "cylindrical",
     .file = "cameras/cylindrical.glsl",
     .from = "v * dot3(across, v)",
     .to = "v * (0.999f * dot3(across, v))"},
    {.name = "own_camera",
     .file = "cameras/formula.glsl",
     .from = "lens.x, lens.y);",
     .to = "lens.x, lens.y) * 0.999f;"},
    {.name = "filter",
     .file = "samplers/filter.glsl",
     .from = "from_middle * frame.filter_width",
     .to = "from_middle * frame.filter_width * 1.1f"},
    // Shading.
    {.name = "shadow",
     .file = "bvh/traverse.glsl",
     .from = "return occluded >= OPTICAL_DEPTH_OPAQUE ? 0.0f :",
     .to = "return occluded >= OPTICAL_DEPTH_OPAQUE ? 1.0f :"},
    {.name = "fresnel",
     .file = "bsdf/fresnel.glsl",
     .from = "return 0.5f * (parallel * parallel + crossed * crossed);",
     .to = "return 0.49f * (parallel * parallel + crossed * crossed);"},
    {.name = "refraction",
     .file = "integrators/interaction.glsl",
     .from = "at.context.ior_from / at.context.ior_to",
     .to = "at.context.ior_to / at.context.ior_from"},
    {.name = "mirror",
     .file = "integrators/interaction.glsl",
     .from = "(2.0f * at.context.cos_view)",
     .to = "(1.99f * at.context.cos_view)"},
    {.name = "depth",
     .file = "integrators/whitted.glsl",
     .from = "path.depth < frame.max_depth",
     .to = "path.depth + 1u < frame.max_depth"},
    {.name = "checker",
     .file = "textures/checker.glsl",
     .from = "floor(place.uv.x * texture.b.x)",
     .to = "ceil(place.uv.x * texture.b.x)"},
    {.name = "noise",
     .file = "textures/pattern.glsl",
     .from = "t * (t * 6.0f - 15.0f) + 10.0f",
     .to = "t * (t * 6.0f - 15.0f) + 10.1f"},
    {.name = "normal_map",
     .file = "materials/bent_normal.glsl",
     .from = "t * x + b * y",
     .to = "t * x - b * y"},
    {.name = "coat_normal",
     .file = "materials/bent_normal.glsl",
     .from = "bent.coat_normal = surface.normal;",
     .to = "bent.coat_normal = bent.normal;"},
    {.name = "bump",
     .file = "materials/bent_normal.glsl",
     .from = "(2.0f * material.bump_width)",
     .to = "(1.99f * material.bump_width)"},
    {.name = "horizon",
     .file = "materials/bent_normal.glsl",
     .from = "return above < height ?",
     .to = "return above < -1.5f ?"},
    {.name = "counts",
     .file = "integrators/vertex.glsl",
     .from = "counts.y += struck ? 1u : 0u;",
     .to = "counts.y += 1u;"},
    {.name = "offset",
     .file = "geometry/ray.glsl",
     .from = "float side = cosine < 0.0f ? -s.offset : s.offset;",
     .to = "float side = cosine < 0.0f ? s.offset : -s.offset;"},
    // Paths.
    {.name = "mis",
     .file = "integrators/path.glsl",
     .from = "return 1.0f / (1.0f + ratio * ratio);",
     .to = "return 0.5f;"},
    {.name = "twice",
     .file = "integrators/path.glsl",
     .from = "path.density > 0.0f ? emitter_of",
     .to = "path.density < 0.0f ? emitter_of"},
    {.name = "share",
     .file = "emitters/emitter.glsl",
     .from = "float(load_emitter(i).end - begin) * 5.9604645e-8f",
     .to = "1.0f / float(EMITTER_COUNT)"},
    {.name = "density",
     .file = "emitters/sphere.glsl",
     .from = "1.0f / (2.0f * PI * versine(sine_squared))",
     .to = "1.05f / (2.0f * PI * versine(sine_squared))"},
    {.name = "solid_angle",
     .file = "emitters/rectangle.glsl",
     .from = "? 1.0f / (2.0f * seen.half_angle)",
     .to = "? 1.05f / (2.0f * seen.half_angle)"},
    {.name = "spherical",
     .file = "emitters/spherical_triangle.glsl",
     .from = "1.0f - u.x * versine - reach",
     .to = "1.0f - 1.05f * u.x * versine - reach"},
    {.name = "cosine",
     .file = "integrators/path.glsl",
     .from = "arriving.radiance * lobes.value *",
     .to = "arriving.radiance * lobes.value / maximum(i_local.z, 0.01f) *"},
    {.name = "roulette",
     .file = "integrators/path.glsl",
     .from = "next.throughput / survival",
     .to = "next.throughput"},
    {.name = "shadow_end",
     .file = "integrators/path.glsl",
     .from = "arriving.ray = make_ray(start, way / arriving.distance);",
     .to = "arriving.ray = make_ray(start, way / arriving.distance);\n    arriving.distance = T_MISS;"},
    {.name = "lobe",
     .file = "bsdf/bsdf.glsl",
     .from = "of_lobe.density * shares.name;",
     .to = "of_lobe.density;"},
    {.name = "masking",
     .file = "bsdf/ggx.glsl",
     .from = "d / (towards_o + ggx_lambda(i, width))",
     .to = "d / towards_o"},
    {.name = "pane",
     .file = "integrators/vertex.glsl",
     .from = "left * passed_by(at.material, at.context)",
     .to = "left"},
    {.name = "sheen", .file = "bsdf/sheen.glsl", .from = "(seen * most)", .to = "seen"},
    {.name = "pairs", .file = "math/rng.glsl", .from = "PAIR_DIRECTION 5u", .to = "PAIR_DIRECTION 7u"},
    {.name = "albedo",
     .file = "bsdf/diffuse.glsl",
     .from = "albedo * result.density",
     .to = "albedo * result.density * 1.001f"},
    {.name = "threshold",
     .file = "bsdf/bsdf.glsl",
     .from = "if (shares.name > 0.0f && chance >= passed) {",
     .to = "if (shares.name > 0.0f && chance >= passed + (passed > 0.0f ? 0.001f : 0.0f)) {"},
    {.name = "clamp",
     .file = "kernels/pixel.glsl",
     .from = "sample_result(positive_zeros(color), counts, trail)",
     .to = "sample_result(positive_zeros(vec3(minimum(color.x, 10.0f), color.y, color.z)), counts, trail)"},
    {.name = "half_texel",
     .file = "emitters/environment.glsl",
     .from = "* float(frame.environment_width) - 0.5f;",
     .to = "* float(frame.environment_width);"},
    {.name = "emission_side",
     .file = "emitters/emitter.glsl",
     .from = "e.side * dot3(place.normal, direction) > 0.0f",
     .to = "e.side * dot3(place.normal, direction) < 0.0f"},
    {.name = "emission_uv",
     .file = "emitters/emitter.glsl",
     .from = "place_of_uv(place.uv)",
     .to = "place_of_uv(vec2(place.uv.y, place.uv.x))"},
    {.name = "face",
     .file = "emitters/box.glsl",
     .from = "turned ? weight / sum : 0.0f",
     .to = "turned ? 0.3333333f : 0.0f"},
    // One light is no leaf of the BVH.
    {.name = "light_leaf",
     .scene =
         [](records::PackedScene& scene) {
           const auto is_leaf = [](const shader::LightNode& node) { return (node.child & LEAF) != 0; };
           const auto first = std::ranges::find_if(scene.light_nodes, is_leaf);
           if (first != scene.light_nodes.end())
             first->child =
                 std::ranges::find_if(scene.light_nodes.rbegin(), scene.light_nodes.rend(), is_leaf)->child;
         }},
    {.name = "flight",
     .file = "integrators/flight.glsl",
     .from = "-log_positive(1.0f - chance.y) / rate",
     .to = "-0.98f * log_positive(1.0f - chance.y) / rate"},
    {.name = "height_fog",
     .file = "materials/medium_extent.glsl",
     .from = "(1.0f - exp_negative(-x)) / decay",
     .to = "0.99f * (1.0f - exp_negative(-x)) / decay"},
    {.name = "phase",
     .file = "materials/phase.glsl",
     .from = "/ (4.0f * PI * square * sqrt(square))",
     .to = "/ (4.1f * PI * square * sqrt(square))"},
    // Photons.
    {.name = "kernel",
     .file = "integrators/sppm.glsl",
     .from = "1.0f - squared / pass.radius_squared",
     .to = "0.5f"},
    {.name = "cells",
     .file = "integrators/sppm.glsl",
     .from = "its.x == cell.x && its.y == cell.y && its.z == cell.z && squared",
     .to = "squared"},
    {.name = "gathered_twice",
     .file = "integrators/photon.glsl",
     .from = "struck && path.depth > 0u &&",
     .to = "struck &&"},
    {.name = "photon_flux", .file = "lights/point.glsl", .from = "39.4784176f", .to = "39.5178960f"},
    {.name = "photon_area",
     .file = "integrators/photon_source.glsl",
     .from = "(sides * PI / density_by_area",
     .to = "(sides * 1.001f * PI / density_by_area"},
    {.name = "photon_heading",
     .file = "integrators/photon_source.glsl",
     .from = "cosine_direction(heading)",
     .to = "cosine_direction(vec2(heading.x * heading.x, heading.y))"},
    {.name = "photon_aim",
     .file = "lights/photon_aim.glsl",
     .from = "/ (2.0f * PI * sum)",
     .to = "/ (2.01f * PI * sum)"},
    {.name = "photon_index",
     .file = "integrators/photon.glsl",
     .from = " / squared_index(path.media)",
     .to = ""},
    {.name = "photon_behind", .file = "integrators/sppm.glsl", .from = "before ? n : -n", .to = "n"},
    // Random numbers.
    {.name = "random", .file = "math/rng.glsl", .from = "2891336453u", .to = "2891336455u"},
    // Packing.
    {.name = "ior",
     .scene =
         [](records::PackedScene& scene) {
           for (size_t i = 1; i < scene.media.size(); ++i) scene.media[i].ior *= 1.05f;
         }},
    {.name = "light",
     .scene =
         [](records::PackedScene& scene) {
           for (shader::Light& light : scene.lights) light.intensity = shader::vec3(0);
         }},
    // Along the line to the eye, which is the origin.
    {.name = "near_light",
     .scene =
         [](records::PackedScene& scene) {
           for (shader::Light& light : scene.lights) light.a *= shader::vec4(0.999f, 0.999f, 0.999f, 1.0f);
         }},
    {.name = "materials",
     .scene =
         [](records::PackedScene& scene) {
           for (Primitive& primitive : scene.primitives)
             if (material_of(primitive) == 1) primitive.material_and_kind -= 1;
         }},
    {.name = "bit",
     .scene =
         [](records::PackedScene& scene) {
           for (shader::Light& light : scene.lights)
             light.a.x = std::bit_cast<float>(std::bit_cast<uint32_t>(light.a.x) ^ 1u);
         }},
    // Read-back.
    {.name = "nan",
     .samples =
         [](std::span<PixelSample> samples) {
           samples[samples.size() / 2].color.y = std::numeric_limits<double>::quiet_NaN();
         }},
    {.name = "black",
     .samples =
         [](std::span<PixelSample> samples) {
           for (PixelSample& sample : samples) sample.color = Vec3(0.0);
         }},
    {.name = "stale", .samples = [](std::span<PixelSample> samples) { samples.back() = samples.front(); }},
    // Which pixel, and the float policy.
    {.name = "shift", .shift = 1},
    {.name = "contraction", .contracts = true},
    // A text that does not compile.
    {.name = "syntax", .file = "kernels/pixel.glsl", .from = "result.primitive = hit.id;", .to = "nonsense;"},
};

}  // namespace

Fault::Fault(const std::string& name) {
  if (name.empty()) return;
  type_ = std::ranges::find(types, name, &FaultType::name);
  if (type_ == std::end(types)) {
    std::vector<std::string_view> names;
    for (const FaultType& type : types) names.push_back(type.name);
    throw Error(ExitCode::bad_input, "no fault is called '{}'; there are {}", name, fmt::join(names, ", "));
  }
  // One that has lost its file must not pass unseen, as one that has lost its place in it does not.
  if (!type_->file.empty())
    CHECK(std::ranges::find(embedded_shaders(), type_->file, &EmbeddedFile::name) !=
          embedded_shaders().end());
}

void Fault::damage(records::PackedScene& scene) const {
  if (type_ && type_->scene) type_->scene(scene);
}

std::string Fault::damage(std::string_view file, std::string text) const {
  if (!type_ || type_->file != file) return text;
  const size_t at = text.find(type_->from);
  CHECK(at != std::string::npos);
  return text.replace(at, type_->from.size(), type_->to);
}

void Fault::damage(std::span<PixelSample> samples) const {
  if (type_ && type_->samples && !samples.empty()) type_->samples(samples);
}

uint32_t Fault::shift() const {
  return type_ ? type_->shift : 0;
}

bool Fault::contracts() const {
  return type_ && type_->contracts;
}

}  // namespace eyeray::executors
