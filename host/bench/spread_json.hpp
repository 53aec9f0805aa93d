#pragma once

#include <nlohmann/json.hpp>

#include "host/bench/spread.hpp"

namespace eyeray::bench {

inline nlohmann::ordered_json to_json(const Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

inline Spread spread_from(const nlohmann::ordered_json& json) {
  return {json.at("median"), json.at("min"), json.at("max")};
}

}  // namespace eyeray::bench
