// The numbers of rays traced, by kind, as statistics of ray tracers are published.
#pragma once

#include <cstdint>

#include "host/core/pixel.hpp"

namespace eyeray::engine {

struct RayCounts {
  uint64_t eye = 0;
  uint64_t eye_hits = 0;  // the rays of `eye` that hit something
  uint64_t reflected = 0;
  uint64_t refracted = 0;
  uint64_t total_reflections = 0;  // where a refracted ray would else be followed
  uint64_t cut_off = 0;            // samples whose path `max_depth` ended
  uint64_t shadow = 0;             // one for each light in front of a surface, by both of its normals

  uint64_t total() const { return eye + reflected + refracted + shadow; }

  // Adds a sample of an executor that counts rays by kind.
  void add(const PixelSample& sample) {
    ++eye;
    // A sample counts hits only if its camera ray hits something.
    eye_hits += sample.hits > 0;
    reflected += sample.reflected;
    refracted += sample.refracted;
    total_reflections += sample.total_reflections;
    cut_off += sample.cut_off;
    shadow += uint64_t{sample.rays} - 1 - sample.reflected - sample.refracted;
  }

  // Adds the counts of other samples.
  void add(const RayCounts& other) {
    eye += other.eye;
    eye_hits += other.eye_hits;
    reflected += other.reflected;
    refracted += other.refracted;
    total_reflections += other.total_reflections;
    cut_off += other.cut_off;
    shadow += other.shadow;
  }

  friend bool operator==(const RayCounts&, const RayCounts&) = default;
};

}  // namespace eyeray::engine
