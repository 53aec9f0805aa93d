#include "host/loader/mesh_placement.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "host/scene/affine.hpp"
#include "host/scene/triangle.hpp"
#include "host/shapes/make.hpp"

namespace eyeray::engine::loader {

namespace {

Corners corners(const Mesh& mesh, const std::array<uint32_t, 3>& triangle) {
  return {mesh.positions[triangle[0]], mesh.positions[triangle[1]], mesh.positions[triangle[2]]};
}

// Least thickness of a mesh's thinnest triangles under a map. A rotation alone changes a thickness by up to
// three times.
constexpr double least_thickness = thinnest_triangle / 10;

}  // namespace

void MeshPlacer::take_meshes(importers::ImportedScene& import, Placed& placed) {
  placed.first_mesh = static_cast<int>(scene_.meshes.size());
  for (Mesh& mesh : import.meshes) {
    double thinnest = 1;
    for (const auto& triangle : mesh.triangles)
      thinnest = std::min(thinnest, thickness(corners(mesh, triangle)));
    extents_.push_back({bounds(mesh), thinnest});
    scene_.meshes.push_back(std::move(mesh));
  }
}

void MeshPlacer::take_materials(importers::ImportedScene& import, Placed& placed) {
  placed.first_material = static_cast<int>(scene_.materials.size());
  std::ranges::move(import.materials, std::back_inserter(scene_.materials));
}

int MeshPlacer::plain_material_index(bool colored) {
  int& index = plain_[colored];
  if (index < 0) {
    index = static_cast<int>(scene_.materials.size());
    scene_.materials.push_back(importers::plain_material(colored));
  }
  return index;
}

// The index in the scene of a material of the file, or of its stand-in.
int MeshPlacer::material_of(const importers::ImportedScene& import, const Placing& placing, int material,
                            bool colored) {
  if (placing.material) return *placing.material;
  return material < 0 ? plain_material_index(colored) : placed_.at(&import).first_material + material;
}

std::string MeshPlacer::check(size_t index, const Mat4& transform) const {
  if (const std::string why = why_singular(transform); !why.empty())
    return fmt::format("together with the transforms in the file, `transform` cannot be inverted: {}", why);
  const Affine map(transform);
  const auto& [bounds, thinnest] = extents_[index];
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p(corner & 1 ? bounds.min.x : bounds.max.x, corner & 2 ? bounds.min.y : bounds.max.y,
                 corner & 4 ? bounds.min.z : bounds.max.z);
    if (!(magnitude(map.point(p)) <= max_coordinate))
      return "the transformed vertices are out of range (coordinates up to 1e12)";
  }

  // Check every triangle only if a bound for the whole mesh does not suffice.
  if (thinnest * thinning(map.linear) >= least_thickness) return "";
  const Mesh& mesh = scene_.meshes[index];
  for (const auto& triangle : mesh.triangles) {
    Corners moved = corners(mesh, triangle);
    for (Vec3& corner : moved) corner = map.point(corner);
    if (!(thickness(moved) >= least_thickness))
      return "the transform leaves some of the triangles without area";
  }
  return "";
}

std::string MeshPlacer::place(importers::ImportedScene& import, const Placing& placing,
                              std::vector<Instance>& into) {
  const auto& [transform, material, position, name] = placing;
  Placed& file = placed_[&import];
  if (file.first_mesh < 0) take_meshes(import, file);
  if (!material && file.first_material < 0) take_materials(import, file);
  for (const Instance& instance : import.instances) {
    Instance placed{file.first_mesh + instance.mesh, transform * instance.transform, 0, position, name};
    if (std::string wrong = check(static_cast<size_t>(placed.mesh), placed.transform); !wrong.empty())
      return wrong;
    placed.material = material_of(import, placing, instance.material,
                                  !scene_.meshes[static_cast<size_t>(placed.mesh)].colors.empty());
    into.push_back(std::move(placed));
  }
  return "";
}

std::string MeshPlacer::place_shapes(const importers::ImportedScene& import, const Placing& placing) {
  const auto add = [&](std::unique_ptr<Shape> shape, std::string_view type, int material) {
    shape->material = material;
    shape->type = type;
    shape->name = placing.name;
    shape->position = placing.position;
    shapes_.push_back(std::move(shape));
  };
  for (const auto& [cloud, own] : import.clouds) {
    auto points = shapes::make_points(cloud, cloud->radius, placing.transform);
    if (!points)
      return similarity(placing.transform)
                 ? "the transformed points are out of range (coordinates up to 1e12)"
                 : "the file has points, which cannot be sheared or scaled unevenly";
    add(std::move(points), "points", material_of(import, placing, own, !cloud->colors.empty()));
  }
  for (const auto& [segments, radius, own] : import.lines) {
    const int material = material_of(import, placing, own, false);
    for (const auto& [from, to] : segments) {
      if (!shapes::fits_capsule(from, to, radius, placing.transform))
        return "the transformed lines are out of range, or too thin to be computed with";
      add(shapes::make_capsule(from, to, radius, placing.transform), "capsule", material);
    }
  }
  return "";
}

void MeshPlacer::take_shapes(std::string_view type, std::vector<std::unique_ptr<Shape>>& into) {
  const auto taken = std::stable_partition(shapes_.begin(), shapes_.end(),
                                           [&](const auto& shape) { return shape->type != type; });
  std::move(taken, shapes_.end(), std::back_inserter(into));
  shapes_.erase(taken, shapes_.end());
}

}  // namespace eyeray::engine::loader
