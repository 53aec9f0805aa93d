// The animations of a glTF file: the state that an animation gives the file's nodes at a moment. Private to
// the importers. Source: Khronos Group: glTF 2.0 Specification (2.0.1), 3.11 and appendix C.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host/importers/gltf_buffers.hpp"
#include "host/importers/gltf_materials.hpp"
#include "host/importers/import.hpp"

namespace eyeray::engine::importers {

// The index of the animation to play; empty if the file is to be shown at rest.
std::optional<size_t> find_animation(std::span<const std::string> names, const Playing& playing);

// The animated values, which replace those written in nodes. They are listed by node and key ("translation",
// "rotation", "scale", "weights"), with as many numbers as the key has. Rotations are of unit length.
struct GltfMotion {
  std::map<std::pair<size_t, std::string>, std::vector<double>> values;
  PlayedAnimation played;
};

// The animated values at the moment that `playing` gives. InputError, with the position, if times do not
// increase, or if outputs do not match the times in number, are not finite, or have a wrong type.
GltfMotion motion_at(const GltfObject& document, size_t animation, const Playing& playing,
                     GltfBuffers& buffers, GltfLeftOut& left_out, GltfBreaches& breaches);

}  // namespace eyeray::engine::importers
