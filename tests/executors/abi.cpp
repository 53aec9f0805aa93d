// records.h means the same on both sides: the offsets that the SPIR-V was given, by name, against offsetof.
#include <cstddef>
#include <map>
#include <regex>

#include "host/executors/shader_probe.hpp"
#include "host/gpu/reflect.hpp"
#include "host/scene/integrator.hpp"
#include "tests/support/entries.hpp"
#include "tests/support/random_scene.hpp"

#include "tests/support/doctest.hpp"
#include "tests/support/process.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::records;

namespace {

const gpu::ReflectedStruct* find(const gpu::Reflection& reflection, std::string_view name) {
  for (const gpu::ReflectedStruct& s : reflection.structs)
    if (s.name == name) return &s;
  return nullptr;
}

struct Expected {
  const char* member;
  size_t offset;
};

void check_struct(const gpu::Reflection& reflection, const char* name, size_t size,
                  std::vector<Expected> members) {
  CAPTURE(name);
  const gpu::ReflectedStruct* reflected = find(reflection, name);
  REQUIRE(reflected != nullptr);
  CHECK(reflected->size == size);
  REQUIRE(reflected->members.size() == members.size());
  for (size_t i = 0; i < members.size(); ++i) {
    CHECK(reflected->members[i].name == members[i].member);
    CHECK(reflected->members[i].offset == members[i].offset);
  }
}

#define MEMBER(type, name)              \
  Expected {                            \
    #name, offsetof(shader::type, name) \
  }

}  // namespace

