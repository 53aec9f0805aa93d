#include "host/executors/primary_raster.hpp"

#include <array>
#include <span>

#include "host/core/error.hpp"
#include "host/raster/projection.hpp"
#include "host/scene/sampler.hpp"

namespace eyeray::executors {
namespace {

void check_places(const ImageSettings& image) {
  const bool alike = image.pattern == SamplePattern::regular;
  if (!alike || image.filter != PixelFilter::box)
    throw Error(
        ExitCode::bad_input,
        "--primary raster draws one place of every pixel, the same in all, and {}: leave out --primary, or "
        "set image.pattern=\"regular\" and image.filter=\"box\"",
        alike ? "a filter has its own" : "this scene's `pattern` chooses another in each");
}

// What stands for each primitive that is drawn: DRAWN_OTHER but for triangles of the world's BVH.
std::vector<uint32_t> drawn_by_id(const Scene& scene, const records::PackedScene& packed) {
  std::vector<uint32_t> drawn(scene.primitive_count(), DRAWN_OTHER);
  for (uint32_t slot = packed.linear_ends.back(); slot < packed.primitives.size(); ++slot)
    if (kind_of(packed.primitives[slot]) == shader::KIND_triangle)
      drawn[packed.primitives[slot].id] = slot + 1;
  return drawn;
}

std::vector<gpu::RasterVertex> vertices_of(const Scene& scene, const records::PackedScene& packed) {
  const raster::Projection projection(scene, {0, 0, scene.image.width, scene.image.height});
  check_places(scene.image);
  for (const auto& [why, count] : projection.list().not_drawn())
    throw Error(ExitCode::bad_input,
                "--primary raster cannot draw {} of this scene's primitives ({}): leave out --primary", count,
                why);
  const std::vector<uint32_t> drawn = drawn_by_id(scene, packed);
  std::vector<gpu::RasterVertex> vertices;
  projection.for_each_batch([&](std::span<const gpu::RasterVertex> some) {
    for (gpu::RasterVertex vertex : some) {
      vertex.id = drawn[vertex.id - 1];
      vertices.push_back(vertex);
    }
  });
  return vertices;
}

}  // namespace

PrimaryRaster::PrimaryRaster(gpu::Device& device, const Scene& scene, const records::PackedScene& packed)
    : width_(scene.image.width),
      height_(scene.image.height),
      samples_per_side_(packed.frame.samples_per_side),
      vertices_(vertices_of(scene, packed)),
      rasterizer_(device, raster::raster_shaders(), width_, height_),
      drawn_(device, size_t(width_) * size_t(height_) * sizeof(uint32_t), "drawn ids") {}

void PrimaryRaster::draw(uint32_t index) {
  if (sample_ == index) return;
  // All moves against the sample's place (samplers/grid.glsl), so that this lies in the pixel's middle.
  const double side = samples_per_side_;
  const double x = (index % samples_per_side_ + 0.5) / side - 0.5,
               y = (index / samples_per_side_ + 0.5) / side - 0.5;
  rasterizer_.clear();
  rasterizer_.draw(vertices_, {float(-2 * x / width_), float(-2 * y / height_)});
  rasterizer_.copy_ids(drawn_);
  sample_ = index;
}

}  // namespace eyeray::executors
