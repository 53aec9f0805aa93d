#include "host/importers/gltf_meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/core/diagnostic_log.hpp"

namespace eyeray::engine::importers {

namespace {

enum Mode : uint64_t {
  point_list = 0,
  line_list = 1,
  line_loop = 2,
  line_strip = 3,
  triangle_list = 4,
  triangle_strip = 5,
  triangle_fan = 6
};

std::vector<IndexTriangle> assemble(uint64_t mode, const std::vector<uint32_t>& corners) {
  std::vector<IndexTriangle> triangles;
  if (mode == triangle_list) {
    triangles.reserve(corners.size() / 3);
    for (size_t i = 0; i + 2 < corners.size(); i += 3)
      triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    return triangles;
  }
  for (size_t i = 0; i + 2 < corners.size(); ++i) {
    if (mode == triangle_fan) {
      triangles.push_back({corners[i + 1], corners[i + 2], corners[0]});
    } else if (i % 2 == 0) {
      triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    } else {
      triangles.push_back({corners[i + 1], corners[i], corners[i + 2]});
    }
  }
  return triangles;
}

std::vector<std::array<uint32_t, 2>> assemble_lines(uint64_t mode, const std::vector<uint32_t>& corners) {
  std::vector<std::array<uint32_t, 2>> lines;
  for (size_t i = 0; i + 1 < corners.size(); i += mode == line_list ? 2 : 1)
    lines.push_back({corners[i], corners[i + 1]});
  if (mode == line_loop && corners.size() > 2) lines.push_back({corners.back(), corners.front()});
  return lines;
}

// The points at these corners of a pool.
GltfMeshes::Loose points_at(const std::vector<uint32_t>& corners, const VertexPool& pool) {
  GltfMeshes::Loose points;
  for (const uint32_t corner : corners) {
    points.positions.push_back(pool.positions[corner]);
    if (!pool.colors.empty()) points.colors.push_back(pool.colors[corner]);
    if (!pool.normals.empty()) points.normals.push_back(pool.normals[corner]);
  }
  return points;
}

// True if a normal's length is clearly not 1. Rounding alone makes a deviation of 0.007 if normals are stored
// in bytes. A normal of length 0 is counted elsewhere.
bool is_no_unit(const Vec3& normal) {
  const double length = glm::length(normal);
  return length > 0 && !(std::abs(length - 1) < 0.01);
}

// True if a tangent has a direction along u, and a sign that gives the side of v.
bool is_direction(const Vec4& tangent) {
  const double length = glm::length(Vec3(tangent));
  return std::isfinite(length) && length > 0 && std::abs(tangent.w) == 1;
}

}  // namespace

GltfMeshes::GltfMeshes(const GltfObject& document, GltfBuffers& buffers, const GltfMaterials& materials,
                       GltfLeftOut& left_out, GltfBreaches& breaches, const std::string& file, double smooth,
                       bool lines)
    : document_(document),
      buffers_(buffers),
      materials_(materials),
      left_out_(left_out),
      breaches_(breaches),
      file_(file),
      smooth_(smooth),
      draco_(document, buffers),
      lines_(lines),
      seen_(document.size("meshes")),
      parts_(document.size("meshes")) {}

const std::vector<GltfMeshes::Part>& GltfMeshes::parts(size_t index) {
  if (!parts_[index]) parts_[index] = posed_parts(index, {});
  return *parts_[index];
}

std::vector<GltfMeshes::Part> GltfMeshes::posed_parts(size_t index, const GltfPose& pose) {
  const GltfObject mesh = document_.element("meshes", index);
  GltfPose whole = pose;
  if (whole.weights.empty()) whole.weights = mesh.numbers("weights");
  std::vector<Part> parts;
  for (size_t i = 0; i < mesh.size("primitives"); ++i) {
    const GltfObject primitive = mesh.element("primitives", i);
    if (!seen_[index]) check_targets(primitive, document_, buffers_, breaches_);
    const auto material = material_of(primitive);
    Made made = read_primitive(primitive, material, whole);
    const int material_index = material ? static_cast<int>(*material) : -1;
    if (auto* const loose = std::get_if<Loose>(&made)) {
      const bool colored = !loose->colors.empty();
      parts.push_back({-1, material_index, colored, std::make_shared<const Loose>(std::move(*loose))});
    }
    auto* const triangles = std::get_if<Mesh>(&made);
    if (!triangles || triangles->triangles.empty()) continue;
    const std::string name = mesh.text("name");
    triangles->name = fmt::format("{}: {}", file_, name.empty() ? primitive.location() : printable(name));
    parts.push_back({static_cast<int>(meshes_.size()), material_index, !triangles->colors.empty()});
    meshes_.push_back(std::move(*triangles));
  }
  seen_[index] = true;
  return parts;
}

// The material of a primitive under the chosen variant; its own if it has none for that variant.
std::optional<size_t> GltfMeshes::material_of(const GltfObject& primitive) const {
  const size_t materials = document_.size("materials");
  const auto variants = variant_ ? primitive.extension("KHR_materials_variants") : std::nullopt;
  for (size_t i = 0; variants && i < variants->size("mappings"); ++i) {
    const GltfObject mapping = variants->element("mappings", i);
    const std::vector<size_t> of = mapping.indices("variants", ~size_t{0});
    if (std::ranges::find(of, *variant_) == of.end()) continue;
    if (const auto material = mapping.index("material", materials)) return material;
    mapping.fail("has no material");
  }
  return primitive.index("material", materials);
}

// The mesh, the points or the lines of a primitive; nothing if it is not shown.
GltfMeshes::Made GltfMeshes::read_primitive(const GltfObject& primitive, std::optional<size_t> material,
                                            const GltfPose& pose) {
  const uint64_t mode = primitive.count("mode", triangle_list);
  const bool loose = mode < triangle_list;
  if (loose && mode != point_list && !lines_) {
    left_out_.add("lines, which `line_width` or --line-width shows");
    return {};
  }
  if (mode > triangle_fan) primitive.fail("has a mode that glTF does not define");
  const auto attributes = primitive.object("attributes");
  if (!attributes) primitive.fail("has no attributes");

  breaches_.check_attribute_names(*attributes);

  // Read the vertices.
  const size_t accessors = document_.size("accessors");
  const auto positions = attributes->index("POSITION", accessors);
  if (!positions) {
    left_out_.add("meshes without positions");
    return {};
  }
  if (loose && primitive.extension("KHR_draco_mesh_compression"))
    primitive.fail("has Draco data, which only triangles can have");
  const auto draco_corners = draco_.open(primitive);
  const GltfUvUse uv_use = material && !loose ? materials_.uv_use(*material) : GltfUvUse{};
  const auto normals = attributes->index("NORMAL", accessors);
  const bool two_uv = uv_use.uv.size() == 2;
  const GltfUv first_use = uv_use.uv.empty() ? GltfUv{} : uv_use.uv[0];
  const GltfUv second_use = two_uv ? uv_use.uv[1] : GltfUv{};
  const std::string uv_name = fmt::format("TEXCOORD_{}", first_use.set);
  const std::string second_name = fmt::format("TEXCOORD_{}", second_use.set);
  const auto uv = attributes->index(uv_name.c_str(), accessors);
  const auto second_uv = two_uv ? attributes->index(second_name.c_str(), accessors) : std::nullopt;
  // One attribute with two transforms makes two uv.
  const auto other_uv = second_name == uv_name ? std::nullopt : second_uv;
  const auto colors = attributes->index("COLOR_0", accessors);
  // Drop tangents if a skin or morph target bends the mesh: it does not define the new tangents.
  auto tangents = attributes->index("TANGENT", accessors);
  const bool bent =
      !pose.joints.empty() || std::ranges::any_of(pose.weights, [](double w) { return w != 0; });
  if (tangents && !normals)
    breaches_.add("meshes with tangents but without normals; their tangents are computed from uv instead",
                  attributes->location());
  if (bent || !normals || !(uv_use.second_tangents ? second_uv : uv)) tangents.reset();
  if ((!uv && !uv_use.uv.empty()) || (!second_uv && two_uv))
    breaches_.add("meshes without the uv that their material's picture needs", primitive.location());
  for (const auto& [name, accessor] :
       {std::pair<std::string_view, const std::optional<size_t>&>{"POSITION", positions},
        {"NORMAL", normals},
        {"TANGENT", tangents},
        {uv_name, uv},
        {second_name, other_uv},
        {"COLOR_0", colors}}) {
    if (accessor) breaches_.check_attribute(name, *accessor);
  }
  VertexPool pool;
  pool.positions = buffers_.vec3(*positions);
  if (normals) pool.normals = buffers_.vec3(*normals);
  if (std::ranges::any_of(pool.normals, is_no_unit))
    breaches_.add("normals that are not of unit length, normalised", attributes->location() + ".NORMAL");
  if (tangents) pool.tangents = buffers_.vec4(*tangents);
  if (std::ranges::any_of(pool.tangents, [](const Vec4& tangent) { return is_no_unit(Vec3(tangent)); }))
    breaches_.add("tangents that are not of unit length, normalised", attributes->location() + ".TANGENT");
  if (!std::ranges::all_of(pool.tangents, is_direction)) {
    breaches_.add("meshes with tangents that are not directions; their tangents are computed from uv instead",
                  attributes->location());
    pool.tangents.clear();
    tangents.reset();
  }
  const auto read_uv = [&](size_t accessor, const GltfUv& use) {
    std::vector<Vec2> values = buffers_.vec2(accessor);
    for (Vec2& point : values) {
      point = use.linear * point + use.offset;
      point.y = 1 - point.y;  // glTF's v starts at the top of the picture
    }
    return values;
  };
  if (uv) pool.uv = read_uv(*uv, first_use);
  if (second_uv) pool.second_uv = read_uv(*second_uv, second_use);
  if (colors) {
    for (const Vec4& color : buffers_.colors(*colors)) {
      pool.colors.push_back(sound_color(Vec3(color)));
      pool.alphas.push_back(sound_color(Vec3(color.w)).x);
      if (Vec4(pool.colors.back(), pool.alphas.back()) != color)
        breaches_.add("colours of vertices below 0 or above 1, clamped", attributes->location() + ".COLOR_0");
    }
    if (std::ranges::all_of(pool.alphas, [](double alpha) { return alpha == 1; })) pool.alphas.clear();
  }
  const auto check = [&](bool has, size_t size) {
    if (has && size != pool.positions.size()) attributes->fail("do not all have as many elements");
  };
  check(normals.has_value(), pool.normals.size());
  check(tangents.has_value(), pool.tangents.size());
  check(uv.has_value(), pool.uv.size());
  check(second_uv.has_value(), pool.second_uv.size());
  check(colors.has_value(), pool.colors.size());
  add_targets(primitive, pose.weights, document_, buffers_, breaches_, pool);
  if (!pose.joints.empty()) move_to_joints(*attributes, pose.joints, document_, buffers_, breaches_, pool);
  if (pose.joints.empty() && attributes->has("JOINTS_0"))
    breaches_.add("meshes with joints that are shown without a skin, undeformed", attributes->location());

  // Read the corners.
  std::vector<uint32_t> corners;
  if (draco_corners) {
    corners = *draco_corners;
  } else if (const auto indices = primitive.index("indices", accessors)) {
    corners = buffers_.indices(*indices);
  } else {
    corners.resize(pool.positions.size());
    std::iota(corners.begin(), corners.end(), 0u);
  }
  if (!corners.empty() && std::ranges::max(corners) >= pool.positions.size()) {
    primitive.fail(fmt::format("refers to vertex {}, but there are {}, counted from 0",
                               std::ranges::max(corners), pool.positions.size()));
  }
  if (loose && !pool.alphas.empty()) left_out_.add("the alpha of the colours of points and lines");
  if (mode == point_list) return points_at(corners, pool);
  if (loose) {
    if (mode == line_list ? corners.size() % 2 != 0 : corners.size() < 2)
      breaches_.add("primitives whose last corners make no line", primitive.location());
    return Loose{std::move(pool.positions), std::move(pool.colors), assemble_lines(mode, corners)};
  }
  const uint64_t made_as = draco_corners ? triangle_list : mode;
  if (made_as == triangle_list ? corners.size() % 3 != 0 : corners.size() < 3)
    breaches_.add("primitives whose last corners make no triangle", primitive.location());
  RawTriangles raw;
  raw.has_normals = normals.has_value();
  raw.has_uv = uv.has_value();
  raw.positions = assemble(made_as, corners);
  Mesh mesh = MeshBuilder(pool, counts_).build(raw, smooth_);
  mesh.second_tangents = tangents && uv_use.second_tangents;
  return mesh;
}

std::vector<Mesh> GltfMeshes::take(std::vector<std::string>& warnings) {
  counts_.report(warnings);
  return std::move(meshes_);
}

}  // namespace eyeray::engine::importers
