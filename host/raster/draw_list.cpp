#include "host/raster/draw_list.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "host/raster/tessellation.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/primitive_ids.hpp"

namespace eyeray::engine::raster {
namespace {

// The wanted distance, in pixels, of a tessellation from its surface at the point nearest to the eye.
constexpr double aim = 0.02;
// The least distance assumed between the eye and a shape around it, as a share of the shape's size.
constexpr double least_share = 0.02;

// True if `form` can be drawn: tries the coarsest tessellation.
bool is_drawn(const ShapeForm& form) {
  if (std::holds_alternative<PlaneForm>(form)) return true;
  return tessellate(form, Mat4(1.0), 1e300).has_value();
}

std::string why_not(const AlphaMask& mask) {
  return mask.blends ? "that blend" : "with cutouts";
}

double reach_of(const std::optional<Ball>& around, const View& view) {
  return around ? glm::length(view.to_camera(around->center)) + around->radius : 0;
}

}  // namespace

DrawList::DrawList(const Scene& scene, const View& view) : scene_(scene), view_(view) {
  walk([&](const Shape& shape, const Mat4&, uint64_t id) { leave_out(shape, id); },
       [&](const Instance& instance, const Mat4&, uint64_t id) { leave_out(instance, id); });
}

template <typename OfShape, typename OfInstance>
void DrawList::walk(const OfShape& shape, const OfInstance& instance) const {
  const PrimitiveIds ids(scene_);
  for (size_t i = 0; i < scene_.shapes.size(); ++i) shape(*scene_.shapes[i], Mat4(1.0), ids.of_shape(i));
  for (size_t i = 0; i < scene_.instances.size(); ++i)
    instance(scene_.instances[i], scene_.instances[i].transform, ids.of_instance(i));
  for (size_t g = 0; g < scene_.group_instances.size(); ++g) {
    const GroupInstance& shown = scene_.group_instances[g];
    const Group& group = scene_.groups[size_t(shown.group)];
    PrimitiveIds::First next = ids.of_group(g);
    for (const auto& each : group.shapes) shape(*each, shown.transform, next.shape++);
    for (const Instance& each : group.instances) {
      instance(each, shown.transform * each.transform, next.triangle);
      next.triangle += scene_.meshes[size_t(each.mesh)].triangles.size();
    }
  }
}

void DrawList::leave_out(const Shape& shape, uint64_t id) {
  const auto& mask = scene_.materials[size_t(shape.material)]->mask;
  if (!mask && is_drawn(shape.form())) return;
  ++not_drawn_[mask ? why_not(*mask) : std::string(shape.type)];
  left_out_[id] = id + 1;
}

void DrawList::leave_out(const Instance& instance, uint64_t id) {
  const auto& mask = scene_.materials[size_t(instance.material)]->mask;
  if (!mask) return;
  const uint64_t count = scene_.meshes[size_t(instance.mesh)].triangles.size();
  if (count == 0) return;
  not_drawn_[why_not(*mask)] += count;
  left_out_[id] = id + count;
}

bool DrawList::draws(uint64_t primitive) const {
  const auto after = left_out_.upper_bound(primitive);
  return after == left_out_.begin() || primitive >= std::prev(after)->second;
}

double DrawList::reach(uint64_t primitive) const {
  const PrimitiveIds::Location at = PrimitiveIds(scene_).locate(primitive, scene_);
  const GroupInstance* shown =
      at.group_instance < 0 ? nullptr : &scene_.group_instances[size_t(at.group_instance)];
  const Group* group = shown ? &scene_.groups[size_t(shown->group)] : nullptr;
  const Mat4 map = shown ? shown->transform : Mat4(1.0);
  if (at.is_shape) {
    const Shape& shape = group ? *group->shapes[at.index] : *scene_.shapes[at.index];
    return reach_of(ball_around(shape.bounds(), map), view_);
  }
  const Instance& instance = group ? group->instances[at.index] : scene_.instances[at.index];
  return reach_of(ball_around(bounds(scene_.meshes[size_t(instance.mesh)]), map * instance.transform), view_);
}

void DrawList::for_each(const Visit& visit) const {
  walk([&](const Shape& shape, const Mat4& map, uint64_t id) { add(shape, map, id, visit); },
       [&](const Instance& instance, const Mat4& map, uint64_t id) { add(instance, map, id, visit); });
}

void DrawList::add(const Shape& shape, const Mat4& map, uint64_t id, const Visit& visit) const {
  if (!draws(id)) return;
  const ShapeForm form = shape.form();
  if (const auto* plane = std::get_if<PlaneForm>(&form)) {  // planes are not allowed in groups
    view_.cut(view_.plane(plane->point, plane->normal), {.id = uint32_t(id)}, visit);
    return;
  }

  // Tessellate the shape as finely as the view needs.
  const std::optional<Ball> around = ball_around(shape.bounds(), map);
  double nearest = 0;
  ScreenTriangle like{.id = uint32_t(id), .reach = reach_of(around, view_)};
  if (around) {
    const Vec3 center = view_.to_camera(around->center);
    if (!view_.may_see(center, around->radius)) return;
    // A shape around the eye is assumed to be near the surface of its ball.
    const double inside = 0.3 * std::fabs(around->radius - glm::length(center));
    nearest = std::max({center.z - around->radius, inside, least_share * around->radius});
  }
  const std::optional<Tessellation> drawn = tessellate(form, map, aim * view_.pixel_at(nearest));
  if (!drawn) return;
  like.bound = drawn->bound;
  std::vector<Vec4> points;
  for (const Vec3& point : drawn->points) points.emplace_back(view_.to_camera(point), 1.0);
  for (const auto& [a, b, c] : drawn->triangles)
    view_.cut(std::array{points[a], points[b], points[c]}, like, visit);
}

void DrawList::add(const Instance& instance, const Mat4& map, uint64_t id, const Visit& visit) const {
  if (!draws(id)) return;
  const Mesh& mesh = scene_.meshes[size_t(instance.mesh)];
  const std::optional<Ball> around = ball_around(bounds(mesh), map);
  if (!around || !view_.may_see(view_.to_camera(around->center), around->radius)) return;
  std::vector<Vec4> points;
  for (const Vec3& point : mesh.positions)
    points.emplace_back(view_.to_camera(Vec3(map * Vec4(point, 1.0))), 1.0);
  ScreenTriangle like{.id = uint32_t(id), .reach = reach_of(around, view_)};
  const bool front_only = scene_.materials[size_t(instance.material)]->front_only;
  // The camera's space is left-handed.
  const double outside = Affine(map).mirrors() ? 1 : -1;
  const auto is_seen = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 normal = outside * glm::cross(b - a, c - a);
    return !front_only || glm::dot(normal, view_.perspective() ? a : Vec3(0, 0, 1)) < 0;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    if (is_seen(Vec3(points[a]), Vec3(points[b]), Vec3(points[c])))
      view_.cut(std::array{points[a], points[b], points[c]}, like, visit);
    ++like.id;
  }
}

}  // namespace eyeray::engine::raster
