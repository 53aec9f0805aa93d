// bufferViews that are coded by meshoptimizer. Private to the importers.
// Source: Khronos Group: EXT_meshopt_compression; KHR_meshopt_compression, as far as it is the same.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "host/importers/gltf_json.hpp"

namespace eyeray::engine::importers {

// The extension's object of a bufferView, by either of its names; nothing where it is not coded. The coded
// bytes are where the object's buffer, byteOffset and byteLength point.
std::optional<GltfObject> meshopt_coding(const GltfObject& view);

// The bytes of the bufferView, of which there are no more than 64 a coded byte. InputError where `coded` is
// damaged, too short for `coding`, or that is against the specification.
std::string decode_meshopt(const GltfObject& view, const GltfObject& coding, std::string_view coded);

}  // namespace eyeray::engine::importers
