// Reads PCD, the files of the Point Cloud Library: text, binary, and binary compressed by LZF.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "host/core/free_memory.hpp"
#include "host/importers/cloud_builder.hpp"
#include "host/importers/formats.hpp"
#include "host/importers/lzf.hpp"
#include "host/importers/malformed.hpp"
#include "host/importers/mesh_builder.hpp"
#include "host/importers/pcd_header.hpp"
#include "host/importers/ply_values.hpp"

namespace eyeray::engine::importers {

namespace {

using PcdValues = BinaryValues<std::endian::little>;

// The fields of a file that are shown. Null: there is none.
struct ShownFields {
  std::array<const PcdField*, 3> position;
  const PcdField* color;  // red, green and blue in the bytes of one number
  std::optional<std::array<const PcdField*, 3>> normal = {};  // for disks
};

// The three fields; empty unless all are numbers of floating point.
std::optional<std::array<const PcdField*, 3>> find_vector(const PcdHeader& header,
                                                          const std::array<const char*, 3>& names) {
  std::array<const PcdField*, 3> fields;
  for (size_t axis = 0; axis < 3; ++axis) {
    fields[axis] = header.find(names[axis]);
    if (!fields[axis] || fields[axis]->count != 1 || fields[axis]->type < PlyType::float32)
      return std::nullopt;
  }
  return fields;
}

ShownFields shown_fields(const PcdHeader& header, const MeshFile& file, std::vector<std::string>& warnings) {
  const auto position = find_vector(header, {"x", "y", "z"});
  if (!position)
    throw malformed(file.name, "the points must have the fields x, y and z, each of TYPE F and COUNT 1");
  ShownFields shown{*position, header.find("rgb")};
  if (!shown.color) shown.color = header.find("rgba");
  if (file.options.point_shape == PointShape::disk)
    shown.normal = find_vector(header, {"normal_x", "normal_y", "normal_z"});
  if (shown.color && (shown.color->count != 1 || size_of(shown.color->type) != 4)) shown.color = nullptr;
  std::vector<std::string> rest;
  for (const PcdField& field : header.fields) {
    const bool is_shown = &field == shown.color ||
                          std::ranges::find(shown.position, &field) != shown.position.end() ||
                          (shown.normal && std::ranges::find(*shown.normal, &field) != shown.normal->end());
    if (!is_shown && field.name != "_") rest.push_back(field.name);
  }
  report_left_out("fields", std::move(rest), warnings);
  if (header.has_pose)
    warnings.emplace_back("its VIEWPOINT was left out: the points are shown where their coordinates are");
  return shown;
}

// The colour in the bytes of a number.
Vec3 color_of_bits(uint32_t bits) {
  return color_from_display(Vec3(bits >> 16 & 255, bits >> 8 & 255, bits & 255) / 255.0);
}

// The bits of a colour that is written as a number of that type.
uint32_t bits_of(double value, PlyType type) {
  if (type == PlyType::float32) return std::bit_cast<uint32_t>(static_cast<float>(value));
  if (!(value >= -0x1p31 && value < 0x1p32)) return 0;
  return static_cast<uint32_t>(static_cast<int64_t>(value));
}

// InputError if the data cannot contain as many points as the header states.
void check_points(const PcdHeader& header, uint64_t room, size_t bytes, const std::string& file) {
  if (header.points > room)
    throw malformed(file,
                    fmt::format("the header states {} points, more than the file's {} bytes can contain",
                                header.points, bytes));
}

RawPoints read_text_points(const PcdHeader& header, const ShownFields& shown, const MeshFile& file) {
  AsciiValues values(file.bytes, header.size, file.name);
  const size_t least = std::max<size_t>(header.point_values, 1);
  check_points(header, values.room(PlyType::float64) / least, file.bytes.size(), file.name);
  RawPoints points{file.name, {}};
  points.positions.reserve(header.points);
  if (shown.color) points.colors.reserve(header.points);
  if (shown.normal) points.normals.reserve(header.points);
  for (uint64_t i = 0; i < header.points; ++i) {
    Vec3 position(0.0), normal(0.0);
    for (const PcdField& field : header.fields) {
      for (uint32_t k = 0; k < field.count; ++k) {
        const double value = values.next(field.type);
        for (int axis = 0; axis < 3; ++axis) {
          if (&field == shown.position[size_t(axis)]) position[axis] = value;
          if (shown.normal && &field == (*shown.normal)[size_t(axis)]) normal[axis] = value;
        }
        if (&field == shown.color) points.colors.push_back(color_of_bits(bits_of(value, field.type)));
      }
    }
    points.positions.push_back(position);
    if (shown.normal) points.normals.push_back(normal);
  }
  return points;
}

// Reads binary data. at(field) returns the position of the first point's value, and step(field) the bytes to
// that of the next point.
template <typename At, typename Step>
RawPoints read_binary_points(const PcdHeader& header, const ShownFields& shown, std::string_view bytes,
                             const std::string& file, const At& at, const Step& step) {
  RawPoints points{file, {}};
  const auto read = [&](const std::array<const PcdField*, 3>& fields, std::vector<Vec3>& vectors) {
    vectors.resize(header.points);
    for (int axis = 0; axis < 3; ++axis) {
      const PcdField& field = *fields[size_t(axis)];
      for (uint64_t i = 0; i < header.points; ++i)
        vectors[i][axis] = PcdValues(bytes, at(field) + i * step(field), file).next(field.type);
    }
  };
  read(shown.position, points.positions);
  if (shown.normal) read(*shown.normal, points.normals);
  if (!shown.color) return points;
  points.colors.resize(header.points);
  for (uint64_t i = 0; i < header.points; ++i) {
    const size_t begin = at(*shown.color) + i * step(*shown.color);
    points.colors[i] =
        color_of_bits(static_cast<uint32_t>(PcdValues(bytes, begin, file).next(PlyType::uint32)));
  }
  return points;
}

RawPoints read_compressed_points(const PcdHeader& header, const ShownFields& shown, const MeshFile& file) {
  PcdValues sizes(file.bytes, header.size, file.name);
  const auto packed = static_cast<size_t>(sizes.next(PlyType::uint32));
  const auto whole = static_cast<size_t>(sizes.next(PlyType::uint32));
  const std::string_view data = std::string_view(file.bytes).substr(header.size + 8);
  if (packed > data.size())
    throw malformed(file.name, fmt::format("its data has {} bytes, but {} follow", packed, data.size()));
  if (whole > most_lzf_bytes(packed))
    throw malformed(file.name, fmt::format("{} bytes cannot be decompressed to {}", packed, whole));
  check_points(header, whole / std::max<size_t>(header.point_bytes, 1), file.bytes.size(), file.name);
  const auto bytes = decompress_lzf(data.substr(0, packed), whole);
  if (!bytes) throw malformed(file.name, fmt::format("its data cannot be decompressed to {} bytes", whole));
  // The values of a field stand together.
  return read_binary_points(
      header, shown, *bytes, file.name, [&](const PcdField& field) { return field.offset * header.points; },
      [](const PcdField& field) { return size_of(field.type) * field.count; });
}

RawPoints read_points(const PcdHeader& header, const ShownFields& shown, const MeshFile& file) {
  if (header.data == PcdData::ascii) return read_text_points(header, shown, file);
  if (header.data == PcdData::compressed) return read_compressed_points(header, shown, file);
  check_points(header, (file.bytes.size() - header.size) / std::max<size_t>(header.point_bytes, 1),
               file.bytes.size(), file.name);
  return read_binary_points(
      header, shown, file.bytes, file.name, [&](const PcdField& field) { return header.size + field.offset; },
      [&](const PcdField&) { return header.point_bytes; });
}

}  // namespace

ImportedScene import_pcd(MeshFile& file) {
  const PcdHeader header = read_pcd_header(file.bytes, file.name);
  ImportedScene scene;
  const ShownFields shown = shown_fields(header, file, scene.warnings);
  RawPoints points = read_points(header, shown, file);
  free_memory(file.bytes);  // the cloud needs the memory
  if (auto cloud = build_cloud(std::move(points), file.options, scene.warnings))
    scene.clouds.push_back({std::move(cloud)});
  return scene;
}

}  // namespace eyeray::engine::importers
