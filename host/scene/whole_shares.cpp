#include "host/scene/whole_shares.hpp"

#include <algorithm>

#include "host/core/error.hpp"

namespace eyeray::engine {

void whole_shares(std::span<const double> shares, std::span<uint32_t> ends) {
  CHECK_EQ(shares.size(), ends.size());
  const auto count = uint32_t(std::ranges::count_if(shares, [](double share) { return share > 0; }));
  CHECK_LE(count, choice_numbers);
  uint32_t all = 0;
  for (size_t i = 0; i < shares.size(); ++i) {
    ends[i] = shares[i] > 0 ? 1 + uint32_t(shares[i] * (choice_numbers - count)) : 0;
    all += ends[i];
  }
  // The remainder goes to the largest share.
  if (count > 0) *std::ranges::max_element(ends) += choice_numbers - all;
  uint32_t end = 0;
  for (uint32_t& each : ends) each = end += each;
}

}  // namespace eyeray::engine
