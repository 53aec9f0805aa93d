#include "host/loader/mesh_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "host/loader/mesh_reading.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::loader {

namespace {

constexpr double fov_degrees = 30;
const Vec3 towards_eye = glm::normalize(Vec3(0.6, 0.55, 1.0));
// The share of the picture's shorter side that the camera leaves free around the file.
constexpr double margin = 0.06;

toml::array list(const Vec3& v) {
  return toml::array{v.x, v.y, v.z};
}

// Limit on the vertices that the camera frames; if there are more, it frames the boxes of their meshes
// instead.
constexpr size_t most_points = 4'000'000;

// Calls visit(p) for points in the world that span all instances and all clouds.
template <typename Visit>
void each_point(const importers::ImportedScene& import, const Visit& visit) {
  size_t count = 0;
  for (const Instance& instance : import.instances)
    count += import.meshes[static_cast<size_t>(instance.mesh)].positions.size();
  for (const Instance& instance : import.instances) {
    const Mesh& mesh = import.meshes[static_cast<size_t>(instance.mesh)];
    const auto move = [&](const Vec3& p) { visit(Vec3(instance.transform * Vec4(p, 1))); };
    if (count <= most_points) {
      for (const Vec3& position : mesh.positions) move(position);
    } else {
      const auto [low, high] = bounds(mesh);
      for (int corner = 0; corner < 8; ++corner) {
        move({corner & 1 ? low.x : high.x, corner & 2 ? low.y : high.y, corner & 4 ? low.z : high.z});
      }
    }
  }
  const auto visit_ball = [&](const Vec3& center, double radius) {
    visit(center - radius);
    visit(center + radius);
  };
  for (const importers::ImportedPoints& points : import.clouds)
    for (const Vec3& position : points.cloud->positions) visit_ball(position, points.cloud->radius);
  for (const importers::ImportedLines& lines : import.lines)
    for (const importers::LineSegment& segment : lines.segments)
      for (const Vec3& end : {segment.from, segment.to}) visit_ball(end, lines.radius);
}

Bounds bounds_of(const importers::ImportedScene& import) {
  Bounds box;
  each_point(import, [&](const Vec3& p) { box.include(p); });
  return box;
}

Vec3 middle_of(const Bounds& box) {
  return box.min + (box.max - box.min) / 2.0;
}

// Calls visit(p) for points that span all that the file passes as it turns about the vertical through
// `centre`.
template <typename Visit>
void each_turned_point(const importers::ImportedScene& import, const Vec3& centre, const Visit& visit) {
  double radius = 0;
  each_point(import,
             [&](const Vec3& p) { radius = std::max(radius, std::hypot(p.x - centre.x, p.z - centre.z)); });
  const Bounds box = bounds_of(import);
  constexpr int corners = 64;
  for (int i = 0; i < corners; ++i) {
    const double angle = i * 2 * std::numbers::pi / corners;
    const Vec3 out(radius * std::cos(angle), 0, radius * std::sin(angle));
    for (const double y : {box.min.y, box.max.y}) visit(Vec3(centre.x, y, centre.z) + out);
  }
}

// A camera that shows all of the file, also while it turns if it does, and little else, in pictures of any
// aspect ratio.
importers::ImportedCamera framing(const importers::ImportedScene& import, bool turns) {
  const Vec3 centre = middle_of(bounds_of(import));

  // Four planes through the eye bound the view. Push each plane towards the points until it touches one. Two
  // opposite planes then intersect at the nearest possible eye for their axis. The farther of the two axes'
  // eyes sees everything, with equal margins on both sides.
  const Vec3 right = glm::normalize(glm::cross(Vec3(0, 1, 0), towards_eye));
  const Vec3 up = glm::cross(towards_eye, right);
  const double slope = std::tan(glm::radians(fov_degrees / 2)) * (1 - margin);
  constexpr double lowest = std::numeric_limits<double>::lowest();
  Vec2 most[2] = {Vec2(lowest),
                  Vec2(lowest)};  // along right and up: on the positive side; on the negative side
  const auto include = [&](const Vec3& p) {
    const Vec3 from_centre = p - centre;
    const double nearer = slope * glm::dot(from_centre, towards_eye);
    const Vec2 lateral(glm::dot(from_centre, right), glm::dot(from_centre, up));
    most[0] = glm::max(most[0], lateral + nearer);
    most[1] = glm::max(most[1], -lateral + nearer);
  };
  if (turns)
    each_turned_point(import, centre, include);
  else
    each_point(import, include);
  const Vec2 middle = (most[0] - most[1]) / 2.0;
  const Vec2 distance = (most[0] + most[1]) / (2 * slope);

  importers::ImportedCamera camera;
  camera.form = PerspectiveCamera{fov_degrees, FovAxis::shorter};
  camera.target = centre + right * middle.x + up * middle.y;
  camera.eye = camera.target + towards_eye * std::max(distance.x, distance.y);
  return camera;
}

toml::table table(const PerspectiveCamera& camera) {
  return toml::table{{"type", "perspective"},
                     {"fov", camera.fov_degrees},
                     {"fov_axis", fov_axis_names[static_cast<size_t>(camera.fov_axis)]}};
}

toml::table table(const OrthographicCamera& camera) {
  return toml::table{{"type", "orthographic"}, {"size", camera.size}};
}

toml::table table(const importers::ImportedCamera& camera) {
  toml::table all = std::visit([](const auto& form) { return table(form); }, camera.form);
  all.insert("eye", list(camera.eye));
  all.insert("target", list(camera.target));
  all.insert("up", list(camera.up));
  return all;
}

toml::table table(const PointLight& light) {
  return toml::table{
      {"type", "point"}, {"intensity", list(light.intensity)}, {"position", list(light.position)}};
}

toml::table table(const DirectionalLight& light) {
  return toml::table{
      {"type", "directional"}, {"intensity", list(light.intensity)}, {"direction", list(-light.to_light)}};
}

toml::table table(const SpotLight& light) {
  return toml::table{{"type", "spot"},
                     {"intensity", list(light.intensity)},
                     {"position", list(light.position)},
                     {"direction", list(light.direction)},
                     {"inner_angle", glm::degrees(light.inner)},
                     {"outer_angle", std::min(glm::degrees(light.outer), 90.0)}};
}

// The two lights of a studio: a key light over the viewer's left shoulder, and a weak light from the right
// that gives the shadows form.
decltype(importers::ImportedScene::lights) studio_lights(const importers::ImportedCamera& camera) {
  const Vec3 back = unit(camera.eye - camera.target);
  const Vec3 right = unit(glm::cross(camera.up, back));
  const auto light = [&](double along_back, double along_right, double upward, double intensity) {
    return DirectionalLight{unit(along_back * back + along_right * right + upward * glm::cross(back, right)),
                            Vec3(intensity)};
  };
  return {light(0.75, -0.6, 0.8, 0.8), light(0.7, 1.0, 0.25, 0.28)};
}

// A floor, area lights and a sky around a model, in the directions of its camera. Lengths are in units of
// `radius`.
class Studio {
 public:
  static constexpr Vec3 background{0.30, 0.31, 0.33};

