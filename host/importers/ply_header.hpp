// The contents of a PLY file, as its header states them. Private to the importers.
// Source: Turk: The PLY Polygon File Format, 1994; http://paulbourke.net/dataformats/ply/
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace eyeray::engine::importers {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
size_t size_of(PlyType type);  // bytes

enum class PlyFormat { ascii, little_endian, big_endian };

struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> list = {};  // for a list: the type of its length
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;

  // The least bytes that one element takes in a file. They limit the number of elements that fit into it.
  size_t least_bytes(PlyFormat format) const;
  bool has_lists() const;
};

struct PlyHeader {
  PlyFormat format;
  std::vector<PlyElement> elements;
  std::vector<std::string>
      pictures;     // from comments and obj_infos `TextureFile NAME`, which MeshLab and others write
  size_t size = 0;  // bytes up to the data

  // True if the file has faces or strips of triangles, not vertices alone.
  bool has_faces() const;
};

// Reads the header. InputError, with the line, if it is wrong.
PlyHeader read_ply_header(std::string_view bytes, const std::string& file);

}  // namespace eyeray::engine::importers
