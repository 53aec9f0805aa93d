#include "host/importers/line_builder.hpp"

#include <fmt/format.h>

#include "host/importers/malformed.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::importers {

namespace {

// Limit on a file's segments, each of which becomes a shape.
constexpr size_t most_segments = size_t{1} << 20;

// Limit on the ratio of a segment's length and its radius, and of its radius and its length: that of
// capsules.
constexpr double most_ratio = 1e6;

// False for NaN, which magnitude() may leave out.
bool in_bounds(const Vec3& p) {
  const auto fits = [](double x) { return x >= -max_coordinate && x <= max_coordinate; };
  return fits(p.x) && fits(p.y) && fits(p.z);
}

}  // namespace

void LineBuilder::check_room(size_t more) const {
  if (more > most_segments - shown_)
    throw malformed(file_, fmt::format("its lines have more than {} segments, the most that are shown: leave "
                                       "`line_width` out",
                                       most_segments));
}

void LineBuilder::add(std::vector<LineSegment> segments, int material, ImportedScene& scene) {
  check_room(segments.size());
  const double radius = *width_ / 2;
  const auto fits = [&](const LineSegment& segment) {
    const double length = magnitude(segment.to - segment.from);
    return in_bounds(segment.from) && in_bounds(segment.to) && length * most_ratio >= radius &&
           radius * most_ratio >= length;
  };
  unfit_ += std::erase_if(segments, [&](const LineSegment& segment) { return !fits(segment); });
  shown_ += segments.size();
  if (!segments.empty()) scene.lines.push_back({std::move(segments), radius, material});
}

void LineBuilder::report(std::vector<std::string>& warnings) const {
  if (left_out_ > 0)
    warnings.push_back(
        fmt::format("{} lines were left out: `line_width` or --line-width shows them", left_out_));
  if (unfit_ > 0)
    warnings.push_back(
        fmt::format("{} segments of lines were left out: they have no length, are a million "
                    "times as long as wide, or have coordinates that are not finite",
                    unfit_));
}

}  // namespace eyeray::engine::importers
