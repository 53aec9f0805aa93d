// The number of trials that a random test draws.
#pragma once

#include <cstdlib>

namespace eyeray::engine::test {

// EYERAY_FULL_TESTS=1 draws `full`, the number in the documents. EYERAY_FEW_TESTS=1 draws `few`, for which
// `scripts/test` has time.
inline int amount(int few, int usual, int full) {
  return std::getenv("EYERAY_FULL_TESTS") ? full : std::getenv("EYERAY_FEW_TESTS") ? few : usual;
}

}  // namespace eyeray::engine::test
