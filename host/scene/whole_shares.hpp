// Discrete choices by whole numbers, which every executor shares: no rounding parts them.
#pragma once

#include <cstdint>
#include <span>

namespace eyeray::engine {

// The number of whole numbers among which a choice draws one.
inline constexpr uint32_t choice_numbers = 1u << 24;

// Whole numbers in proportion to `shares`, which sum to 1 and are at most choice_numbers: `ends[i]` is where
// those of i end, and those of i + 1 begin. What has a share at all has one number at least; all are
// choice_numbers together, or 0 where no share is above 0.
void whole_shares(std::span<const double> shares, std::span<uint32_t> ends);

}  // namespace eyeray::engine
