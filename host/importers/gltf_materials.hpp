// The materials of a glTF file as ours. Private to the importers.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "importers/gltf_buffers.hpp"
#include "importers/texture_files.hpp"
#include "scene/material.hpp"

namespace eyeray {

// What a file has and we leave out: each is told once.
class GltfWarnings {
 public:
  explicit GltfWarnings(std::vector<std::string>& warnings) : warnings_(warnings) {}
  void left_out(const std::string& what) {
    if (told_.insert(what).second) warnings_.push_back(what + " were left out");
  }

 private:
  std::vector<std::string>& warnings_;
  std::set<std::string> told_;
};

class GltfMaterials {
 public:
  GltfMaterials(const GltfObject& document, GltfBuffers& buffers, TextureFiles& textures,
                GltfWarnings& warnings);

  std::unique_ptr<Material> material(size_t index);
  // Which of a mesh's sets of uv (TEXCOORD_0, …) the material's texture takes.
  uint64_t uv_set(size_t index) const;

 private:
  struct Surface;  // metallic-roughness, as numbers and one picture

  Surface surface(const GltfObject& material);
  std::shared_ptr<const ImageTexture> texture(const GltfObject& reference, bool srgb);
  ImageTexture decode_image(size_t index);
  void warn_of_rest(const GltfObject& material);

  const GltfObject& document_;
  GltfBuffers& buffers_;
  TextureFiles& textures_;
  GltfWarnings& warnings_;
};

}  // namespace eyeray
