#include "host/raster/projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "host/core/embedded_shaders.hpp"
#include "host/core/error.hpp"
#include "host/gpu/shader_compiler.hpp"

namespace eyeray::engine::raster {

Projection::Projection(const Scene& scene, const Rect& area)
    : view_(scene.camera, scene.image.size(), area), list_(scene, view_) {
  // Depths run from 0, the farthest point, to 1: floats are most precise near 0.
  double least = std::numeric_limits<double>::infinity(), most = -least;
  list_.for_each([&](const ScreenTriangle& triangle) {
    for (const Vec3& corner : triangle.at) {
      least = std::min(least, corner.z);
      most = std::max(most, corner.z);
    }
    ++triangles_;
  });
  if (triangles_ == 0) return;
  high_ = most;
  low_ = view_.perspective() ? 0 : least - std::max(0x1p-10 * (most - least), 1e-3 * std::fabs(most) + 1e-12);
}

void Projection::for_each_batch(const std::function<void(std::span<const gpu::RasterVertex>)>& visit) const {
  const Rect& area = view_.area();
  std::vector<gpu::RasterVertex> vertices;
  const auto flush = [&] {
    visit(vertices);
    vertices.clear();
  };
  list_.for_each([&](const ScreenTriangle& triangle) {
    for (const Vec3& corner : triangle.at)
      vertices.push_back({float(2 * corner.x / area.width - 1), float(2 * corner.y / area.height - 1),
                          float((corner.z - low_) / (high_ - low_)), triangle.id + 1});
    if (vertices.size() == 3 * gpu::Rasterizer::batch) flush();
  });
  flush();
}

gpu::RasterShaders raster_shaders() {
  const auto provide = [](std::string_view path) -> std::optional<std::string> {
    const auto files = embedded_shaders();
    const auto found = std::ranges::find(files, path, &EmbeddedFile::name);
    return found == files.end() ? std::nullopt : std::optional<std::string>(found->text);
  };
  const auto compiled = [&](std::string_view entry) {
    return of_own_input([&] { return gpu::compile_shader(gpu::read_shader(provide, entry), "").spirv; });
  };
  return {compiled("kernels/raster.vert.glsl"), compiled("kernels/raster.frag.glsl")};
}

}  // namespace eyeray::engine::raster
