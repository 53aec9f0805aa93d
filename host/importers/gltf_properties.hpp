// Checks properties by a table of those that glTF 2.0 and the extensions read here define. Private to the
// importers.
// Source: Khronos Group: glTF 2.0 Specification (2.0.1), 5.
#pragma once

#include <nlohmann/json.hpp>

#include "host/importers/gltf_breaches.hpp"

namespace eyeray::engine::importers {

// True if the extension is read, or changes no picture.
bool is_known_extension(std::string_view name);

// Adds a breach for each property that does not fit the table of properties. Either glTF does not define it
// there, or it is missing though required, or its value has a wrong type, length, range or list. The whole
// document is checked, shown or not. A property that a reader itself refuses or warns of has no range in the
// table. `extras` and the objects of unknown extensions may contain anything.
void check_properties(const nlohmann::json& document, GltfBreaches& breaches);

}  // namespace eyeray::engine::importers
