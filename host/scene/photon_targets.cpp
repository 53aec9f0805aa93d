#include "host/scene/photon_targets.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "host/scene/emitter_form.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine {
namespace {

// Spheres are wider by this factor, so that rounding hides nothing at a sphere's rim, and lights that stand
// on a sphere see it.
constexpr double wider = 1 + 1e-3;

struct Lobes {
  bool wide = false, sharp = false;
};

Lobes lobes_of(const Material& material) {
  Lobes lobes;
  for (const double coordinate : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const ScatteringContext context{.point = Vec2(coordinate), .cos_view = 0.7, .ior_from = 1, .ior_to = 1};
    const Bsdf bsdf = material.bsdf(context, material.scattering(context));
    const auto add = [&](bool is_there, double roughness) {
      if (is_there) (roughness >= 0.32 ? lobes.wide : lobes.sharp) = true;
    };
    add(bsdf.diffuse + bsdf.translucent + bsdf.sheen != Vec3(0), 1);
    add(bsdf.metallic * bsdf.metal.f90 + bsdf.layer.f90 + bsdf.glass + bsdf.thin != Vec3(0), bsdf.roughness);
    add(bsdf.coat > 0, bsdf.coat_roughness);
    add(bsdf.mirror + bsdf.transmitted + bsdf.passed != Vec3(0), 0);
  }
  return lobes;
}

PhotonTarget around(std::span<const Vec3> points) {
  Bounds box;
  for (const Vec3& p : points) box.include(p);
  PhotonTarget target{(box.min + box.max) / 2.0, 0};
  for (const Vec3& p : points) target.radius = std::max(target.radius, glm::length(p - target.center));
  return target;
}

PhotonTarget around(std::span<const PhotonTarget> targets) {
  Bounds box;
  for (const PhotonTarget& each : targets) {
    box.include(each.center - each.radius);
    box.include(each.center + each.radius);
  }
  PhotonTarget all{(box.min + box.max) / 2.0, 0};
  for (const PhotonTarget& each : targets)
    all.radius = std::max(all.radius, glm::length(each.center - all.center) + each.radius);
  return all;
}

PhotonTarget around(const Shape& shape, const Affine& map) {
  if (const auto form = emitter_form(shape.form()))
    if (const auto there = mapped(*form, map); const auto* sphere = std::get_if<SphereForm>(&there))
      return {sphere->center, sphere->radius};
  const Bounds box = shape.bounds();
  std::vector<Vec3> corners;
  for (const double x : {box.min.x, box.max.x})
    for (const double y : {box.min.y, box.max.y})
      for (const double z : {box.min.z, box.max.z}) corners.push_back(map.point({x, y, z}));
  return around(corners);
}

class TargetCollector {
 public:
  explicit TargetCollector(const Scene& scene) : scene_(scene) {
    for (const auto& material : scene.materials) {
      const Lobes lobes = lobes_of(*material);
      bundles_.push_back(lobes.sharp && !lobes.wide);
    }
  }

  std::vector<PhotonTarget> run() {
    add(scene_.shapes, scene_.instances, Mat4(1.0));
    for (const GroupInstance& instance : scene_.group_instances) {
      const Group& group = scene_.groups[size_t(instance.group)];
      add(group.shapes, group.instances, instance.transform);
    }
    std::erase_if(found_, [](const PhotonTarget& target) {
      return !std::isfinite(target.radius + glm::length(target.center)) || target.radius == 0;
    });
    return std::move(found_);
  }

 private:
  void add(const std::vector<std::unique_ptr<Shape>>& shapes, const std::vector<Instance>& instances,
           const Mat4& map) {
    for (const auto& shape : shapes) {
      bool bundles = false;
      for_each_leaf(*shape, [&](const Shape& leaf) { bundles = bundles || bundles_[size_t(leaf.material)]; });
      if (bundles) found_.push_back(around(*shape, Affine(map)));
    }
    for (const Instance& instance : instances) {
      if (!bundles_[size_t(instance.material)]) continue;
      const Affine to_world(map * instance.transform);
      std::vector<Vec3> points;
      for (const Vec3& p : scene_.meshes[size_t(instance.mesh)].positions)
        points.push_back(to_world.point(p));
      found_.push_back(around(points));
    }
  }

  const Scene& scene_;
  std::vector<char> bundles_;  // for each material: whether its lobes are all sharp
  std::vector<PhotonTarget> found_;
};

// Puts at most `most` spheres around all targets: halves the targets along the longest axis, as a BVH does.
void cluster(std::span<PhotonTarget> targets, size_t most, std::vector<PhotonTarget>& clusters) {
  if (targets.size() <= most) {
    clusters.insert(clusters.end(), targets.begin(), targets.end());
  } else if (most == 1) {
    clusters.push_back(around(targets));
  } else {
    Bounds box;
    for (const PhotonTarget& each : targets) box.include(each.center);
    const Vec3 size = box.max - box.min;
    const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
    std::ranges::stable_sort(targets, {}, [axis](const PhotonTarget& each) { return each.center[axis]; });
    const size_t half = targets.size() / 2;
    cluster(targets.first(half), most / 2, clusters);
    cluster(targets.subspan(half), most - most / 2, clusters);
  }
}

}  // namespace

bool scatters_widely(const Material& material) {
  return lobes_of(material).wide;
}

std::vector<PhotonTarget> photon_targets(const Scene& scene, double reach) {
  std::vector<PhotonTarget> all = TargetCollector(scene).run(), targets;
  const auto is_large = [&](const PhotonTarget& target) { return target.radius > reach / 2; };
  std::erase_if(all, is_large);
  cluster(all, most_photon_targets, targets);
  std::erase_if(targets, is_large);
  for (PhotonTarget& target : targets) target.radius *= wider;
  return targets;
}

}  // namespace eyeray::engine
