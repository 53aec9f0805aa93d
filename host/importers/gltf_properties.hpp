// The properties that glTF 2.0 defines, by object. Private to the importers.
#pragma once

#include <nlohmann/json.hpp>

#include "host/importers/gltf_breaches.hpp"

namespace eyeray::importers {

// A breach for each property of another name, which no reader looks for: a slip of the pen, or one that
// stands in the wrong object. Extensions and `extras` may hold whatever they like. Values of another type
// than glTF has are passed over.
void check_properties(const nlohmann::json& document, GltfBreaches& breaches);

}  // namespace eyeray::importers
