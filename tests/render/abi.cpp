// records.h means the same on both sides: the offsets that the SPIR-V was given, by name, against offsetof.
#include <cstddef>

#include "host/gpu/reflect.hpp"
#include "random_scene.hpp"
#include "support.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray;

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
  PackedScene scene = pack(described);
  REQUIRE(scene.has_bvh);
  REQUIRE(scene.frame.counts.z == 1);  // whitted
  scene.media.push_back({});
  scene.lights.push_back({});
  const gpu::Reflection samples = gpu::reflect(test::compile_entry("kernels/render.comp.glsl", scene, {}));
  check_struct(samples, "Primitive", sizeof(shader::Primitive),
               {MEMBER(Primitive, head), MEMBER(Primitive, a), MEMBER(Primitive, b), MEMBER(Primitive, c)});
  check_struct(samples, "Bvh", sizeof(shader::Bvh),
               {MEMBER(Bvh, origin), MEMBER(Bvh, step), MEMBER(Bvh, extent), MEMBER(Bvh, head)});
  check_struct(samples, "Instance", sizeof(shader::Instance),
               {MEMBER(Instance, head), MEMBER(Instance, to_local), MEMBER(Instance, to_world)});
  check_struct(samples, "Material", sizeof(shader::Material),
               {MEMBER(Material, head), MEMBER(Material, textures), MEMBER(Material, parameters),
                MEMBER(Material, mask)});
  check_struct(samples, "Medium", sizeof(shader::Medium), {MEMBER(Medium, absorption_ior)});
  check_struct(
      samples, "Texture", sizeof(shader::Texture),
      {MEMBER(Texture, even), MEMBER(Texture, odd), MEMBER(Texture, frequency), MEMBER(Texture, image)});
  check_struct(samples, "Light", sizeof(shader::Light),
               {MEMBER(Light, head), MEMBER(Light, position), MEMBER(Light, intensity)});
  check_struct(
      samples, "Frame", sizeof(shader::Frame),
      {MEMBER(Frame, image), MEMBER(Frame, camera), MEMBER(Frame, counts), MEMBER(Frame, right),
       MEMBER(Frame, up), MEMBER(Frame, forward), MEMBER(Frame, background), MEMBER(Frame, ambient)});
  check_struct(samples, "Dispatch", sizeof(shader::Dispatch),
               {MEMBER(Dispatch, tile), MEMBER(Dispatch, sample_index)});
  check_struct(samples, "SampleResult", sizeof(shader::SampleResult),
               {MEMBER(SampleResult, color), MEMBER(SampleResult, counts)});
  CHECK(samples.push_constant_bytes == sizeof(shader::Dispatch));

  const gpu::Reflection waves =
      gpu::reflect(test::compile_entry("kernels/wavefront.comp.glsl", scene, {}, "#define STORED_HITS 1\n"));
  check_struct(waves, "PacketHit", sizeof(shader::PacketHit),
               {MEMBER(PacketHit, hit), MEMBER(PacketHit, uv)});
  check_struct(waves, "PathState", sizeof(shader::PathState),
               {MEMBER(PathState, origin), MEMBER(PathState, direction), MEMBER(PathState, throughput)});

  const gpu::Reflection hits =
      gpu::reflect(test::compile_entry("kernels/render.comp.glsl", scene, {}, "#define FIRST_HITS\n"));
  check_struct(hits, "HitResult", sizeof(shader::HitResult),
               {MEMBER(HitResult, position_t), MEMBER(HitResult, normal), MEMBER(HitResult, uv),
                MEMBER(HitResult, ids)});
  const gpu::Reflection query = gpu::reflect(test::compile_entry("kernels/query.comp.glsl", scene, {}));
  check_struct(query, "QueryRay", sizeof(shader::QueryRay),
               {MEMBER(QueryRay, origin), MEMBER(QueryRay, direction)});
  check_struct(query, "QueryHit", sizeof(shader::QueryHit), {MEMBER(QueryHit, hit)});
}
