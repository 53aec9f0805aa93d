// Judges which lines of an overlay agree: gpu and twin in every bit, and each of them with the reference
// within verify's tolerances, or within the range that the reference shows around the pixel.
#pragma once

#include <functional>
#include <string_view>

#include "host/executors/executor.hpp"
#include "host/probe/overlay.hpp"

namespace eyeray::engine::probe {

// The meaning of a value, by its name. `scale`: the reference's FirstHit::t_scale, for the judge alone.
enum class Meaning { point, distance, direction, uv, color, scale, other };
Meaning meaning_of(std::string_view name);
// The prefix of names of values from the kernel of first hits, which the pixel has in addition to its own.
inline constexpr std::string_view first_hit_prefix = "first_hit_";

// Sets every verdict and every difference; points are relative to the eye. `add_around`, called if anything
// is beyond tolerance, adds the reference's rays around the pixel. Where `incomplete`, rays may be missing.
void judge(Overlay& overlay, std::span<const executors::Backend> executors, bool incomplete,
           const std::function<void()>& add_around);

}  // namespace eyeray::engine::probe
