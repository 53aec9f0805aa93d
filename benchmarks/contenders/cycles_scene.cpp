#include "benchmarks/contenders/cycles_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <span>

#include "benchmarks/contenders/append.hpp"
#include "host/core/embedded_file.hpp"
#include "host/core/error.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/environment.hpp"

namespace eyeray::engine::contenders {

std::span<const EmbeddedFile> script_files();  // cycles.py

namespace {

// The size of the square that stands for an endless plane, relative to the scene's size.
constexpr double plane_size = 100;

std::string tuple(const Vec3& v) {
  const Vec3 plain = v + 0.0;  // no −0
  return fmt::format("({}, {}, {})", plain.x, plain.y, plain.z);
}

std::string tuple(const Mat4& map) {
  std::string rows;
  for (int row = 0; row < 4; ++row)
    append(rows, "({}, {}, {}, {}), ", map[0][row] + 0.0, map[1][row] + 0.0, map[2][row] + 0.0,
           map[3][row] + 0.0);
  return "(" + rows + ")";
}

Mat4 columns(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin) {
  return {Vec4(x, 0), Vec4(y, 0), Vec4(z, 0), Vec4(origin, 1)};
}

// A map to axes at `origin`, of which the third is `w`.
Mat4 standing_on(const Vec3& w, const Vec3& origin) {
  const Vec3 aside = std::abs(w.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 u = glm::normalize(glm::cross(aside, w));
  return columns(u, glm::cross(w, u), w, origin);
}

std::string numbers(const std::vector<Vec3>& vectors) {
  std::string text = "numbers(\"\"\"\n";
  for (const Vec3& v : vectors) append(text, "{} {} {}\n", v.x + 0.0, v.y + 0.0, v.z + 0.0);
  return text + "\"\"\", 3)";
}

std::string triangles(const std::vector<std::array<uint32_t, 3>>& corners) {
  std::string text = "corners(\"\"\"\n";
  for (const auto& [a, b, c] : corners) append(text, "{} {} {}\n", a, b, c);
  return text + "\"\"\")";
}

// The material's BSDF. It must be the same at every point and from every direction: Blender gets one colour.
Bsdf only_bsdf(const Material& material) {
  const auto fail = [&](const char* what) {
    throw Error(ExitCode::bad_input, "material \"{}\" {}, which is not written for Blender", material.name,
                what);
  };
  if (material.mask) fail("has cutouts");
  if (material.normal_map || material.bump_map || material.coat_normal_map) fail("is bumpy");
  std::optional<Bsdf> first;
  for (int i = 0; i < 64; ++i) {
    const double x = 0.754877666 * i, y = 0.569840291 * i;  // spread over all points
    const ScatteringContext context{
        .point = {8.0 * Vec2(x - std::floor(x), y - std::floor(y)), Vec3(x, -y, y - x)},
        .cos_view = 1 - i / 128.0,
        .ior_from = 1,
        .ior_to = 1};
    const Bsdf bsdf = material.bsdf(context, material.scattering(context));
    if (bsdf.diffuse_roughness > 0 || bsdf.coat > 0 || bsdf.glass != Vec3(0)) fail("is rough or coated");
    if (bsdf.sheen != Vec3(0) || bsdf.thin != Vec3(0) || material.thin()) fail("has sheen, or is a pane");
    if (bsdf.metallic > 0 || bsdf.layer.f0 != Vec3(0) || bsdf.layer.f90 != Vec3(0)) fail("has highlights");
    if (!first) first = bsdf;
    if (bsdf.diffuse != first->diffuse || bsdf.mirror != first->mirror) fail("varies");
  }
  return *first;
}

std::string parts_of(const Material& material) {
  if (const std::optional<Medium> medium = material.medium()) {
    if (medium->absorption != Vec3(0) || medium->scattering != Vec3(0))
      throw Error(ExitCode::bad_input, "material \"{}\" dims light, which is not written for Blender",
                  material.name);
    only_bsdf(material);
    return fmt::format(", (\"BsdfGlass\", (1, 1, 1), {{\"IOR\": {}}})", medium->ior);
  }
  const Bsdf bsdf = only_bsdf(material);
  std::string text;
  if (bsdf.diffuse != Vec3(0)) append(text, ", (\"BsdfDiffuse\", {}, {{}})", tuple(bsdf.diffuse));
  if (bsdf.mirror != Vec3(0)) append(text, ", (\"BsdfGlossy\", {}, {{}})", tuple(bsdf.mirror));
  if (!material.emits()) return text;
  const std::optional<Vec3> emission = material.constant_emission();
  if (!emission || material.emits_in_front)
    throw Error(ExitCode::bad_input,
                "material \"{}\" emits a texture, or to one side, which is not written for Blender",
                material.name);
  return text + fmt::format(", (\"Emission\", {}, {{\"Strength\": 1}})", tuple(*emission));
}

// Half the diagonal of a box around the eye, the target and everything that has finite bounds.
double reach(const Scene& scene) {
  Bounds all;
  all.include(scene.camera.eye);
  all.include(scene.camera.target);
  for (const auto& shape : scene.shapes) {
    const Bounds box = shape->bounds();
    if (!std::isfinite(glm::length(box.max - box.min))) continue;
    all.include(box.min);
    all.include(box.max);
  }
  for (const Instance& instance : scene.instances) {
    const Affine map(instance.transform);
    for (const Vec3& position : scene.meshes[size_t(instance.mesh)].positions)
      all.include(map.point(position));
  }
  return glm::length(all.max - all.min) / 2;
}

class Writer {
 public:
  Writer(const Scene& scene, int width, int height) : scene_(scene), size_(width, height) {}

  std::string write() {
    settings();
    camera();
    for (size_t i = 0; i < scene_.materials.size(); ++i)
      if (uses(int(i))) append(text_, "m{} = material(\"{}\"{})\n", i, i, parts_of(*scene_.materials[i]));
    for (const auto& light : scene_.lights)
      std::visit([this](const auto& form) { add_light(form); }, light->form());
    for (const auto& shape : scene_.shapes) add_shape(*shape);
    for (size_t i = 0; i < scene_.meshes.size(); ++i) add_mesh(scene_.meshes[i], i);
    for (const Instance& instance : scene_.instances)
      append(text_, "add(mesh{}, m{}, {})\n", instance.mesh, instance.material, tuple(instance.transform));
    if (scene_.medium.scattering != Vec3(0) || scene_.medium.absorption != Vec3(0))
      throw Error(ExitCode::bad_input, "the scene has a medium around it, which is not written for Blender");
    if (!scene_.group_instances.empty())
      throw Error(ExitCode::bad_input, "the scene has instanced groups, which are not written for Blender");
    return text_.append(render);
  }

 private:
  static constexpr std::string_view render = R"(
processor, wall = time.process_time(), time.time()
bpy.ops.render.render(write_still=True)
print("eyeray: cpu", time.process_time() - processor, "wall", time.time() - wall)
)";

  bool uses(int material) const {
    for (const auto& shape : scene_.shapes)
      if (shape->material == material) return true;
    for (const Instance& instance : scene_.instances)
      if (instance.material == material) return true;
    return false;
  }

  void settings() {
    append(text_, "scene.render.resolution_x, scene.render.resolution_y = {}, {}\n", size_.x, size_.y);
    append(
        text_,
        "cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = "
        "{}\n",
        scene_.render.max_depth);
    if (scene_.environment)
      append(text_, "surroundings((0, 0, 0), {})\n", scene_.environment->turn());
    else
      append(text_, "surroundings({})\n", tuple(scene_.render.background));
  }

  void camera() {
    const CameraAxes axes = camera_axes(scene_.camera);
    const std::string matrix = tuple(columns(axes.u, axes.v, -axes.w, axes.eye));
    const CameraFrame frame = camera_frame(scene_.camera, size_);
    const CameraForm form = scene_.camera.projection->form();
    const auto* perspective = std::get_if<PerspectiveCamera>(&form);
    if (perspective && perspective->aperture.radius == 0) {
      const double angle = 2 * std::atan(glm::length(frame.right) / glm::length(frame.forward));
      append(text_, "camera(\"PERSP\", {}, {})\n", angle, matrix);
    } else if (std::holds_alternative<OrthographicCamera>(form)) {
      append(text_, "camera(\"ORTHO\", {}, {})\n", 2 * glm::length(frame.right), matrix);
    } else {
      throw Error(ExitCode::bad_input, "the scene has a camera that is not written for Blender");
    }
  }

  // The meaning of Blender's watts was found by trial.
  void add_light(const DirectionalLight& light) {
    append(text_, "light(\"SUN\", {}, {}, {}, {})\n", std::numbers::pi, tuple(light.intensity),
           tuple(standing_on(light.to_light, Vec3(0))), light.angle);
  }
  void add_light(const PointLight& light) {
    if (light.falloff != Falloff::inverse_square) unknown_light();
    append(text_, "light(\"POINT\", {}, {}, {})\n", 4 * std::numbers::pi * std::numbers::pi,
           tuple(light.intensity), tuple(columns({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, light.position)));
  }
  void add_light(const SpotLight&) { unknown_light(); }
  void add_light(std::monostate) { unknown_light(); }
  [[noreturn]] static void unknown_light() {
    throw Error(ExitCode::bad_input, "the scene has a light that is not written for Blender");
  }

  void add(const std::string& mesh, const Shape& shape, const Mat4& map) {
    append(text_, "add({}, m{}, {})\n", mesh, shape.material, tuple(map));
  }
  // Adds a polygon whose corners are in world space.
  void add_polygon(const Shape& shape, const std::vector<Vec3>& corners) {
    std::string order;
    for (size_t i = 0; i < corners.size(); ++i) append(order, "{}, ", i);
    append(text_, "add(mesh({}, [({})]), m{})\n", numbers(corners), order, shape.material);
  }
  // The name of a mesh that several shapes share; the mesh is made on first use.
  std::string shared(const std::string& name, const std::string& made) {
    if (text_.find("\n" + name + " = ") == std::string::npos) append(text_, "{} = {}\n", name, made);
    return name;
  }

  void add_shape(const Shape& shape) {
    const ShapeForm form = shape.form();
    if (const auto* sphere = std::get_if<SphereForm>(&form)) {
      const double r = sphere->radius;
      add(shared("ball", "sphere()"), shape, columns({r, 0, 0}, {0, r, 0}, {0, 0, r}, sphere->center));
    } else if (const auto* plane = std::get_if<PlaneForm>(&form)) {
      const double half = plane_size * reach(scene_);
      const Mat4 axes = standing_on(plane->normal, plane->point);
      std::vector<Vec3> corners;
      for (const Vec2& at : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
        corners.emplace_back(axes * Vec4(at * half, 0, 1));
      add_polygon(shape, corners);
    } else if (const auto* triangle = std::get_if<TriangleForm>(&form)) {
      add_polygon(shape, {triangle->vertices.begin(), triangle->vertices.end()});
    } else if (const auto* polygon = std::get_if<PolygonForm>(&form);
               polygon && polygon->outlines.size() == 1) {
      add_polygon(shape, polygon->outlines[0]);
    } else if (const auto* box = std::get_if<BoxForm>(&form)) {
      add(shared("cube", "box()"), shape, box->to_world);
    } else if (const auto* disk = std::get_if<DiskForm>(&form)) {
      add(fmt::format("disk({})", disk->inner), shape, disk->to_world);
    } else if (const auto* torus = std::get_if<TorusForm>(&form)) {
      add(fmt::format("torus({})", torus->minor), shape, torus->to_world);
    } else {
      throw Error(ExitCode::bad_input, "{}:{}: a shape that is not written for Blender", shape.position.file,
                  shape.position.line);
    }
  }

  void add_mesh(const Mesh& mesh, size_t index) {
    if (!mesh.colors.empty())
      throw Error(ExitCode::bad_input, "{}: vertices have colours, which are not written for Blender",
                  mesh.name);
    append(text_, "mesh{} = mesh({},\n{}", index, numbers(mesh.positions), triangles(mesh.triangles));
    if (!mesh.normals.empty()) append(text_, ", True,\n{}", numbers(mesh.normals));
    text_ += ")\n";
  }

  const Scene& scene_;
  const Vec2 size_;
  std::string text_;
};

}  // namespace

std::string cycles_scene(const Scene& scene, int width, int height) {
  return std::string(script_files()[0].text) + Writer(scene, width, height).write();
}

std::optional<image::Image> cycles_environment(const Scene& scene) {
  if (!scene.environment) return std::nullopt;
  const EnvironmentMap& map = *scene.environment;
  image::Image picture(map.width(), map.height(), 3);
  for (int row = 0; row < map.height(); ++row)
    for (int column = 0; column < map.width(); ++column)
      for (int c = 0; c < 3; ++c) picture.pixel(column, row)[c] = float(map.texel(column, row)[c]);
  return picture;
}

}  // namespace eyeray::engine::contenders
