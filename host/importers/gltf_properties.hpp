// The properties that glTF 2.0 and the extensions that are read define, by object. Private to the importers.
// Source: Khronos Group: glTF 2.0 Specification (2.0.1), 5.
#pragma once

#include <nlohmann/json.hpp>

#include "host/importers/gltf_breaches.hpp"

namespace eyeray::engine::importers {

// True if the extension is read, or changes no picture.
bool is_known_extension(std::string_view name);

// Adds a breach for each property that does not fit the table of properties. That is one that glTF does not
// define there, one that is missing though required, and a value of another type, length, range or list. The
// whole document is checked, shown or not; a property that a reader itself refuses or warns of has no range
// in the table. `extras` and the objects of unknown extensions may hold anything.
void check_properties(const nlohmann::json& document, GltfBreaches& breaches);

}  // namespace eyeray::engine::importers
