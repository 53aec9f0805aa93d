// Rules of glTF on how objects refer to each other. Private to the importers.
// Source: Khronos Group: glTF 2.0 Specification (2.0.1), 3.5 to 3.7 and 3.11.
#pragma once

#include <nlohmann/json.hpp>

#include "host/importers/gltf_breaches.hpp"

namespace eyeray::engine::importers {

// Adds a breach for each rule of the table that an object breaks, shown or not. A reference to a missing
// object is no such breach: check_properties warns of it, and code that follows it refuses it.
void check_links(const nlohmann::json& document, GltfBreaches& breaches);

}  // namespace eyeray::engine::importers
