#include "benchmarks/bench/spread_json.hpp"

#include <nlohmann/json.hpp>

namespace eyeray::engine::bench {

nlohmann::ordered_json to_json(const Spread& spread) {
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}};
}

Spread spread_from(const nlohmann::ordered_json& json) {
  return {json.at("median"), json.at("min"), json.at("max")};
}

}  // namespace eyeray::engine::bench
