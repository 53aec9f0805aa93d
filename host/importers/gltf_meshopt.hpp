// Decodes bufferViews that meshoptimizer has compressed. Private to the importers.
// Source: Khronos Group: EXT_meshopt_compression; KHR_meshopt_compression, as far as it is the same.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "host/importers/gltf_json.hpp"

namespace eyeray::engine::importers {

// The extension's object in a bufferView, under either name of the extension; nothing if the view is not
// coded. The object's buffer, byteOffset and byteLength point at the coded bytes.
std::optional<GltfObject> meshopt_coding(const GltfObject& view);

// The decoded bytes of the bufferView, at most 64 for each coded byte. InputError if `coded` is damaged or
// too short for `coding`, or if `coding` breaks the specification.
std::string decode_meshopt(const GltfObject& view, const GltfObject& coding, std::string_view coded);

}  // namespace eyeray::engine::importers
