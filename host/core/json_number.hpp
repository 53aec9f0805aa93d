// Whole numbers of JSON that a stranger may have written.
#pragma once

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

namespace eyeray::engine {

// The whole number that `json` holds. std::out_of_range if it holds no whole number from `least` to `most`:
// Json::get would wrap it around or truncate it.
template <typename T, typename Json>
T whole_number(const Json& json, T least = 0, T most = std::numeric_limits<T>::max()) {
  const auto within = [&](auto value) {
    return std::cmp_greater_equal(value, least) && std::cmp_less_equal(value, most);
  };
  if (json.is_number_unsigned()) {
    if (const auto value = json.template get<uint64_t>(); within(value)) return T(value);
  } else if (json.is_number_integer()) {
    if (const auto value = json.template get<int64_t>(); within(value)) return T(value);
  }
  throw std::out_of_range("a number of the JSON");
}

}  // namespace eyeray::engine
