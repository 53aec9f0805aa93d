#include "host/importers/gltf_draco.hpp"

#include <draco/mesh/mesh.h>
#include <fmt/format.h>

#include <algorithm>

#include "host/importers/draco_mesh.hpp"
#include "host/importers/gltf_components.hpp"

namespace eyeray::engine::importers {

namespace {

constexpr uint64_t list_of_triangles = 4;
constexpr uint64_t strip_of_triangles = 5;

// Limit on the numbers decoded from a file, in all its meshes. A vertex and its two triangles have about 30
// numbers. They are coded in 1.5 bytes if the mesh is smooth, in almost none if it is flat and regular.
constexpr uint64_t most_values_always = uint64_t{1} << 25;
constexpr uint64_t most_values_a_byte = 128;

// True for the types that accessors have too, and for int32, in which encoders store whole numbers.
bool readable(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
    case draco::DT_UINT8:
    case draco::DT_INT16:
    case draco::DT_UINT16:
    case draco::DT_INT32:
    case draco::DT_UINT32:
    case draco::DT_FLOAT32:
      return true;
    default:
      return false;
  }
}

// Each point's value as T, packed; nothing if a value is missing or does not fit into T.
template <typename T>
std::optional<std::string> pack(const draco::PointAttribute& attribute, uint32_t points) {
  const size_t components = attribute.num_components();
  std::string bytes(points * components * sizeof(T), '\0');
  T* to = reinterpret_cast<T*>(bytes.data());
  for (draco::PointIndex point(0); point < points; ++point, to += components) {
    const draco::AttributeValueIndex value = attribute.mapped_index(point);
    if (value >= static_cast<uint32_t>(attribute.size()) || !attribute.ConvertValue(value, to))
      return std::nullopt;
  }
  return bytes;
}

std::optional<std::string> pack(const draco::PointAttribute& attribute, uint32_t points, uint64_t component) {
  const size_t least = attribute.size() * static_cast<size_t>(attribute.byte_stride());
  if (!readable(attribute.data_type()) || !attribute.buffer() || attribute.buffer()->data_size() < least)
    return std::nullopt;
  if (!attribute.is_mapping_identity() && attribute.indices_map_size() < points) return std::nullopt;
  return visit_component(component, [&](auto zero) { return pack<decltype(zero)>(attribute, points); });
}

}  // namespace

GltfDraco::GltfDraco(const GltfObject& document, GltfBuffers& buffers)
    : document_(document), buffers_(buffers) {}

const draco::Mesh& GltfDraco::mesh(const GltfObject& coding) {
  const auto view = coding.index("bufferView", document_.size("bufferViews"));
  if (!view) coding.fail("has no bufferView");
  auto& mesh = meshes_[*view];
  if (mesh) return *mesh;
  const std::string_view data = buffers_.view(*view);
  const uint64_t most = std::max(most_values_always, most_values_a_byte * buffers_.byte_size());
  const DracoResult result = decode_draco(data, most - std::min(most, values_));
  if (!result.mesh) coding.fail(fmt::format("has data that {}", result.why));
  mesh = result.mesh;
  values_ += result.values;
  buffers_.allow(2 * result.values);
  return *mesh;
}

// Checks the primitive's mode, and the count of a list's indices. The count of a strip's indices cannot be
// compared: Draco stores triangles.
void GltfDraco::check(const GltfObject& primitive, const draco::Mesh& mesh) {
  const uint64_t mode = primitive.count("mode", list_of_triangles);
  if (mode != list_of_triangles && mode != strip_of_triangles)
    primitive.fail("has a mode other than triangles and strips of them, and Draco data, which have none");
  const auto indices = primitive.index("indices", document_.size("accessors"));
  if (!indices || mode == strip_of_triangles) return;
  const GltfObject accessor = document_.element("accessors", *indices);
  const uint64_t count = accessor.count("count", 0);
  if (count != uint64_t{3} * mesh.num_faces()) {
    accessor.fail(fmt::format("has a count of {}, but the Draco data of {} contain {} triangles", count,
                              primitive.location(), mesh.num_faces()));
  }
}

std::optional<std::vector<uint32_t>> GltfDraco::open(const GltfObject& primitive) {
  const auto coding = primitive.extension("KHR_draco_mesh_compression");
  if (!coding) {
    buffers_.supply({});
    return std::nullopt;
  }
  const draco::Mesh& mesh = this->mesh(*coding);
  check(primitive, mesh);

  // Supply the buffers with the attributes' elements.
  const auto attributes = primitive.object("attributes");
  const auto ids = coding->object("attributes");
  if (!attributes || !ids) coding->fail("has no attributes");
  std::map<size_t, std::string> elements;
  for (const std::string& name : ids->keys()) {
    const auto index = attributes->index(name.c_str(), document_.size("accessors"));
    if (!index) continue;
    const GltfObject accessor = document_.element("accessors", *index);
    const uint64_t component = accessor.count("componentType", 0);
    const std::string type = accessor.text("type");
    const uint64_t count = accessor.count("count", 0);
    const uint64_t id = ids->count(name.c_str(), 0);
    const draco::PointAttribute* attribute =
        id <= UINT32_MAX ? mesh.GetAttributeByUniqueId(static_cast<uint32_t>(id)) : nullptr;
    if (!attribute) coding->fail(fmt::format("reads {} from attribute {}, which its data lack", name, id));
    if (bytes_of(component) == 0) accessor.fail("has a componentType that glTF does not define");
    if (count != mesh.num_points() || components_of(type) != attribute->num_components()) {
      accessor.fail(fmt::format("has {} elements of type {}, but the Draco data of {} have {} of {} numbers",
                                count, type, primitive.location(), mesh.num_points(),
                                attribute->num_components()));
    }
    buffers_.claim(accessor, count);
    auto bytes = pack(*attribute, mesh.num_points(), component);
    if (!bytes)
      accessor.fail(fmt::format("cannot store the values of the Draco data of {}", primitive.location()));
    elements[*index] = std::move(*bytes);
  }
  buffers_.supply(std::move(elements));

  // Read the corners. The code that uses them checks that their vertices exist.
  std::vector<uint32_t> corners;
  corners.reserve(size_t{3} * mesh.num_faces());
  for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
    for (const draco::PointIndex& point : mesh.face(face)) corners.push_back(point.value());
  return corners;
}

}  // namespace eyeray::engine::importers
