// The content of a model part of a 3MF file, as it is written. Sources: 3MF Consortium, Core
// Specification 1.3, Materials and Properties Extension 1.2, Production Extension 1.1. Private to the
// importers.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "host/importers/mesh_builder.hpp"
#include "host/importers/zip_parts.hpp"
#include "host/scene/image_texture.hpp"

namespace eyeray::engine::importers {

// The colours, or positions in a picture, that corners of triangles have.
struct ThreeMfGroup {
  enum class Kind { colors, texture, other };
  Kind kind = Kind::other;
  std::vector<Vec3> colors;  // linear RGB
  std::vector<Vec2> uv;
  uint32_t texture = 0;  // the id of the picture
  size_t size() const { return kind == Kind::texture ? uv.size() : colors.size(); }
};

// The properties of a triangle: a group, and an index in it for each corner.
struct ThreeMfProperty {
  static constexpr uint32_t no_group = 0;  // ids begin at 1
  uint32_t group = no_group;
  IndexTriangle corners{};
};

struct ThreeMfPicture {
  std::string part;
  Filter filter = Filter::bilinear;
  Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
};

// An object with a transform: a component of another object, or an item of the build.
struct ThreeMfPlacing {
  std::string part;  // that of the object; empty: the same part
  uint32_t object = 0;
  Mat4 transform{1.0};
  int line = 0, column = 0;  // for messages
};

struct ThreeMfObject {
  std::string name;
  std::vector<Vec3> positions;
  std::vector<IndexTriangle> triangles;
  std::vector<ThreeMfProperty> properties;  // one a triangle; empty: `whole`
  ThreeMfProperty whole;
  std::vector<ThreeMfPlacing> components;
};

struct ThreeMfModel {
  std::string name;        // for messages: the file and the part
  double millimetres = 1;  // a unit of its coordinates
  std::map<uint32_t, ThreeMfObject> objects;
  std::map<uint32_t, ThreeMfGroup> groups;
  std::map<uint32_t, ThreeMfPicture> pictures;
  std::vector<ThreeMfPlacing> items;
  std::map<std::string, size_t> left_out;  // counts of parts without a counterpart here, by their words
};

// Reads a model part. `file`: the name for messages. InputError at the position of a fault.
ThreeMfModel read_threemf_model(ZipParts& parts, const std::string& part, const std::string& file);

// The part that has the build: the target of the package's relationship.
std::string find_threemf_root(ZipParts& parts, const std::string& file);

}  // namespace eyeray::engine::importers
