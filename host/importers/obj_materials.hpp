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

namespace eyeray::importers {

class ObjMaterials {
 public:
  ObjMaterials(AssetFiles& assets, image::PixelBudget& pixels)
      : assets_(assets), textures_(assets, pixels, warnings) {}

  // Reads the .mtl files of an `mtllib` statement, which are parted by spaces or one whose name has some. One
  // that cannot be read, or what of it has no counterpart here, is a warning.
  void load(std::string_view names);
  // Takes the materials of a .mtl file's text.
  void parse(std::string text);
  // The index of a material, or −1.
  int find(const std::string& name) const;

  std::vector<std::string> warnings;
  std::vector<std::unique_ptr<Material>> materials;

 private:
  bool read(const std::string& name, bool last);
  void warn(std::string message);

  AssetFiles& assets_;
  TextureFiles textures_;
  std::set<std::string> done_;
  std::map<std::string, int> indices_;
};

}  // namespace eyeray::importers
