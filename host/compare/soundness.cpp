#include "host/compare/soundness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace eyeray::engine::compare {

namespace {

// Counts one value; true when it is sound.
bool count(Soundness& soundness, double value, bool may_be_negative) {
  if (std::isnan(value)) {
    ++soundness.nan;
  } else if (std::isinf(value)) {
    ++soundness.infinite;
  } else if (value < 0 && !may_be_negative) {
    ++soundness.negative;
  } else {
    return true;
  }
  return false;
}

bool count_pixel(Soundness& soundness, const image::Image& image, int x, int y) {
  bool sound = true;
  for (int c = 0; c < image.channels(); ++c) sound &= count(soundness, double(image.pixel(x, y)[c]), false);
  return sound;
}

bool count_hit(Soundness& soundness, const FirstHit& hit) {
  // A miss has t = infinity, and nothing else to check.
  if (hit.primitive < 0 && !std::isnan(hit.t)) return true;
  bool sound = count(soundness, hit.t, false);
  for (int c = 0; c < 3; ++c) {
    sound &= count(soundness, hit.position[c], true);
    sound &= count(soundness, hit.normal[c], true);
  }
  sound &= count(soundness, hit.uv.x, true);
  sound &= count(soundness, hit.uv.y, true);
  return sound;
}

template <typename CountPixel>
void for_each_pixel(Soundness& soundness, int width, int height, const CountPixel& count_one) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!count_one(x, y) && soundness.first == Pixel{}) soundness.first = {x, y};
    }
  }
}

}  // namespace

Soundness inspect(const image::Image& image) {
  Soundness soundness;
  for_each_pixel(soundness, image.width(), image.height(),
                 [&](int x, int y) { return count_pixel(soundness, image, x, y); });
  return soundness;
}

Soundness inspect(const Frame& frame) {
  Soundness soundness = inspect(frame.color);
  for (const image::Image* counts : {&frame.hits, &frame.rays_traced})
    for_each_pixel(soundness, counts->width(), counts->height(),
                   [&](int x, int y) { return count_pixel(soundness, *counts, x, y); });
  for (size_t i = 0; i < frame.first_hits.size(); ++i) {
    const int width = std::max(frame.area.width, 1);
    if (!count_hit(soundness, frame.first_hits[i]) && soundness.first == Pixel{}) {
      soundness.first = {int(i) % width, int(i) / width};
    }
  }
  if (!(soundness.first == Pixel{})) {
    soundness.first.x += frame.area.x;
    soundness.first.y += frame.area.y;
  }
  soundness.flagged_pixels = frame.flagged_pixels;
  soundness.flags = frame.flags;
  uint64_t flagged_hits = 0;
  for (const FirstHit& hit : frame.first_hits) {
    soundness.flags |= hit.flags;
    flagged_hits += hit.flags != 0;
  }
  soundness.flagged_pixels = std::max(soundness.flagged_pixels, flagged_hits);
  return soundness;
}

std::string describe(const Soundness& soundness) {
  std::string text;
  const auto add = [&](int64_t count, const char* what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  };
  add(soundness.nan, "NaN");
  add(soundness.infinite, "infinite");
  add(soundness.negative, "negative");
  if (!text.empty()) text += fmt::format(" (first at {},{})", soundness.first.x, soundness.first.y);
  add(int64_t(soundness.flagged_pixels), "incomplete pixels");
  if (soundness.flags & media_overflow) text += ": more than four media nested";
  if (soundness.flags & stack_overflow) text += ": more rays pending than the stack holds";
  if (soundness.flags & loop_budget) text += ": the driver's cap on loop iterations was near";
  if (soundness.flags & iteration_limit) text += ": the search for a shape ran out of steps";
  return text;
}

}  // namespace eyeray::engine::compare
