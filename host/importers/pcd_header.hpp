// The contents of a PCD file, as its header states them. Private to the importers.
// Source: The PCD (Point Cloud Data) file format, version 0.7;
// https://pointclouds.org/documentation/tutorials/pcd_file_format.html
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/importers/ply_header.hpp"

namespace eyeray::engine::importers {

enum class PcdData { ascii, binary, compressed };

// A value of a point, or `count` values.
struct PcdField {
  std::string name;
  PlyType type = PlyType::float32;
  uint32_t count = 1;
  size_t offset = 0;  // bytes from a point's begin
};

struct PcdHeader {
  std::vector<PcdField> fields;
  uint64_t points = 0;
  size_t point_bytes = 0;   // bytes of a point in binary data
  size_t point_values = 0;  // numbers of a point in text
  bool has_pose = false;    // whether VIEWPOINT moves or turns the points
  PcdData data = PcdData::ascii;
  size_t size = 0;  // bytes up to the data

  // The field of that name; null if there is none.
  const PcdField* find(std::string_view name) const;
};

// Reads the header. InputError, with the line, if it is wrong. The number of points is unchecked.
PcdHeader read_pcd_header(std::string_view bytes, const std::string& file);

}  // namespace eyeray::engine::importers
