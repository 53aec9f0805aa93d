#include "host/compare/frame.hpp"

#include <fmt/format.h>

namespace eyeray::engine::compare {

namespace {

// True if every part of the frame has the size of its area.
bool whole(const Frame& frame) {
  const Rect& area = frame.area;
  const auto holds = [&](const image::Image& image, int channels) {
    return image.width() == area.width && image.height() == area.height && image.channels() == channels;
  };
  return holds(frame.color, 3) && holds(frame.hits, 1) && holds(frame.rays_traced, 1) &&
         int64_t(frame.first_hits.size()) == area.pixels();
}

std::string describe(const Rect& area) {
  return fmt::format("{}×{} at {},{}", area.width, area.height, area.x, area.y);
}

}  // namespace

std::string why_incomparable(const Frame& value, const Frame& reference) {
  if (reference.area.pixels() <= 0) return "there is no pixel to compare";
  if (!(value.area == reference.area)) {
    return fmt::format("the sizes differ: {} against {}", describe(value.area), describe(reference.area));
  }
  if (value.samples.size() != reference.samples.size())
    return fmt::format("the numbers of samples differ: {} against {}", value.samples.size(),
                       reference.samples.size());
  for (const Frame* frame : {&value, &reference}) {
    if (!whole(*frame)) {
      return fmt::format("the sizes differ: a frame of {} contains a picture of {}×{} and {} first hits",
                         describe(frame->area), frame->color.width(), frame->color.height(),
                         frame->first_hits.size());
    }
  }
  return "";
}

}  // namespace eyeray::engine::compare
