// Discrete choices by whole numbers, which every executor shares, so that rounding makes none diverge.
#pragma once

#include <cstdint>
#include <span>

namespace eyeray::engine {

// The number of whole numbers, one of which a choice draws.
inline constexpr uint32_t choice_numbers = 1u << 24;

// Distributes whole numbers in proportion to `shares`, which sum to 1; at most choice_numbers of them are
// above 0. The numbers of share i end at `ends[i]`, where those of share i + 1 begin. Every share above 0 has
// at least one number. All shares together have choice_numbers, or 0 if no share is above 0.
void whole_shares(std::span<const double> shares, std::span<uint32_t> ends);

}  // namespace eyeray::engine
