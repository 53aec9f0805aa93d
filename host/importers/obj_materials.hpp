// The materials of an OBJ file's .mtl files. Private to the importers.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "host/importers/texture_files.hpp"
#include "host/scene/material.hpp"

namespace eyeray::engine::importers {

// The uv transform of a material's maps: a vertex's uv times `scale` plus `offset`, by the options -s and -o.
struct ObjUv {
  Vec2 scale{1.0};
  Vec2 offset{0.0};
  bool operator==(const ObjUv&) const = default;
};

class ObjMaterials {
 public:
  ObjMaterials(AssetFiles& assets, image::PixelBudget& pixels)
      : assets_(assets), textures_(assets, pixels, warnings) {}

  // Reads the .mtl files of an `mtllib` statement, which are separated by spaces, or one file whose name
  // contains spaces. Adds a warning if a file cannot be read, or has parts without a counterpart here.
  void load(std::string_view names);
  // Adds the materials in the text of a .mtl file.
  void parse(std::string text);
  // The index of a material, or −1.
  int find(const std::string& name) const;
  // The uv transform of a material's maps.
  const ObjUv& uv(int material) const { return uv_[static_cast<size_t>(material)]; }

  std::vector<std::string> warnings;
  std::vector<std::unique_ptr<Material>> materials;

 private:
  enum class MapUse { color, alpha, data };

  bool read(const std::string& name, bool last);
  std::shared_ptr<const ImageTexture> picture(const std::string& name, bool clamp, MapUse use);
  std::shared_ptr<const ImageTexture> normals_of(const std::shared_ptr<const ImageTexture>& bumps,
                                                 const std::string& name, bool clamp, double multiplier);
  void warn(std::string message);

  AssetFiles& assets_;
  TextureFiles textures_;
  std::set<std::string> done_;
  std::map<std::string, int> indices_;
  std::vector<ObjUv> uv_;  // by material
};

}  // namespace eyeray::engine::importers