  Studio(const Bounds& model, const importers::ImportedCamera& camera)
      : model_(model), middle_(middle_of(model)), radius_(std::max(glm::length(model.max - middle_), 1e-9)) {
    const Vec3 back = camera.eye - camera.target;
    const Vec3 level(back.x, 0, back.z);
    back_ = unit(glm::length(level) > 0.01 * glm::length(back) ? level : Vec3(0, 0, 1));
    right_ = glm::cross(Vec3(0, 1, 0), back_);
  }

  // A soft key light over the viewer's left shoulder, a wide weak one from the right, and one from behind
  // that draws the outline.
  toml::array area_lights() const {
    return toml::array{area_light({-1.0, 1.1, 0.8}, 3.5, {2.6, 2.6}, {4.4, 4.25, 4.0}),
                       area_light({1.3, 0.4, 0.7}, 4, {3, 2.2}, {0.6, 0.64, 0.7}),
                       area_light({0.7, 1.6, -1.1}, 4, {2.4, 1.4}, {6, 6, 6.2})};
  }

  // A disk below the model that fades into the background, and does not touch a floor that the model has.
  toml::table floor() const {
    return toml::table{{"center", list({middle_.x, model_.min.y - 1e-4 * radius_, middle_.z})},
                       {"normal", list({0, 1, 0})},
                       {"radius", 9 * radius_},
                       {"material", "studio floor"}};
  }

  // The floor may blend with anything behind it as it fades. Or it may emit the constant background in the
  // same measure, which looks the same and has no noise.
  enum class Fade { none, blends, emits };
  static toml::table floor_material(Fade fade) {
    const auto formula = [](const std::string& color) {
      return toml::table{
          {"formula",
           toml::table{
               {"code",
                fmt::format("vec3 color(vec2 uv) {{\n"
                            "  float there = 1.0 - smoothstep(0.17, 1.0, 2.0 * length(uv - vec2(0.5)));\n"
                            "  return {};\n"
                            "}}\n",
                            color)}}}};
    };
    toml::table material{{"name", "studio floor"}, {"type", "diffuse"}, {"color", 0.5}};
    if (fade == Fade::blends) {
      material.insert("alpha", formula("vec3(there)"));
      material.insert("alpha_mode", "blend");
    } else if (fade == Fade::emits) {
      material.insert_or_assign("color", formula("vec3(0.5 * there)"));
      material.insert("emission", formula(fmt::format("vec3({}, {}, {}) * (1.0 - there)", background.x,
                                                      background.y, background.z)));
      material.insert("emission_sampled", false);
    }
    return material;
  }

