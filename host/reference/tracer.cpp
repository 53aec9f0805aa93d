#include "host/reference/tracer.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/reference/bent_normal.hpp"
#include "host/reference/photon_map.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/interfaces.hpp"

namespace eyeray::engine::reference {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The largest SurfacePoint::lift, as a share of the longest edge. So extreme normals do not lift rays far
// away.
constexpr double most_lift = 0.25;

// The first ids of the scene's own objects, in the form that Objects takes.
std::vector<uint64_t> first_ids(const Scene& scene, const PrimitiveIds& ids) {
  std::vector<uint64_t> first;
  for (size_t i = 0; i < scene.shapes.size(); ++i) first.push_back(ids.of_shape(i));
  for (size_t i = 0; i < scene.instances.size(); ++i) first.push_back(ids.of_instance(i));
  return first;
}

// The first ids of a group's objects.
std::vector<uint64_t> first_ids(const Group& group, const std::vector<Mesh>& meshes) {
  std::vector<uint64_t> first(group.shapes.size());
  std::iota(first.begin(), first.end(), uint64_t(0));
  uint64_t triangles = 0;
  for (const Instance& instance : group.instances) {
    first.push_back(triangles);
    triangles += meshes[size_t(instance.mesh)].triangles.size();
  }
  return first;
}

}  // namespace

Tracer::Tracer(const Scene& scene, Acceleration acceleration)
    : scene_(scene),
      any_interface_(eyeray::engine::any_interface(scene)),
      ids_(scene),
      photon_maps_(std::make_unique<PhotonMaps>()) {
  for (const Mesh& mesh : scene.meshes) meshes_.emplace_back(mesh, acceleration);
  world_.emplace(scene.shapes, scene.instances, meshes_, scene.materials, first_ids(scene, ids_),
                 acceleration);
  for (const Group& group : scene.groups)
    group_bodies_.emplace_back(group.shapes, group.instances, meshes_, scene.materials,
                               first_ids(group, scene.meshes), acceleration);
  for (size_t i = 0; i < scene.group_instances.size(); ++i) {
    const GroupInstance& instance = scene.group_instances[i];
    groups_.emplace_back(instance, group_bodies_[size_t(instance.group)], ids_.of_group(i));
    groups_reach_ = std::max(groups_reach_, groups_.back().reach());
    groups_growth_ = std::max(groups_growth_, groups_.back().growth());
  }
  group_bvh_ =
      BoxBvh(uint32_t(groups_.size()), [this](uint32_t i) { return groups_[i].bounds(); }, acceleration);
  if (walks_at_random(scene.render.integrator)) light_choice_ = eyeray::engine::light_choice(scene);
}

Tracer::~Tracer() = default;

std::shared_ptr<const PhotonMap> Tracer::photons(uint32_t index) const {
  return photon_maps_->of_sample(*this, index);
}

void Tracer::leave_out(LeftOutPhotons photons) const {
  photon_maps_->leave_out(std::move(photons));
}

BoxRay Tracer::group_box_ray(const Ray& ray) const {
  return {ray, box_rounding * groups_growth_ * (magnitude(ray.o) + groups_reach_)};
}

uint64_t Tracer::primitive(const Objects& objects, const Objects::Hit& hit, int group) const {
  const PrimitiveIds::First before = group < 0 ? PrimitiveIds::First{} : ids_.of_group(size_t(group));
  return objects.first_id(hit.object, before) + (objects.is_shape(hit.object) ? 0 : hit.at.triangle);
}

Hit Tracer::complete(const Objects& objects, const Objects::Hit& hit, int group) const {
  return {hit.at, hit.object, primitive(objects, hit, group), objects.material(hit), group};
}

std::optional<Hit> Tracer::trace(const Ray& ray) const {
  uint32_t flags = 0;
  return trace(ray, flags);
}

std::optional<Hit> Tracer::trace(const Ray& ray, uint32_t& flags, bool coincident) const {
  std::optional<Hit> nearest;
  double sure_until = infinity;
  if (const auto hit = world_->trace(ray, infinity, sure_until)) nearest = complete(*world_, *hit, -1);
  if (!groups_.empty()) search_groups(ray, nearest, sure_until);
  if (sure_until < (nearest ? nearest->at.t : infinity)) flags |= iteration_limit;
  if (nearest && coincident)
    if (const auto other = coincident_with(ray, *nearest)) return other;
  return nearest;
}