TEST_CASE("every record has the same members at the same offsets in SPIR-V and in C++") {
  test::Random random(1);
  Scene described = test::random_scene(random, 2);
  const int cube = test::add(described, test::cube());
  test::add_instance(described, cube, 0);
  test::add_instance(described, cube, 0, test::translation({3, 0, 0}));
  PackedScene scene = pack::pack(described);
  REQUIRE(scene.has_bvh);
  REQUIRE(scene.frame.integrator == 1);  // whitted
  scene.media.push_back({});
  scene.lights.push_back({});
  const gpu::Reflection samples = gpu::reflect(test::compile_entry("kernels/render.comp.glsl", scene, {}));
  check_struct(samples, "Primitive", sizeof(shader::Primitive),
               {MEMBER(Primitive, id), MEMBER(Primitive, material_and_kind), MEMBER(Primitive, optical_depth),
                MEMBER(Primitive, extra), MEMBER(Primitive, a), MEMBER(Primitive, b), MEMBER(Primitive, c)});
  check_struct(samples, "Bvh", sizeof(shader::Bvh),
               {MEMBER(Bvh, origin), MEMBER(Bvh, unused_0), MEMBER(Bvh, step), MEMBER(Bvh, unused_1),
                MEMBER(Bvh, extent), MEMBER(Bvh, slack), MEMBER(Bvh, root), MEMBER(Bvh, first_slot),
                MEMBER(Bvh, end_slot), MEMBER(Bvh, unused_2)});
  check_struct(samples, "Instance", sizeof(shader::Instance),
               {MEMBER(Instance, bvh), MEMBER(Instance, first_id), MEMBER(Instance, material),
                MEMBER(Instance, depth_or_triangle), MEMBER(Instance, to_local), MEMBER(Instance, to_world)});
  check_struct(samples, "Material", sizeof(shader::Material),
               {MEMBER(Material, kind),
                MEMBER(Material, flags),
                MEMBER(Material, medium),
                MEMBER(Material, optical_depth),
                MEMBER(Material, base),
                MEMBER(Material, specular),
                MEMBER(Material, reflected),
                MEMBER(Material, ambient),
                MEMBER(Material, emission),
                MEMBER(Material, alpha),
                MEMBER(Material, alpha_cutoff),
                MEMBER(Material, shininess),
                MEMBER(Material, a),
                MEMBER(Material, color),
                MEMBER(Material, roughness),
                MEMBER(Material, metallic),
                MEMBER(Material, coat),
                MEMBER(Material, b),
                MEMBER(Material, c),
                MEMBER(Material, coat_roughness),
                MEMBER(Material, specular_level),
                MEMBER(Material, transmission),
                MEMBER(Material, specular_color),
                MEMBER(Material, sheen),
                MEMBER(Material, sheen_roughness),
                MEMBER(Material, normal_map),
                MEMBER(Material, normal_scale),
                MEMBER(Material, bump),
                MEMBER(Material, bump_height),
                MEMBER(Material, bump_width),
                MEMBER(Material, coat_normal),
                MEMBER(Material, coat_normal_scale),
                MEMBER(Material, diffuse_transmission),
                MEMBER(Material, diffuse_transmission_color),
                MEMBER(Material, anisotropy),
                MEMBER(Material, anisotropy_direction),
                MEMBER(Material, anisotropy_turn),
                MEMBER(Material, iridescence),
                MEMBER(Material, iridescence_thickness),
                MEMBER(Material, iridescence_least),
                MEMBER(Material, iridescence_most),
                MEMBER(Material, iridescence_ior),
                MEMBER(Material, unused)});
  check_struct(samples, "Medium", sizeof(shader::Medium),
               {MEMBER(Medium, absorption), MEMBER(Medium, ior), MEMBER(Medium, scattering),
                MEMBER(Medium, anisotropy), MEMBER(Medium, spread), MEMBER(Medium, unused_0),
                MEMBER(Medium, unused_1), MEMBER(Medium, unused_2)});
  check_struct(samples, "Texture", sizeof(shader::Texture),
               {MEMBER(Texture, color), MEMBER(Texture, kind), MEMBER(Texture, a), MEMBER(Texture, b),
                MEMBER(Texture, c)});
  check_struct(samples, "Light", sizeof(shader::Light),
               {MEMBER(Light, intensity), MEMBER(Light, kind), MEMBER(Light, a), MEMBER(Light, b)});
  check_struct(samples, "Frame", sizeof(shader::Frame),
               {MEMBER(Frame, width),
                MEMBER(Frame, height),
                MEMBER(Frame, seed),
                MEMBER(Frame, samples_per_side),
                MEMBER(Frame, camera),
                MEMBER(Frame, pattern),
                MEMBER(Frame, media),
                MEMBER(Frame, max_depth),
                MEMBER(Frame, light_count),
                MEMBER(Frame, loop_probe),
                MEMBER(Frame, integrator),
                MEMBER(Frame, triangle_method),
                MEMBER(Frame, right),
                MEMBER(Frame, min_throughput),
                MEMBER(Frame, up),
                MEMBER(Frame, pixel_width),
                MEMBER(Frame, forward),
                MEMBER(Frame, pixel_height),
                MEMBER(Frame, background),
                MEMBER(Frame, emitter_count),
                MEMBER(Frame, ambient),
                MEMBER(Frame, aperture),
                MEMBER(Frame, sharpness),
                MEMBER(Frame, blade_rotation),
                MEMBER(Frame, blades),
                MEMBER(Frame, pixel_filter),
                MEMBER(Frame, environment_width),
                MEMBER(Frame, environment_height),
                MEMBER(Frame, environment_numbers),
                MEMBER(Frame, environment_turn),
                MEMBER(Frame, filter_width),
                MEMBER(Frame, light_bvh_numbers),
                MEMBER(Frame, camera_formula),
                MEMBER(Frame, has_medium_extent),
                MEMBER(Frame, medium_min),
                MEMBER(Frame, medium_decay),
                MEMBER(Frame, medium_max),
                MEMBER(Frame, medium_base)});
  check_struct(samples, "Dispatch", sizeof(shader::Dispatch),
               {MEMBER(Dispatch, tile_x), MEMBER(Dispatch, tile_y), MEMBER(Dispatch, tile_width),
                MEMBER(Dispatch, tile_height), MEMBER(Dispatch, sample_index), MEMBER(Dispatch, depth),
                MEMBER(Dispatch, count), MEMBER(Dispatch, stride)});
  check_struct(samples, "SampleResult", sizeof(shader::SampleResult),
               {MEMBER(SampleResult, color), MEMBER(SampleResult, trail), MEMBER(SampleResult, rays),
                MEMBER(SampleResult, hits), MEMBER(SampleResult, flags), MEMBER(SampleResult, iterations)});
  const std::string probing =
      executors::ShaderProbe(test::entry_source("kernels/render.comp.glsl", scene, {}).files).defines();
  check_struct(gpu::reflect(test::compile_entry("kernels/render.comp.glsl", scene, {.ray_kinds = true},
                                                probing.c_str())),
               "ProbeRecord", sizeof(shader::ProbeRecord),
               {MEMBER(ProbeRecord, name), MEMBER(ProbeRecord, line), MEMBER(ProbeRecord, type),
                MEMBER(ProbeRecord, size), MEMBER(ProbeRecord, value)});
  CHECK(samples.push_constant_bytes == sizeof(shader::Dispatch));
  PackedScene paths = scene;
  paths.frame.integrator = uint32_t(IntegratorType::path);
  paths.emitters.resize(2);
  check_struct(gpu::reflect(test::compile_entry("kernels/render.comp.glsl", paths, {})), "Emitter",
               sizeof(shader::Emitter),
               {MEMBER(Emitter, radiance), MEMBER(Emitter, kind), MEMBER(Emitter, a), MEMBER(Emitter, b),
                MEMBER(Emitter, c), MEMBER(Emitter, primitive), MEMBER(Emitter, end), MEMBER(Emitter, area),
                MEMBER(Emitter, offset), MEMBER(Emitter, trail), MEMBER(Emitter, texture),
                MEMBER(Emitter, corners), MEMBER(Emitter, side)});
  PackedScene gathering = paths;
  gathering.frame.integrator = uint32_t(IntegratorType::sppm);
  const gpu::Reflection sending = gpu::reflect(
      test::compile_entry("kernels/photons.comp.glsl", gathering, {}, "#define SENDS_PHOTONS\n"));
  check_struct(
      sending, "Photon", sizeof(shader::Photon),
      {MEMBER(Photon, position), MEMBER(Photon, key), MEMBER(Photon, direction), MEMBER(Photon, number),
       MEMBER(Photon, normal), MEMBER(Photon, depth), MEMBER(Photon, flux), MEMBER(Photon, unused)});
  check_struct(sending, "PhotonResult", sizeof(shader::PhotonResult),
               {MEMBER(PhotonResult, trail), MEMBER(PhotonResult, flags), MEMBER(PhotonResult, rays),
                MEMBER(PhotonResult, stored)});
  check_struct(sending, "PhotonPass", sizeof(shader::PhotonPass),
               {MEMBER(PhotonPass, center), MEMBER(PhotonPass, reach), MEMBER(PhotonPass, radius_squared),
                MEMBER(PhotonPass, height), MEMBER(PhotonPass, cells), MEMBER(PhotonPass, scale),
                MEMBER(PhotonPass, key_mask), MEMBER(PhotonPass, capacity), MEMBER(PhotonPass, target_count),
                MEMBER(PhotonPass, unused), MEMBER(PhotonPass, targets)});

  const gpu::Reflection wavefront =
      gpu::reflect(test::compile_entry("kernels/wavefront.comp.glsl", scene, {}, "#define STORED_HITS 1\n"));
  check_struct(
      wavefront, "PacketHit", sizeof(shader::PacketHit),
      {MEMBER(PacketHit, t), MEMBER(PacketHit, slot), MEMBER(PacketHit, id), MEMBER(PacketHit, flags),
       MEMBER(PacketHit, u), MEMBER(PacketHit, v), MEMBER(PacketHit, unused_0), MEMBER(PacketHit, unused_1)});
  check_struct(wavefront, "PathState", sizeof(shader::PathState),
               {MEMBER(PathState, origin), MEMBER(PathState, media), MEMBER(PathState, direction),
                MEMBER(PathState, density), MEMBER(PathState, throughput), MEMBER(PathState, pixel),
                MEMBER(PathState, normal), MEMBER(PathState, unused_0), MEMBER(PathState, point),
                MEMBER(PathState, unused_1)});

  const gpu::Reflection hits =
      gpu::reflect(test::compile_entry("kernels/render.comp.glsl", scene, {}, "#define FIRST_HITS\n"));
  check_struct(hits, "HitResult", sizeof(shader::HitResult),
               {MEMBER(HitResult, position), MEMBER(HitResult, t), MEMBER(HitResult, normal),
                MEMBER(HitResult, u), MEMBER(HitResult, normal_geometric), MEMBER(HitResult, v),
                MEMBER(HitResult, cosine), MEMBER(HitResult, primitive), MEMBER(HitResult, material),
                MEMBER(HitResult, flags), MEMBER(HitResult, nodes), MEMBER(HitResult, tests),
                MEMBER(HitResult, unused_0), MEMBER(HitResult, unused_1)});
  const gpu::Reflection query = gpu::reflect(test::compile_entry("kernels/query.comp.glsl", scene, {}));
  check_struct(query, "QueryRay", sizeof(shader::QueryRay),
               {MEMBER(QueryRay, origin), MEMBER(QueryRay, unused), MEMBER(QueryRay, direction),
                MEMBER(QueryRay, t_max)});
  check_struct(query, "QueryHit", sizeof(shader::QueryHit),
               {MEMBER(QueryHit, t), MEMBER(QueryHit, primitive), MEMBER(QueryHit, flags),
                MEMBER(QueryHit, occlusion)});
}

TEST_CASE("no two bindings of the buffers have one number") {
  const std::string text = test::read_text("shaders/records.h");
  const std::regex row("#define (BINDING_\\w+) (\\d+)");
  std::map<std::string, std::string> by_number;
  for (std::sregex_iterator it(text.begin(), text.end(), row), end; it != end; ++it) {
    const std::string number = (*it)[2], name = (*it)[1];
    const auto added = by_number.emplace(number, name);
    CHECK_MESSAGE(added.second, name, " and ", added.first->second, " are ", number);
  }
  CHECK(by_number.size() > 10);
}
