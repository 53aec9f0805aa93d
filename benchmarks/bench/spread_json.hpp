#pragma once

#include <nlohmann/json_fwd.hpp>

#include "benchmarks/bench/spread.hpp"

namespace eyeray::engine::bench {

nlohmann::ordered_json to_json(const Spread& spread);
Spread spread_from(const nlohmann::ordered_json& json);

}  // namespace eyeray::engine::bench
