// Faults that are put into the GPU's shaders on purpose: the proof that `verify` turns red (tests/must_fail).
#pragma once

#include <algorithm>
#include <string_view>

#include "tests/support/shader_overlay.hpp"

namespace eyeray::engine::test {

// A fault replaces the text `from` by `to` in a shader's file. docs/gates.md describes the effect of each,
// and its line in the report.
struct Fault {
  std::string_view name;
  const char* file;
  const char* from;
  const char* to;
};

inline constexpr Fault faults[] = {
    // Geometry.
    {"near_root", "shapes/sphere.glsl", "ENTERS(ray, low) ? low : high", "low"},
    {"edge", "shapes/triangle.glsl", "minimum(edges.u, minimum(edges.v, edges.w)) >= 0.0f",
     "minimum(edges.v, edges.w) >= 0.0f"},
    {"steps", "shapes/superellipsoid.glsl", "SUPERELLIPSOID_STEPS 64u", "SUPERELLIPSOID_STEPS 4u"},
    {"position", "kernels/pixel.glsl", "positive_zeros(surface.p)", "positive_zeros(surface.p * 1.0001f)"},
    {"normal", "geometry/surface.glsl", "  return surface;",
     "  surface.normal = -surface.normal;\n  return surface;"},
    {"uv", "geometry/surface.glsl", "  return surface;",
     "  surface.uv = vec2(surface.uv.y, surface.uv.x);\n  return surface;"},
    {"ids", "kernels/pixel.glsl", "result.primitive = hit.id;", "result.primitive = hit.id ^ 1u;"},
    {"camera", "cameras/camera.glsl", "* frame.pixel_width;", "* frame.pixel_width * 1.001f;"},
    {"lens", "cameras/lens.glsl", "return at * frame.aperture;", "return at * frame.aperture * 1.01f;"},
    {"blades", "cameras/lens.glsl", "sqrt(u.y)", "u.y"},
    {"focus", "cameras/perspective.glsl", "start * frame.sharpness", "start * frame.sharpness * 1.01f"},
    {"fisheye", "cameras/fisheye.glsl", "sine_cosine(angle)", "sine_cosine(0.999f * angle)"},
    {"circle", "cameras/camera.glsl", "<= dot3(frame.forward, frame.forward)",
     "<= 0.99f * dot3(frame.forward, frame.forward)"},
    {"panorama", "cameras/panorama.glsl", "level * above.y + v * above.x",
     "level * above.y + v * (0.999f * above.x)"},
    {"cylindrical", "cameras/cylindrical.glsl", "v * dot3(across, v)", "v * (0.999f * dot3(across, v))"},
    {"own_camera", "cameras/formula.glsl", "lens.x, lens.y);", "lens.x, lens.y) * 0.999f;"},
    {"filter", "samplers/filter.glsl", "from_middle * frame.filter_width",
     "from_middle * frame.filter_width * 1.1f"},
    // Shading.
    {"shadow", "bvh/traverse.glsl",
     "return occluded >= OPTICAL_DEPTH_OPAQUE ? 0.0f :", "return occluded >= OPTICAL_DEPTH_OPAQUE ? 1.0f :"},
    {"fresnel", "bsdf/fresnel.glsl", "return 0.5f * (parallel * parallel + crossed * crossed);",
     "return 0.49f * (parallel * parallel + crossed * crossed);"},
    {"refraction", "integrators/interaction.glsl", "at.context.ior_from / at.context.ior_to",
     "at.context.ior_to / at.context.ior_from"},
    {"mirror", "integrators/interaction.glsl", "(2.0f * at.context.cos_view)",
     "(1.99f * at.context.cos_view)"},
    {"depth", "integrators/whitted.glsl", "path.depth < frame.max_depth",
     "path.depth + 1u < frame.max_depth"},
    {"checker", "textures/checker.glsl", "floor(point.uv.x * checks.x)", "ceil(point.uv.x * checks.x)"},
    {"noise", "textures/pattern.glsl", "t * (t * 6.0f - 15.0f) + 10.0f", "t * (t * 6.0f - 15.0f) + 10.1f"},
    {"normal_map", "materials/bent_normal.glsl", "frame.s * x + frame.t * y", "frame.s * x - frame.t * y"},
    {"coat_normal", "materials/bent_normal.glsl", "bent.coat_normal = surface.normal;",
     "bent.coat_normal = bent.normal;"},
    {"bump", "materials/bent_normal.glsl", "(2.0f * material.bump_width)", "(1.99f * material.bump_width)"},
    {"horizon", "materials/bent_normal.glsl", "return above < height ?", "return above < -1.5f ?"},
    {"counts", "integrators/vertex.glsl", "counts.y += on_surface ? 1u : 0u;", "counts.y += 1u;"},
    {"offset", "geometry/ray.glsl", "float side = cosine < 0.0f ? -s.offset : s.offset;",
     "float side = cosine < 0.0f ? s.offset : -s.offset;"},
    // Paths.
    {"mis", "integrators/path.glsl", "return 1.0f / (1.0f + ratio * ratio);", "return 0.5f;"},
    {"twice", "integrators/path.glsl", "path.density > 0.0f ? emitter_of",
     "path.density < 0.0f ? emitter_of"},
    {"share", "emitters/emitter.glsl", "float(load_emitter(i).end - begin) * 5.9604645e-8f",
     "1.0f / float(EMITTER_COUNT)"},
    {"density", "emitters/sphere.glsl", "1.0f / (2.0f * PI * versine(sine_squared))",
     "1.05f / (2.0f * PI * versine(sine_squared))"},
    {"solid_angle", "emitters/rectangle.glsl", "? 1.0f / (2.0f * seen.half_angle)",
     "? 1.05f / (2.0f * seen.half_angle)"},
    {"spherical", "emitters/spherical_triangle.glsl", "1.0f - u.x * versine - reach",
     "1.0f - 1.05f * u.x * versine - reach"},
    {"cosine", "integrators/path.glsl", "arriving.radiance * lobes.value *",
     "arriving.radiance * lobes.value / maximum(i_local.z, 0.01f) *"},
    {"roulette", "integrators/path.glsl", "next.throughput / survival", "next.throughput"},
    {"shadow_end", "integrators/path.glsl", "arriving.ray = make_ray(start, way / arriving.distance);",
     "arriving.ray = make_ray(start, way / arriving.distance);\n    arriving.distance = T_MISS;"},
    {"lobe", "bsdf/bsdf.glsl", "of_lobe.density * shares.name;", "of_lobe.density;"},
    {"masking", "bsdf/ggx.glsl", "d / (towards_o + ggx_lambda(i, width))", "d / towards_o"},
    {"pane", "integrators/vertex.glsl", "left * passed_by(at.material, at.context)", "left"},
    {"sheen", "bsdf/sheen.glsl", "(seen * most)", "seen"},
    {"pairs", "math/rng.glsl", "PAIR_DIRECTION 5u", "PAIR_DIRECTION 7u"},
    {"albedo", "bsdf/diffuse.glsl", "albedo * result.density", "albedo * result.density * 1.001f"},
    {"threshold", "bsdf/bsdf.glsl", "if (shares.name > 0.0f && random >= passed) {",
     "if (shares.name > 0.0f && random >= passed + (passed > 0.0f ? 0.001f : 0.0f)) {"},
    {"clamp", "kernels/pixel.glsl", "sample_result(positive_zeros(color), counts, trail)",
     "sample_result(positive_zeros(vec3(minimum(color.x, 10.0f), color.y, color.z)), counts, trail)"},
    {"half_texel", "emitters/environment.glsl", "* float(frame.environment_width) - 0.5f;",
     "* float(frame.environment_width);"},
    {"emission_side", "emitters/emitter.glsl", "e.side * dot3(point.normal, direction) > 0.0f",
     "e.side * dot3(point.normal, direction) < 0.0f"},
    {"emission_uv", "emitters/emitter.glsl", "context_of_uv(point.uv)",
     "context_of_uv(vec2(point.uv.y, point.uv.x))"},
    {"face", "emitters/box.glsl", "turned ? weight / sum : 0.0f", "turned ? 0.3333333f : 0.0f"},
    {"light_leaf", "emitters/light_bvh.glsl", "pick.light = child & ~LEAF;",
     "pick.light = child == LEAF ? 1u : child & ~LEAF;"},
    {"flight", "integrators/flight.glsl", "-log_positive(1.0f - random.y) / rate",
     "-0.98f * log_positive(1.0f - random.y) / rate"},
    {"height_fog", "materials/medium_extent.glsl", "(1.0f - exp_negative(-x)) / decay",
     "0.99f * (1.0f - exp_negative(-x)) / decay"},
    {"phase", "materials/phase.glsl", "/ (4.0f * PI * square * sqrt(square))",
     "/ (4.1f * PI * square * sqrt(square))"},
    // Photons.
    {"kernel", "integrators/sppm.glsl", "1.0f - squared / pass.radius_squared", "0.5f"},
    {"cells", "integrators/sppm.glsl", "its.x == cell.x && its.y == cell.y && its.z == cell.z && squared",
     "squared"},
    {"gathered_twice", "integrators/photon.glsl", "on_surface && path.depth > 0u &&", "on_surface &&"},
    {"photon_flux", "lights/point.glsl", "39.4784176f", "39.5178960f"},
    {"photon_area", "integrators/photon_source.glsl", "(sides * PI / density_by_area",
     "(sides * 1.001f * PI / density_by_area"},
    {"photon_heading", "integrators/photon_source.glsl", "cosine_direction(heading)",
     "cosine_direction(vec2(heading.x * heading.x, heading.y))"},
    {"photon_aim", "lights/photon_aim.glsl", "/ (2.0f * PI * sum)", "/ (2.01f * PI * sum)"},
    {"photon_index", "integrators/photon.glsl", " / squared_index(path.media, path.throughput)", ""},
    {"photon_behind", "integrators/sppm.glsl", "before ? n : -n", "n"},
    // Kernels that the emulator watches.
    {"unset", "bvh/traverse.glsl", "  state.hit.slot = NONE;\n", ""},
    {"lane_reads", "kernels/cooperative/packet.comp.glsl",
     "if (slot != NONE) hit = hit_of_packet(hits[slot], counts);",
     "hit = hit_of_packet(hits[slot == NONE ? 0u : slot], counts);"},
    {"next_hit", "kernels/cooperative/packet.comp.glsl", "hits[slot[k]] = packet_of_hit(",
     "hits[slot[k] + 1u] = packet_of_hit("},
    {"list_count", "kernels/wavefront.comp.glsl",
     "    queue_path(slot, all.next);\n    next_list[1u + atomicAdd(next_list[0], 1u)] = slot;",
     "    queue_path(slot, all.next);\n    next_list[0] = next_list[0] + 1u;\n    next_list[next_list[0]] = "
     "slot;"},
    // Denoising.
    {"denoise_own", "denoise/distance.glsl", "0.25f / float(values)", "0.3f / float(values)"},
    {"denoise_cost", "denoise/regression.glsl", "COEFFICIENT_COST 1.0e-3f", "COEFFICIENT_COST 2.0e-3f"},
    {"denoise_patch", "kernels/denoise.comp.glsl", "k < PATCH; ++k) sum += row_sums[start",
     "k < PATCH - 1; ++k) sum += row_sums[start"},
    // Random numbers.
    {"random", "math/rng.glsl", "2891336453u", "2891336455u"},
    // The scene, as the shaders find it.
    {"ior", "integrators/interaction.glsl", "  PROBE(ior,",
     "  at.context.ior_from *= at.context.ior_from > 1.0f ? 1.05f : 1.0f;\n"
     "  at.context.ior_to *= at.context.ior_to > 1.0f ? 1.05f : 1.0f;\n"
     "  PROBE(ior,"},
    {"light", "lights/light.glsl", "LIGHTS(SAMPLE_OF)",
     "LIGHTS(SAMPLE_OF)\n  s.color = vec3(0.0f, 0.0f, 0.0f);"},
    // A displacement along the line to the eye, which is the origin.
    {"near_light", "lights/point.glsl", "vec3 way = point_position(light) - p;",
     "vec3 way = 0.999f * point_position(light) - p;"},
    {"bit", "lights/point.glsl", "vec3 way = point_position(light) - p;",
     "light.a.x = uintBitsToFloat(floatBitsToUint(light.a.x) ^ 1u);\n  vec3 way = point_position(light) - "
     "p;"},
    {"materials", "geometry/surface.glsl", "  return primitive;",
     "  if (material_of(primitive) == 1u) primitive.material_and_kind -= 1u;\n  return primitive;"},
    // Results of pixels.
    {"nan", "kernels/pixel.glsl", "  return sample_result(positive_zeros(color)",
     "  if (x == 0u && y == frame.height / 2u) color.y = uintBitsToFloat(0x7fc00000u);\n"
     "  return sample_result(positive_zeros(color)"},
    {"black", "kernels/pixel.glsl", "sample_result(positive_zeros(color)",
     "sample_result(vec3(0.0f, 0.0f, 0.0f)"},
    {"stale", "kernels/pixel.glsl", "  Ray ray;\n  if (!camera_ray(frame, x, y, index, ray)) return",
     "  if (x + 1u == frame.width && y + 1u == frame.height) {\n    x = 0u;\n    y = 0u;\n  }\n"
     "  Ray ray;\n  if (!camera_ray(frame, x, y, index, ray)) return"},
    {"shift", "kernels/render.comp.glsl", "dispatch.tile_x + pixel.x", "dispatch.tile_x + 1u + pixel.x"},
};

// Makes the folder `folder`/NAME, for --shaders, with the one file that the fault changes. Returns its path.
inline std::string lay_fault(const TemporaryFolder& folder, const std::string& name) {
  const auto fault = std::ranges::find(faults, name, &Fault::name);
  if (fault == std::end(faults)) throw std::runtime_error("no fault is called " + name);
  lay_changed_shader(folder / name, fault->file, fault->from, fault->to);
  return folder / name;
}

}  // namespace eyeray::engine::test
