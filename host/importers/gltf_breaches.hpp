// Breaches: rules of glTF that a file breaks though its meaning is clear. Private to the importers.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/importers/gltf_json.hpp"

namespace eyeray::engine::importers {

// Collects breaches as warnings: one a kind, with the number of positions and the first one.
class GltfBreaches {
 public:
  explicit GltfBreaches(const GltfObject& document);

  // `kind` is a plural and its treatment, such as "rotations that are not of unit length, normalised".
  // A position that is added twice counts once, as long as the kind has at most 65536 positions.
  void add(std::string_view kind, const std::string& location);
  // Adds the warnings: "rotations that are not of unit length, normalised: 3, the first nodes[1].rotation".
  void report(std::vector<std::string>& warnings) const;

  // Checks the component type of an attribute of vertices, morph targets or an animation. InputError, at the
  // attribute's accessor, if the type makes the meaning of its numbers unclear. A breach if
  // KHR_mesh_quantization must be declared and is not.
  void check_attribute(std::string_view name, size_t accessor);

  // Checks the names of a primitive's attributes. An attribute with an unknown name is ignored and is a
  // breach.
  void check_attribute_names(const GltfObject& attributes);

 private:
  struct Kind {
    std::string name;
    std::string first;
    size_t count = 0;
    std::set<std::string> locations = {};
  };
  const GltfObject& document_;
  bool quantization_declared_;
  std::vector<Kind> kinds_;
};

}  // namespace eyeray::engine::importers
