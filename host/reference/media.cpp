#include "host/reference/media.hpp"

#include <algorithm>

#include "host/reference/crossings.hpp"

namespace eyeray::engine::reference {

namespace {

struct Crossing {
  double t;
  int material;
  bool leaving;
};

// One object of the world or of a group, in the form that for_each_crossing() takes.
template <typename Holder>
struct Object {
  const Holder& holder;
  const Objects& objects;
  size_t index;

  std::optional<TriangleHit> intersect(const Ray& ray) const {
    const auto hit = holder.intersect(index, ray);
    return hit ? std::optional(hit->at) : std::nullopt;
  }
  SurfacePoint surface(const Ray& ray, const TriangleHit& hit) const {
    return holder.surface(ray, {hit, index});
  }
  int most_crossings() const { return objects.most_crossings(index); }
};

// The media that the ray leaves without having entered them, innermost first.
std::vector<int> left_by(const Tracer& tracer, const Ray& ray) {
  std::vector<Crossing> crossings;
  const auto has_medium = [&](int material) {
    return fills(*tracer.scene().materials[size_t(material)], tracer.scene().render.integrator);
  };
  const auto collect = [&](const auto& object, const auto& material_at) {
    for_each_crossing(object, ray, [&](double t, const auto& hit, const SurfacePoint& surface) {
      const int material = material_at(hit);
      if (has_medium(material))
        crossings.push_back({t, material, glm::dot(ray.d, surface.normal_geometric) > 0});
      return true;
    });
  };
  const auto collect_all = [&]<typename Holder>(const Holder& holder, const Objects& objects) {
    for (size_t i = 0; i < objects.size(); ++i) {
      bool any_medium = false;
      objects.for_each_material(i, [&](int material) { any_medium = any_medium || has_medium(material); });
      if (!any_medium) continue;
      collect(Object<Holder>{holder, objects, i},
              [&](const TriangleHit& hit) { return objects.material({hit, i}); });
    }
  };
  collect_all(tracer.world(), tracer.world());
  const BoxRay box_ray = tracer.group_box_ray(ray);
  for (const GroupGeometry& group : tracer.groups())
    if (box_ray.entry(group.bounds()) < std::numeric_limits<double>::infinity())
      collect_all(group, group.objects());
  std::stable_sort(crossings.begin(), crossings.end(),
                   [](const Crossing& a, const Crossing& b) { return a.t < b.t; });

  // Match each crossing that leaves a medium with an earlier one that enters it. Those without a match leave
  // media around the ray's start.
  std::vector<int> entered;
  std::vector<int> around;
  for (const Crossing& crossing : crossings) {
    if (!crossing.leaving) {
      entered.push_back(crossing.material);
    } else if (const auto found = std::find(entered.rbegin(), entered.rend(), crossing.material);
               found != entered.rend()) {
      entered.erase(std::next(found).base());
    } else {
      around.push_back(crossing.material);
    }
  }
  return around;
}

}  // namespace

std::vector<int> media_at(const Scene& scene, const Vec3& point) {
  return media_at(Tracer(scene, Acceleration::brute_force), point);
}

std::vector<int> media_at(const Tracer& tracer, const Vec3& point) {
  // Trace along a direction that no edge or symmetry of a sensible scene has, and against it. A ray leaves a
  // half-space in only one of the two directions; such a half-space lies around all closed objects.
  const Vec3 direction = glm::normalize(Vec3(0.3141592653589793, 0.8979323846264338, 0.2718281828459045));
  const std::vector<int> ahead = left_by(tracer, {point, direction});
  std::vector<int> media = left_by(tracer, {point, -direction});
  for (const int material : ahead) {
    const auto found = std::find(media.begin(), media.end(), material);
    if (found != media.end()) media.erase(found);
  }
  media.insert(media.begin(), ahead.begin(), ahead.end());
  std::reverse(media.begin(), media.end());
  return media;
}

bool MediaStack::push(int material) {
  if (size_ == materials_.size()) return false;
  materials_[size_++] = material;
  return true;
}

void MediaStack::remove(int material) {
  for (size_t i = size_; i-- > 0;) {
    if (materials_[i] != material) continue;
    std::copy(materials_.begin() + std::ptrdiff_t(i) + 1, materials_.begin() + std::ptrdiff_t(size_),
              materials_.begin() + std::ptrdiff_t(i));
    --size_;
    return;
  }
}

}  // namespace eyeray::engine::reference