std::optional<Hit> Tracer::coincident_with(const Ray& ray, const Hit& hit) const {
  const SurfacePoint point = surface(ray, hit);
  const double cosine = std::max(0.01, std::abs(glm::dot(ray.d, point.normal_geometric)));
  const double apart = 8 * 0x1p-24 * glm::length(point.position - scene_.camera.eye) / cosine;
  // Search backwards from beyond both surfaces, where the farther one comes first. If both have exactly the
  // same t, no ray in this direction distinguishes them.
  if (auto found = trace({ray.o + (hit.at.t + apart) * ray.d, -ray.d, ray.alpha_key});
      found && found->primitive != hit.primitive && found->at.t <= 2 * apart) {
    found->at.t = hit.at.t + apart - found->at.t;
    return found;
  }
  // The search may hit the first primitive again, once or twice.
  const double step = 1e-6 * apart;
  double start = hit.at.t - step;
  for (int again = 0; again < 4; ++again) {
    auto found = trace({ray.o + start * ray.d, ray.d, ray.alpha_key});
    if (!found || start + found->at.t > hit.at.t + apart) break;
    found->at.t += start;
    if (found->primitive != hit.primitive) return found;
    start = found->at.t + step;
  }
  return std::nullopt;
}

void Tracer::search_groups(const Ray& ray, std::optional<Hit>& nearest, double& sure_until) const {
  const BoxRay box_ray = group_box_ray(ray);
  group_bvh_.search(box_ray, nearest ? nearest->at.t : infinity, [&](uint32_t i, double limit) {
    const double entry = box_ray.entry(groups_[i].bounds());
    if (entry == infinity) return limit;
    auto hit = groups_[i].trace(ray, limit, sure_until);
    if (!hit) return limit;
    hit->at.t = std::max(hit->at.t, entry);
    const Hit found = complete(groups_[i].objects(), *hit, int(i));
    if (nearest && !(found.at.t < nearest->at.t ||
                     (found.at.t == nearest->at.t && found.primitive < nearest->primitive)))
      return limit;
    nearest = found;
    return std::min(limit, found.at.t);
  });
}

SurfacePoint Tracer::surface(const Ray& ray, const Hit& hit) const {
  const Objects::Hit object{hit.at, hit.object};
  SurfacePoint point =
      hit.group < 0 ? world_->surface(ray, object) : groups_[size_t(hit.group)].surface(ray, object);
  // Test this in world space only: a stretch may take an interpolated normal to the surface's other side, and
  // another stretch back again.
  if (!(glm::dot(point.normal, point.normal_geometric) > 0)) {
    point.normal = point.normal_geometric;
    point.lift = Vec2(-1);
  }
  point.normal_side = point.lift.x < 0 ? point.normal_geometric : point.normal;
  double longest = 0;
  for (const Vec3& edge : point.edges) longest = std::max(longest, glm::length(edge));
  point.lift = glm::min(point.lift, most_lift * longest);
  bend_normals(*scene_.materials[size_t(hit.material)], point, ray.d);
  return point;
}

double Tracer::reach(const Hit& hit, const Vec3& eye) const {
  const Objects::Hit object{hit.at, hit.object};
  return hit.group < 0 ? world_->reach(object, eye) : groups_[size_t(hit.group)].reach(object, eye);
}

double Tracer::t_scale(const Ray& ray, const Hit& hit, const SurfacePoint& surface) const {
  // Towards grazing incidence the error of t has no bound; there the gates explain a pixel by its
  // neighbourhood.
  const double cosine = std::max(0.01, std::abs(glm::dot(ray.d, surface.normal_geometric)));
  return reach(hit, scene_.camera.eye) / cosine;
}

double Tracer::transmittance(const Ray& ray, double t_end, uint32_t& flags) const {
  // Collect and sort the shares first: a product depends on the order of its factors.
  std::vector<Objects::Share> shares;
  bool gave_up = false;
  if (world_->add_shares(ray, t_end, 0, shares, gave_up)) return 0;
  bool lost = false;
  if (!groups_.empty()) {
    const BoxRay box_ray = group_box_ray(ray);
    group_bvh_.search(box_ray, t_end, [&](uint32_t i, double limit) {
      if (!(box_ray.entry(groups_[i].bounds()) < t_end)) return limit;
      lost = groups_[i].add_shares(ray, t_end, i + 1, shares, gave_up);
      return lost ? -1.0 : limit;
    });
  }
  if (lost) return 0;
  std::sort(shares.begin(), shares.end(), [](const Objects::Share& a, const Objects::Share& b) {
    return std::pair(a.space, a.object) < std::pair(b.space, b.object);
  });
  double product = 1;
  for (const Objects::Share& each : shares) product *= each.share;
  if (gave_up && product > 0) flags |= iteration_limit;
  return product < 1 && walks_at_random(scene_.render.integrator) ? 0 : product;
}

}  // namespace eyeray::engine::reference
