// The readers, one a format; import.cpp selects one by the file's ending. Private to the importers.
#pragma once

#include <string>
#include <string_view>

#include "host/importers/asset_files.hpp"
#include "host/importers/import.hpp"

namespace eyeray::engine::importers {

// A mesh file in memory, and the means to read it.
struct MeshFile {
  std::string name;  // for messages
  std::string bytes;
  ImportOptions options;
  AssetFiles assets;
  image::PixelBudget* pixels;
};

// Each reader fills all of an ImportedScene but its `files`. InputError for a fault in the file; Error if a
// file that it refers to is refused or cannot be read.
ImportedScene import_obj(MeshFile& file);
ImportedScene import_ply(MeshFile& file);
ImportedScene import_stl(MeshFile& file);
ImportedScene import_off(MeshFile& file);
ImportedScene import_3mf(MeshFile& file);
ImportedScene import_xyz(MeshFile& file);
ImportedScene import_pcd(MeshFile& file);
ImportedScene import_gltf(MeshFile& file);  // .gltf and .glb, distinguished by their first bytes

// Default angle of smoothing in degrees, for files without normals other than glTF.
inline constexpr double default_smooth = 40;

inline bool is_utf16(std::string_view text) {
  return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
}

}  // namespace eyeray::engine::importers
