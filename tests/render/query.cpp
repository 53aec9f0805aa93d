// Kernel against twin, ray by ray: hits do not depend on where the shader runs nor on how it was specialised.
#include <fmt/format.h>

#include "gpu/command_list.hpp"
#include "random_scene.hpp"
#include "support.hpp"
#include "twin/shader_functions.hpp"

#include "support/doctest.hpp"

using namespace eyeray;

namespace {

std::vector<shader::QueryHit> trace_on_gpu(gpu::Device& device, const PackedScene& scene,
                                           std::span<const shader::QueryRay> rays,
                                           const Specialisation& specialisation) {
  const gpu::DiskCache cache = gpu::DiskCache::of_user();
  const std::vector<uint32_t> spirv = gpu::strict_floats(
      test::compile_entry("query.comp.glsl", scene, specialisation), device.info().float_modes);
  gpu::Kernel kernel(device, spirv, "query.comp.glsl", cache);
  const auto buffer = [&](uint32_t binding, const char* name, std::span<const std::byte> bytes) {
    gpu::Buffer result(device, std::max(bytes.size(), size_t{64}), name);
    if (!bytes.empty()) result.upload(bytes);
    kernel.set_buffer(binding, result);
    return result;
  };
  const gpu::Buffer primitives =
      buffer(BINDING_PRIMITIVES, "primitives", std::as_bytes(std::span(scene.primitives)));
  const gpu::Buffer vertices = buffer(BINDING_VERTICES, "vertices", {});
  const gpu::Buffer materials =
      buffer(BINDING_MATERIALS, "materials", std::as_bytes(std::span(scene.materials)));
  const gpu::Buffer textures = buffer(BINDING_TEXTURES, "textures", std::as_bytes(std::span(scene.textures)));
  const gpu::Buffer texels = buffer(BINDING_TEXELS, "texels", {});
  const gpu::Buffer media = buffer(BINDING_MEDIA, "media", std::as_bytes(std::span(scene.media)));
  const gpu::Buffer lights = buffer(BINDING_LIGHTS, "lights", {});
  const gpu::Buffer frame = buffer(BINDING_FRAME, "frame", std::as_bytes(std::span(&scene.frame, 1)));
  const gpu::Buffer queries = buffer(BINDING_RAYS, "rays", std::as_bytes(rays));
  gpu::Buffer results(device, rays.size() * sizeof(shader::QueryHit), "hits");
  kernel.set_buffer(BINDING_OUTPUT, results);
  shader::Dispatch push{};
  push.tile.x = uint32_t(rays.size());
  gpu::dispatch(device, kernel, std::as_bytes(std::span(&push, 1)), {uint32_t(rays.size() + 63) / 64, 1, 1});
  return results.read_records<shader::QueryHit>(rays.size());
}

std::vector<shader::QueryHit> trace_on_twin(const PackedScene& scene,
                                            std::span<const shader::QueryRay> rays) {
  const shader::Binding binding(scene);
  std::vector<shader::QueryHit> hits;
  for (const shader::QueryRay& r : rays) {
    const shader::Ray ray = shader::make_ray(shader::vec3(r.origin), shader::vec3(r.direction));
    const shader::Hit hit = shader::trace(ray);
    hits.push_back(
        {{shader::floatBitsToUint(hit.t), hit.primitive, shader::occlusion(ray, r.direction.w), 0}});
  }
  return hits;
}

}  // namespace

TEST_CASE("trace and occlusion: every bit is the same on the GPU, unrolled or looping, and on the twin") {
  gpu::Device device({});
  test::Random random(7);
  for (int round = 0; round < 6; ++round) {
    const PackedScene scene = test::random_scene(random, 1 + round);
    std::vector<shader::QueryRay> rays(100'000);
    for (shader::QueryRay& ray : rays) ray = test::random_ray(random);
    const std::vector<shader::QueryHit> twin = trace_on_twin(scene, rays);
    for (const bool constants : {true, false}) {
      Specialisation specialisation;
      specialisation.constants = constants;
      const std::vector<shader::QueryHit> gpu = trace_on_gpu(device, scene, rays, specialisation);
      int different = 0;
      int hits = 0;
      for (size_t i = 0; i < rays.size(); ++i) {
        different += gpu[i].hit != twin[i].hit;
        hits += twin[i].hit.y != NONE;
      }
      MESSAGE(fmt::format("{} primitives, {}: {} of {} rays hit, {} differ", scene.primitives.size(),
                          constants ? "unrolled" : "looping", hits, rays.size(), different));
      CHECK(hits > 40'000);
      CHECK(different == 0);
    }
  }
}
