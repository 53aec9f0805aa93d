#include "host/importers/file_polygons.hpp"

#include <algorithm>
#include <cmath>

#include "host/importers/malformed.hpp"
#include "host/importers/polygon.hpp"

namespace eyeray::engine::importers {

void add_values_of_faces(FilePolygons& polygons, VertexPool& vertices, std::vector<std::string>& warnings) {
  if (!polygons.uv.empty()) polygons.uv.resize(polygons.corners.size(), Vec2(double(NAN)));
  if (!polygons.colors.empty()) polygons.colors.resize(polygons.sizes.size(), Vec3(1));
  if (!polygons.pictures.empty()) polygons.pictures.resize(polygons.sizes.size());
  if (!polygons.colors.empty() && !vertices.colors.empty()) {
    polygons.colors.clear();
    warnings.emplace_back("the colours of faces were left out: those of vertices are shown");
  }
  if (!polygons.colors.empty()) vertices.colors = polygons.colors;
  if (!polygons.uv.empty() && !vertices.uv.empty())
    warnings.emplace_back("the uv of vertices were left out: those of faces (texcoord) are shown");
  if (!polygons.uv.empty()) vertices.uv = std::move(polygons.uv);
}

std::vector<RawTriangles> triangulate(const FilePolygons& polygons, const VertexPool& vertices,
                                      size_t pictures, bool own_uv, MeshCounts& counts,
                                      const std::string& file) {
  const auto known = [&](uint32_t corner) { return corner < vertices.positions.size(); };
  if (const auto wrong = std::ranges::find_if_not(polygons.corners, known); wrong != polygons.corners.end()) {
    throw malformed(file, fmt::format("a face refers to vertex {}, but there are {}, counted from 0",
                                      *wrong == no_index ? -1 : int64_t{*wrong}, vertices.positions.size()));
  }
  const bool split = pictures > 1 && !polygons.pictures.empty();
  std::vector<RawTriangles> lists(split ? pictures : 1);
  for (RawTriangles& raw : lists) {
    raw.name = file;
    raw.has_normals = !vertices.normals.empty();
    raw.has_uv = !vertices.uv.empty();
  }
  if (!split) lists[0].positions.reserve(polygons.sizes.size());
  Triangulator triangulator;
  std::vector<Vec3> points;
  size_t first = 0;  // the corner with which a polygon begins
  for (size_t i = 0; i < polygons.sizes.size(); ++i) {
    const uint32_t picture = split ? polygons.pictures[i] : 0;
    if (picture >= lists.size())
      throw malformed(file,
                      fmt::format("a face has the texnumber {}, but there are {} pictures, counted from 0",
                                  picture == no_index ? -1 : int64_t{picture}, lists.size()));
    RawTriangles& raw = lists[picture];
    const uint32_t* const corner = polygons.corners.data() + first;
    const auto own = static_cast<uint32_t>(first);
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
      raw.positions.push_back({corner[a], corner[b], corner[c]});
      if (own_uv) raw.uv.push_back({own + a, own + b, own + c});
      if (!polygons.colors.empty()) raw.colors.push_back(static_cast<uint32_t>(i));
    };
    const uint32_t size = polygons.sizes[i];
    if (size == 3) {
      add(0, 1, 2);
    } else {
      points.clear();
      for (uint32_t k = 0; k < size; ++k) points.push_back(vertices.positions[corner[k]]);
      for (const auto& [a, b, c] : triangulator.cut(points)) add(a, b, c);
      if (size < 3) ++counts.without_area;
    }
    first += size;
  }
  counts.fans += triangulator.fans();
  return lists;
}

}  // namespace eyeray::engine::importers
