#include "host/raster/witness.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/error.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::raster {
namespace {

// The largest displacement, in pixels, of a float32 ray: the neighbourhood of gates B and C.
constexpr double ray_error = 0.004;
constexpr double epsilon = 0x1p-24;

}  // namespace

Witness::Witness(const Scene& scene, const Rect& area, gpu::DeviceOptions options)
    : scene_(scene), projection_(scene, area) {
  options.draws = true;
  gpu::Device device(options);
  device_ = device.info().name;
  gpu::Rasterizer rasterizer(device, raster_shaders(), area.width, area.height);
  projection_.for_each_batch([&](std::span<const gpu::RasterVertex> vertices) { rasterizer.draw(vertices); });
  picture_ = rasterizer.read();
  if (const auto messages = device.validation_messages(); !messages.empty())
    throw Error(ExitCode::no_device, "the validation layer has {} complaints about drawing; the first: {}",
                messages.size(), messages[0]);

  // Corners are rounded to the driver's grid, and to floats in a region some pictures wide. The planes
  // through them are rounded to floats at the picture's far side.
  const double longest = std::max({area.width, area.height, 64});
  exactness_.snap = ray_error + std::sqrt(2.0) * std::ldexp(1.0, -int(device.info().limits.subpixel_bits)) +
                    32 * epsilon * longest;
  exactness_.depth_error = 8 * epsilon;
  exactness_.depth_floor = projection_.nearness(0);
}

Seen Witness::drawn_at(size_t pixel) const {
  const uint32_t id = picture_.ids[pixel];
  if (id == 0) return {};
  return {true, true, id - 1, projection_.nearness(picture_.depths[pixel])};
}

Seen Witness::traced_at(const compare::Frame& frame, size_t pixel) const {
  const FirstHit& hit = frame.first_hits[pixel];
  if (hit.primitive < 0) return {};
  const auto id = uint64_t(hit.primitive);
  // An invalid id must not count as a primitive that is not drawn, which would excuse it.
  const bool in_list = id >= scene_.primitive_count() || list().draws(id);
  const auto width = size_t(view().area().width);
  return {true, in_list, uint32_t(hit.primitive),
          view().nearness(int(pixel % width), int(pixel / width), hit.t)};
}

// Checks that a hit's position lies on the ray of its pixel, at the distance t. Empty if so; else a clause
// that names the pixel distance and the t of the position.
std::string Witness::misplaced(const FirstHit& hit, int x, int y) const {
  const Vec3 at = view().to_camera(hit.position);
  if (!(hit.t > 0) || !std::isfinite(hit.t) || !std::isfinite(magnitude(at)))
    return "its t or its position is not a number";
  const Vec3 drawn = view().project(Vec4(at, 1.0));
  const Vec2 center(x + 0.5, y + 0.5);
  const double nearness = view().nearness(x, y, hit.t);
  const double distance = glm::length(Vec2(drawn) - center), off = std::fabs(drawn.z - nearness);
  const auto within = [&](double error) {
    const Vec2 room = view().shift(center.x, center.y, nearness, error);
    return distance <= room.x + ray_error && off <= room.y;
  };
  // Only now compute the object's reach, which takes time: it matters for large objects that are close.
  const double error = 2 * exactness_.t * hit.t;
  if (within(error)) return "";
  if (uint64_t(hit.primitive) < scene_.primitive_count()) {
    const double reach = list().reach(uint64_t(hit.primitive));
    if (within(error + 2 * coordinate_error * reach / std::max(std::fabs(hit.cosine), 0.01))) return "";
  }
  return fmt::format("its position falls {:.2g} pixels away from its pixel, and at t {:.9g}", distance,
                     view().t(x, y, drawn.z));
}

