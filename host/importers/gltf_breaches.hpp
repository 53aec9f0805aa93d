// Rules of glTF that a file breaks though it is clear what it means. Private to the importers.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/importers/gltf_json.hpp"

namespace eyeray::engine::importers {

// Warnings, one a kind, with how often and where first.
class GltfBreaches {
 public:
  explicit GltfBreaches(const GltfObject& document);

  // `kind` is a plural with what is made of it, such as "rotations that are not of unit length, normalised".
  // The same place counts once, as long as the kind has at most 65536 places.
  void add(std::string_view kind, const std::string& place);
  // "rotations that are not of unit length, normalised: 3, the first nodes[1].rotation".
  void report(std::vector<std::string>& warnings) const;

  // What an attribute of a vertex, or of a morph target, and what an animation has may be made of.
  // InputError, of the attribute's accessor, for types by which it is not clear what its numbers mean; a
  // breach where KHR_mesh_quantization has to be declared and is not.
  void check_attribute(std::string_view name, size_t accessor);

  // What the attributes of a primitive are called: what has another name than readers look for is lost.
  void check_attribute_names(const GltfObject& attributes);

 private:
  struct Kind {
    std::string name;
    std::string first;
    size_t count = 0;
    std::set<std::string> places = {};
  };
  const GltfObject& document_;
  bool quantization_declared_;
  std::vector<Kind> kinds_;
};

}  // namespace eyeray::engine::importers
