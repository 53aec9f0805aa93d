#include "host/scene/emitters.hpp"

#include <algorithm>

#include "host/core/error.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/primitive_ids.hpp"
#include "host/scene/scene.hpp"
#include "host/scene/triangle.hpp"

namespace eyeray::engine {

namespace {

constexpr size_t most_emitters = size_t{1} << 20;

// The mean radiance of an emitting material. A radiance that varies is averaged over uv.
Vec3 mean_radiance(const Material& material, const Vec3& position) {
  constexpr int steps = 32;
  Vec3 sum(0);
  for (int y = 0; y < steps; ++y)
    for (int x = 0; x < steps; ++x)
      sum += emitted(material, {Vec2(x + 0.5, y + 0.5) / double(steps), position}, Vec3(1));
  return sum / double(steps * steps);
}

// The mean radiance over a triangle.
Vec3 mean_radiance(const Material& material, const TriangleForm& triangle, const EmitterCorners& corners) {
  constexpr int steps = 4;
  Vec3 sum(0);
  int count = 0;
  for (int i = 0; i < steps; ++i)
    for (int k = 0; k < steps - i; ++k, ++count) {
      const double b = (i + 1.0 / 3) / steps, c = (k + 1.0 / 3) / steps, a = 1 - b - c;
      const auto at = [&](const auto& values) { return a * values[0] + b * values[1] + c * values[2]; };
      sum += emitted(material, {at(corners.uv), at(corners.second_uv), at(triangle.vertices)},
                     at(corners.colors));
    }
  return sum / double(count);
}

class Collector {
 public:
  Collector(const Scene& scene, Emitters& found) : scene_(scene), found_(found) {}

  void run() {
    const Affine here(Mat4(1.0));
    for (size_t i = 0; i < scene_.shapes.size(); ++i) add_shape(*scene_.shapes[i], ids_.of_shape(i), here);
    for (size_t i = 0; i < scene_.instances.size(); ++i)
      add_mesh(scene_.instances[i], ids_.of_instance(i), Affine(scene_.instances[i].transform));
    for (size_t i = 0; i < scene_.group_instances.size(); ++i) add_group(i);
    std::ranges::sort(found_.sampled, {}, &Emitter::primitive);
  }

 private:
  const Material& material(int index) const { return *scene_.materials[size_t(index)]; }
  // True if shapes of the material are emitters. Photons must come from all that emit.
  bool emits(int index) const {
    const Material& its = material(index);
    return its.emits() && (its.samples_emission || sends_photons(scene_.render.integrator));
  }

  void add_group(size_t index) {
    const GroupInstance& instance = scene_.group_instances[index];
    const Group& group = scene_.groups[size_t(instance.group)];
    auto [shape, triangle] = ids_.of_group(index);
    for (const auto& each : group.shapes) add_shape(*each, shape++, Affine(instance.transform));
    for (const Instance& each : group.instances) {
      add_mesh(each, triangle, Affine(instance.transform * each.transform));
      triangle += scene_.meshes[size_t(each.mesh)].triangles.size();
    }
  }

  // `map`: from the space that the shape is in to the world.
  void add_shape(const Shape& shape, uint64_t primitive, const Affine& map) {
    if (!emits(shape.material)) return;
    const Material& its = material(shape.material);
    const auto own = emitter_form(shape.form());
    // A quadric has its own uv, even if it is a sphere or a cylinder.
    const bool other_uv = !its.constant_emission() && shape.type == "quadric";
    if (!own || its.mask || other_uv) return found_.unsampled.push_back(shape.position);
    Emitter emitter{.primitive = primitive,
                    .radiance = its.constant_emission().value_or(Vec3(0)),
                    .form = mapped(*own, map),
                    .area = 0,
                    .side = its.emits_in_front ? side_of(shape, *own) : 0,
                    .material = shape.material,
                    .varies = !its.constant_emission()};
    if (map.mirrors() && is_flat(*own)) emitter.side = -emitter.side;
    if (emitter.varies) {
      if (const auto* triangle = std::get_if<TriangleForm>(&emitter.form)) {
        const auto uv = [&](double u, double v) { return shape.surface(Ray(), {.u = u, .v = v}).uv; };
        const std::array at{uv(0, 0), uv(1, 0), uv(0, 1)};
        emitter.corners =
            std::make_shared<EmitterCorners>(EmitterCorners{at, at, {Vec3(1), Vec3(1), Vec3(1)}});
        emitter.radiance = mean_radiance(its, *triangle, *emitter.corners);
      } else {
        emitter.radiance = mean_radiance(its, point_of(emitter.form));
      }
    }
    add(std::move(emitter));
  }

  // 1 if the shape's normals point the same way as its form's, else −1.
  static double side_of(const Shape& shape, const EmitterForm& form) {
    if (!is_flat(form)) return 1;
    const Vec3 n = normal_of(form);
    const Ray ray{point_of(form) + n, -n};
    const auto hit = shape.intersect(ray);
    return hit && glm::dot(shape.surface(ray, *hit).normal_geometric, n) < 0 ? -1 : 1;
  }

  void add_mesh(const Instance& instance, uint64_t first, const Affine& map) {
    if (!emits(instance.material)) return;
    const Mesh& mesh = scene_.meshes[size_t(instance.mesh)];
    const Material& its = material(instance.material);
    if (its.mask) return found_.unsampled.push_back(instance.position);
    const bool varies = !its.constant_emission() || !mesh.colors.empty();
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
      TriangleForm form;
      EmitterCorners corners{corner_weights, {}, {Vec3(1), Vec3(1), Vec3(1)}};
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t vertex = mesh.triangles[i][k];
        form.vertices[k] = map.point(mesh.positions[vertex]);
        if (!mesh.uv.empty()) corners.uv[k] = mesh.uv[vertex];
        corners.second_uv[k] = mesh.second_uv.empty() ? corners.uv[k] : mesh.second_uv[vertex];
        if (!mesh.colors.empty()) corners.colors[k] = mesh.colors[vertex];
      }
      add({.primitive = first + i,
           .radiance = varies ? mean_radiance(its, form, corners) : *its.constant_emission(),
           .form = form,
           .area = 0,
           .side = !its.emits_in_front ? 0.0
                   : map.mirrors()     ? -1.0
                                       : 1.0,
           .material = instance.material,
           .varies = varies,
           .corners = varies ? std::make_shared<EmitterCorners>(corners) : nullptr});
    }
  }

  void add(Emitter emitter) {
    emitter.area = area_of(emitter.form);
    if (emitter.area > 0) found_.sampled.push_back(std::move(emitter));
    if (found_.sampled.size() > most_emitters)
      throw Error(ExitCode::bad_input,
                  "more than {} surfaces emit light; give fewer of them an `emission`, or none",
                  most_emitters);
  }

  const Scene& scene_;
  Emitters& found_;
  const PrimitiveIds ids_{scene_};
};

}  // namespace

Vec3 emitted(const Material& material, const TextureContext& point, const Vec3& color) {
  return material.scattering({.point = point, .cos_view = 1, .ior_from = 1, .ior_to = 1, .color = color})
      .emitted;
}

Emitters emitters(const Scene& scene) {
  Emitters found;
  Collector(scene, found).run();
  return found;
}

}  // namespace eyeray::engine
