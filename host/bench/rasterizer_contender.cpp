#include "host/bench/rasterizer_contender.hpp"

#include <cmath>

#include "host/core/error.hpp"
#include "host/core/stopwatch.hpp"

namespace eyeray::bench {

RasterizerContender::RasterizerContender(const Scene& scene, const std::string& device)
    : projection_(scene, {0, 0, scene.image.width, scene.image.height}),
      device_({.select = device, .draws = true}),
      rasterizer_(device_, raster::raster_shaders(), scene.image.width, scene.image.height),
      build_{"rasteriser", 0, 0} {
  for (const auto& [why, count] : projection_.list().not_drawn())
    throw Error(ExitCode::bad_input, "{} of its primitives are not drawn: {}", count, why);
  const Stopwatch watch;
  projection_.for_each_batch([&](std::span<const gpu::RasterVertex> vertices) {
    vertices_.insert(vertices_.end(), vertices.begin(), vertices.end());
  });
  build_.seconds = watch.seconds();
  build_.bytes = vertices_.size() * sizeof(gpu::RasterVertex);
}

Contender RasterizerContender::contender() {
  return {build_.contender, ContenderKind::rasterizer,
          [this](const Batch& batch, std::span<QueryHit> hits) { return draw(batch, hits); }};
}

double RasterizerContender::draw(const Batch& batch, std::span<QueryHit> hits) {
  CHECK_EQ(batch.name, "primary");
  const Stopwatch watch;
  rasterizer_.clear();
  rasterizer_.draw(vertices_);
  const double seconds = watch.seconds();

  const gpu::RasterPicture picture = rasterizer_.read();
  const Rect& area = projection_.view().area();
  const std::vector<uint32_t> pixels = primary_pixels(area.width, area.height);
  CHECK_EQ(pixels.size(), hits.size());
  for (size_t i = 0; i < hits.size(); ++i) {
    const uint32_t pixel = pixels[i];
    hits[i] = {HUGE_VAL, -1};
    if (picture.ids[pixel] == 0) continue;
    const int x = int(pixel) % area.width, y = int(pixel) / area.width;
    hits[i] = {projection_.view().t(x, y, projection_.nearness(picture.depths[pixel])),
               int64_t{picture.ids[pixel]} - 1};
  }
  return seconds;
}

}  // namespace eyeray::bench
