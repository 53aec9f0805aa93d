#include "host/scene/emitters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "host/core/error.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/luminance.hpp"
#include "host/scene/primitive_ids.hpp"
#include "host/scene/scene.hpp"
#include "host/scene/whole_shares.hpp"

namespace eyeray {

namespace {

constexpr size_t most_emitters = size_t{1} << 20;
// Of all weight, what is shared evenly.
constexpr double even_share = 1.0 / 16;

std::optional<EmitterForm> emitter_form(const ShapeForm& form) {
  if (const auto* sphere = std::get_if<SphereForm>(&form)) return *sphere;
  if (const auto* disk = std::get_if<DiskForm>(&form)) return *disk;
  if (const auto* triangle = std::get_if<TriangleForm>(&form)) return *triangle;
  const auto* polygon = std::get_if<PolygonForm>(&form);
  if (!polygon || polygon->outlines.size() != 1 || polygon->outlines[0].size() != 4) return std::nullopt;
  const auto& corners = polygon->outlines[0];
  const Vec3 u = corners[1] - corners[0], v = corners[3] - corners[0];
  const double gap = glm::length(corners[2] - corners[0] - u - v);
  if (gap > 1e-12 * (glm::length(u) + glm::length(v))) return std::nullopt;
  return ParallelogramForm{corners[0], u, v};
}

// The radius of a sphere around all that has an end, and the eye.
double reach(const Scene& scene) {
  Bounds all;
  all.include(scene.camera.eye);
  const auto include = [&](const Bounds& box, const Affine& map) {
    if (!std::isfinite(glm::length(box.max - box.min))) return;
    for (int corner = 0; corner < 8; ++corner)
      all.include(map.point({(corner & 1 ? box.max : box.min).x, (corner & 2 ? box.max : box.min).y,
                             (corner & 4 ? box.max : box.min).z}));
  };
  for (const auto& shape : scene.shapes) include(shape->bounds(), Affine(Mat4(1.0)));
  for (const Instance& instance : scene.instances)
    include(bounds(scene.meshes[size_t(instance.mesh)]), Affine(instance.transform));
  for (const GroupInstance& instance : scene.group_instances)
    include(bounds(scene.groups[size_t(instance.group)], scene.meshes), Affine(instance.transform));
  return glm::length(all.max - all.min) / 2;
}

// What a light sends into the scene; of one that no other program knows, as if it stood everywhere.
double power(const Light& light, double radius) {
  const LightForm form = light.form();
  if (const auto* point = std::get_if<PointLight>(&form); point && point->falloff == Falloff::inverse_square)
    return 4 * M_PI * M_PI * luminance(point->intensity);
  if (const auto* spot = std::get_if<SpotLight>(&form)) {
    const double inner = std::cos(spot->inner), outer = std::cos(spot->outer);
    return 2 * M_PI * M_PI * luminance(spot->intensity) * (1 - inner + (inner - outer) / 3);
  }
  Vec3 intensity(1);
  if (const auto* point = std::get_if<PointLight>(&form)) intensity = point->intensity;
  if (const auto* directional = std::get_if<DirectionalLight>(&form)) intensity = directional->intensity;
  return M_PI * M_PI * radius * radius * luminance(intensity);
}

class Collector {
 public:
  Collector(const Scene& scene, LightChoice& choice) : scene_(scene), choice_(choice) {}

  void run() {
    for (size_t i = 0; i < scene_.shapes.size(); ++i) add_shape(*scene_.shapes[i], ids_.of_shape(i));
    for (size_t i = 0; i < scene_.instances.size(); ++i) add_mesh(scene_.instances[i], ids_.of_instance(i));
    for (const Group& group : scene_.groups) {
      for (const auto& shape : group.shapes)
        if (emits(shape->material)) choice_.unsampled.push_back(shape->position);
      for (const Instance& instance : group.instances)
        if (emits(instance.material)) choice_.unsampled.push_back(instance.position);
    }
    std::ranges::sort(choice_.emitters, {}, &Emitter::primitive);
  }

 private:
  const Material& material(int index) const { return *scene_.materials[size_t(index)]; }
  bool emits(int index) const { return material(index).emits(); }
  // What it emits everywhere, unless there are holes or it varies.
  std::optional<Vec3> radiance(int index) const {
    return material(index).mask ? std::nullopt : material(index).constant_emission();
  }

  void add_shape(const Shape& shape, uint64_t primitive) {
    if (!emits(shape.material)) return;
    const auto color = radiance(shape.material);
    const auto form = emitter_form(shape.form());
    if (color && form)
      add({primitive, *color, *form, area_of(*form)});
    else
      choice_.unsampled.push_back(shape.position);
  }

  void add_mesh(const Instance& instance, uint64_t first) {
    if (!emits(instance.material)) return;
    const Mesh& mesh = scene_.meshes[size_t(instance.mesh)];
    const auto color = radiance(instance.material);
    if (!color || !mesh.colors.empty()) return choice_.unsampled.push_back(instance.position);
    const Affine map(instance.transform);
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      TriangleForm form;
      for (size_t k = 0; k < 3; ++k) form.vertices[k] = map.point(mesh.positions[mesh.triangles[i][k]]);
      add({first + i, *color, form, area_of(form)});
    }
  }

  void add(const Emitter& emitter) {
    if (emitter.area > 0) choice_.emitters.push_back(emitter);
    if (choice_.emitters.size() > most_emitters)
      throw Error(ExitCode::bad_input, "more than {} surfaces emit light; light fewer of them, or none",
                  most_emitters);
  }

  const Scene& scene_;
  LightChoice& choice_;
  const PrimitiveIds ids_{scene_};
};

// The share of each weight among all, a sixteenth of which is even.
std::vector<double> shares_of(const std::vector<double>& weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  const auto count = double(weights.size());
  std::vector<double> shares;
  for (const double weight : weights)
    shares.push_back(sum > 0 ? (1 - even_share) * weight / sum + even_share / count : 1 / count);
  return shares;
}

}  // namespace

double area_of(const EmitterForm& form) {
  struct Area {
    double operator()(const SphereForm& sphere) const { return 4 * M_PI * sphere.radius * sphere.radius; }
    double operator()(const DiskForm& disk) const {
      const Vec3 u(disk.to_world[0]), v(disk.to_world[2]);
      return M_PI * (1 - disk.inner * disk.inner) * glm::length(glm::cross(u, v));
    }
    double operator()(const TriangleForm& triangle) const {
      const auto& [a, b, c] = triangle.vertices;
      return glm::length(glm::cross(b - a, c - a)) / 2;
    }
    double operator()(const ParallelogramForm& it) const {
      return glm::length(glm::cross(it.edge_u, it.edge_v));
    }
  };
  return std::visit(Area(), form);
}

LightChoice light_choice(const Scene& scene) {
  LightChoice choice;
  Collector(scene, choice).run();
  std::vector<double> weights;
  const double radius = reach(scene);
  for (const auto& light : scene.lights) weights.push_back(power(*light, radius));
  for (const Emitter& emitter : choice.emitters)
    weights.push_back(2 * M_PI * emitter.area * luminance(emitter.radiance));
  choice.ends.resize(weights.size());
  whole_shares(shares_of(weights), choice.ends);
  return choice;
}

}  // namespace eyeray