std::vector<std::vector<ScreenTriangle>> Witness::triangles_about(const std::vector<size_t>& pixels) const {
  std::vector<std::vector<ScreenTriangle>> about(pixels.size());
  if (pixels.empty()) return about;
  const Rect& area = view().area();
  std::vector<int32_t> number(size_t(area.pixels()), -1);
  for (size_t i = 0; i < pixels.size(); ++i) number[pixels[i]] = int32_t(i);
  const Vec2 size(area.width, area.height);
  list().for_each([&](const ScreenTriangle& triangle) {
    // The slack in pixels is largest at one of the area's corners.
    double most = 0;
    for (const Vec2& corner : {Vec2(0, 0), Vec2(size.x, 0), Vec2(0, size.y), size})
      most = std::max(most, slack(triangle, corner, view(), exactness_, true).x);
    Vec2 low(triangle.at[0]), high = low;
    for (const Vec3& corner : triangle.at)
      low = glm::min(low, Vec2(corner)), high = glm::max(high, Vec2(corner));
    low = glm::clamp(glm::ceil(low - most - 0.5), Vec2(0), size);
    high = glm::clamp(glm::floor(high + most - 0.5) + 1.0, Vec2(0), size);
    for (int y = int(low.y); y < int(high.y); ++y) {
      for (int x = int(low.x); x < int(high.x); ++x) {
        const int32_t at = number[size_t(y) * size_t(area.width) + size_t(x)];
        const Vec2 center(x + 0.5, y + 0.5);
        if (at >= 0 && distance(triangle, center) <= slack(triangle, center, view(), exactness_, true).x)
          about[size_t(at)].push_back(triangle);
      }
    }
  });
  return about;
}

compare::RasterResult Witness::compare(const compare::Frame& frame, const std::string& name) const {
  const Rect& area = view().area();
  CHECK(frame.area == area);
  compare::RasterResult result;
  result.value = name;
  result.device = device_;
  result.triangles = projection_.triangles();
  result.not_drawn = list().not_drawn();
  result.pixels = area.pixels();
  const auto at = [&](size_t pixel) { return glm::ivec2(int(pixel) % area.width, int(pixel) / area.width); };
  const auto show = [&](size_t pixel, const std::string& difference) {
    const Seen drawn = drawn_at(pixel);
    result.pixel = {area.x + at(pixel).x, area.y + at(pixel).y};
    result.difference = difference;
    result.traced = frame.first_hits[pixel];
    result.drawn = drawn.anything ? int32_t(drawn.id) : -1;
    result.drawn_t = view().t(at(pixel).x, at(pixel).y, drawn.nearness);
  };
  const auto fail = [&](size_t pixel, const std::string& difference) {
    if (result.unexplained++ == 0) show(pixel, difference);
  };

  // Count the equal pixels, which most are.
  std::vector<size_t> open;
  for (size_t pixel = 0; pixel < size_t(area.pixels()); ++pixel) {
    const FirstHit& hit = frame.first_hits[pixel];
    const std::string why = hit.primitive >= 0 ? misplaced(hit, at(pixel).x, at(pixel).y) : "";
    const Seen drawn = drawn_at(pixel), traced = traced_at(frame, pixel);
    const bool equal =
        traced.anything == drawn.anything && traced.in_list && traced.id == drawn.id &&
        std::fabs(traced.nearness - drawn.nearness) <= view().nearness_error(traced.nearness, exactness_.t);
    if (!why.empty())
      fail(pixel, why);
    else if (equal)
      ++result.equal;
    else
      open.push_back(pixel);
  }

  // For each other pixel, judge whether the geometry allows both the hit and the drawn triangle.
  const std::vector<std::vector<ScreenTriangle>> about = triangles_about(open);
  for (size_t i = 0; i < open.size(); ++i) {
    const size_t pixel = open[i];
    const Judgement judgement =
        judge(traced_at(frame, pixel), drawn_at(pixel), Vec2(at(pixel)) + 0.5, about[i], view(), exactness_);
    switch (judgement.verdict) {
      case Judgement::equal:
        ++result.equal;
        break;
      case Judgement::hidden:
        ++result.hidden;
        break;
      case Judgement::explained:
        if (result.unexplained == 0 && result.explained_pixels() == 0)
          show(pixel, compare::name(judgement.cause));
        ++result.explained[size_t(judgement.cause)];
        break;
      case Judgement::unexplained:
        fail(pixel, judgement.blames_ray ? "the ray hits a primitive that cannot be there"
                                         : "the rasteriser draws a primitive that cannot be there");
    }
  }
  return result;
}

}  // namespace eyeray::engine::raster
