// The polygons of a PLY or OFF file, and the values that belong to single polygons. Private to the importers.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/importers/mesh_builder.hpp"

namespace eyeray::engine::importers {

// The corners of polygons, one after the other.
struct FilePolygons {
  std::vector<uint32_t> corners;
  std::vector<uint32_t> sizes;
  std::vector<Vec2> uv;            // one a corner, not finite if a face has no uv; or empty
  std::vector<Vec3> colors;        // linear RGB, one a polygon; or empty
  std::vector<uint32_t> pictures;  // indices of PlyHeader::pictures, one a polygon; or empty
};

// Adds the uv and colours of single faces to the pool. Strips in the same file have no such values. Colours
// of vertices count more than those of faces.
void add_values_of_faces(FilePolygons& polygons, VertexPool& vertices, std::vector<std::string>& warnings);

// The polygons as triangles: a list for each picture that they show, or a single list. `own_uv`: the pool has
// one uv a corner. InputError if a corner's vertex or a face's picture does not exist.
std::vector<RawTriangles> triangulate(const FilePolygons& polygons, const VertexPool& vertices,
                                      size_t pictures, bool own_uv, MeshCounts& counts,
                                      const std::string& file);

}  // namespace eyeray::engine::importers