  // The sun over the viewer's left shoulder.
  toml::table sky() const { return toml::table{{"type", "sky"}, {"sun", list(world({-0.8, 0.9, 0.5}))}}; }

 private:
  // Directions to the right, up, and towards the viewer.
  Vec3 world(const Vec3& d) const { return d.x * right_ + Vec3(0, d.y, 0) + d.z * back_; }

  // A rectangle that faces the model.
  toml::table area_light(const Vec3& direction, double distance, const Vec2& size,
                         const Vec3& radiance) const {
    const Vec3 out = unit(world(direction));
    const Vec3 across = radius_ * size.x * unit(glm::cross(Vec3(0, 1, 0), out));
    const Vec3 upward = radius_ * size.y * unit(glm::cross(out, across));
    return toml::table{{"type", "area"},
                       {"shape", "rectangle"},
                       {"origin", list(middle_ + radius_ * distance * out - (across + upward) / 2.0)},
                       {"edge_u", list(upward)},
                       {"edge_v", list(across)},
                       {"intensity", list(radiance)}};
  }

  Bounds model_;
  Vec3 middle_;
  double radius_;
  Vec3 back_, right_;
};

}  // namespace

bool has_room_for_studio(const importers::ImportedScene& framed) {
  constexpr double farthest = 1e10;
  const Bounds box = bounds_of(framed);
  const Vec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
  return std::max({reach.x, reach.y, reach.z}) <= farthest;
}

toml::table mesh_scene(const std::filesystem::path& file, const importers::ImportedScene& import,
                       const importers::ImportedScene& framed, const MeshView& view) {
  const auto [around, usual_paths, look, formulas, transparent, turntable, reading] = view;
  const importers::ImportedCamera camera =
      import.cameras.empty() ? framing(framed, turntable > 0) : import.cameras.front();
  const bool own_lights = import.lights.empty() && !around;
  toml::array lights;
  const bool in_two_lights = own_lights && look == MeshLook::plain;
  for (const auto& light : in_two_lights ? studio_lights(camera) : import.lights)
    lights.push_back(std::visit([](const auto& form) { return table(form); }, light));

  toml::table root;
  root.insert("camera", table(camera));
  toml::table mesh{{"file", file.filename().string()}};
  write_mesh_reading(reading, mesh);
  if (turntable > 0) {
    const Vec3 centre = middle_of(bounds_of(framed));
    mesh.insert("transform",
                toml::array{toml::table{{"translate", list(-centre)}},
                            toml::table{{"rotate", toml::table{{"axis", list({0, 1, 0})}, {"degrees", 0}}}},
                            toml::table{{"translate", list(centre)}}});
    root.insert("track", toml::array{toml::table{
                             {"target", "mesh.0.transform.1.rotate.degrees"},
                             {"keyframes", toml::array{toml::array{0, 0}, toml::array{turntable, 360}}},
                             {"curve", "linear"}}});
  }
  if (look == MeshLook::plain) {
    if (!around)
      root.insert("render", toml::table{{"background", toml::array{0.34, 0.41, 0.5}}, {"ambient", 0.14}});
  } else {
    const Studio studio(bounds_of(framed), camera);
    root.insert("image", toml::table{{"samples", 9}, {"exposure", "auto"}, {"tone", "neutral"}});
    const bool under_sky = own_lights && look == MeshLook::sky;
    toml::table render{{"integrator", "path"}, {"denoise", true}};
    if (!around && !under_sky) render.insert("background", list(Studio::background));
    root.insert("render", std::move(render));
    if (under_sky) root.insert("environment", studio.sky());
    if (own_lights && !under_sky) lights = studio.area_lights();
    toml::array materials;
    if (import.lights.empty() && !transparent) {
      const bool emits = usual_paths && !around && !under_sky;
      materials.push_back(Studio::floor_material(!formulas ? Studio::Fade::none
                                                 : emits   ? Studio::Fade::emits
                                                           : Studio::Fade::blends));
      root.insert("disk", toml::array{studio.floor()});
    }
    if (look == MeshLook::clay) {
      materials.push_back(
          toml::table{{"name", "clay"}, {"type", "diffuse"}, {"color", list({0.62, 0.52, 0.44})}});
      mesh.insert("material", "clay");
    }
    root.insert("material", std::move(materials));
  }
  root.insert("light", std::move(lights));
  root.insert("mesh", toml::array{std::move(mesh)});
  return root;
}

}  // namespace eyeray::engine::loader
