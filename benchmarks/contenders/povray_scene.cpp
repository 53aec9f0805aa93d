#include "benchmarks/contenders/povray_scene.hpp"

#include <fmt/format.h>

#include "benchmarks/contenders/append.hpp"
#include "host/core/error.hpp"

namespace eyeray::engine::contenders {
namespace {

std::string vector(const Vec3& v) {
  const Vec3 plain = v + 0.0;  // no −0
  return fmt::format("<{},{},{}>", plain.x, plain.y, plain.z);
}

std::string vector(const Vec2& v) {
  const Vec2 plain = v + 0.0;
  return fmt::format("<{},{}>", plain.x, plain.y);
}

double mean(const Vec3& v) {
  return (v.x + v.y + v.z) / 3;
}

// POV-Ray's rays go along direction + x·right + y·up with x, y in [−½, ½]. All three vectors are given, so
// POV-Ray uses our handedness.
std::string plane_camera(std::string_view word, const CameraFrame& frame) {
  return fmt::format("{} direction {} right {} up {}", word, vector(frame.forward), vector(2.0 * frame.right),
                     vector(2.0 * frame.up));
}

struct CameraText {
  const Scene& scene;
  Vec2 size;
  CameraFrame frame = camera_frame(scene.camera, size);
  CameraAxes axes = camera_axes(scene.camera);

  // POV-Ray's aperture is twice the lens' diameter, found by trial. Its lenses are circular.
  std::string operator()(const PerspectiveCamera& camera) const {
    std::string text = plane_camera("perspective", frame);
    if (camera.aperture.radius == 0) return text;
    if (camera.aperture.blades > 0) throw Error(ExitCode::bad_input, "POV-Ray's lenses have no blades");
    return text + fmt::format(" aperture {} focal_point {} blur_samples {} confidence 0 variance 0",
                              4 * camera.aperture.radius, vector(axes.eye + camera.aperture.focus * axes.w),
                              scene.image.samples);
  }
  std::string operator()(const OrthographicCamera&) const { return plane_camera("orthographic", frame); }
  // POV-Ray's fisheye is a circle that touches the picture's sides, whatever their lengths.
  std::string operator()(const FisheyeCamera& camera) const {
    if (size.x != size.y) throw Error(ExitCode::bad_input, "POV-Ray's fisheye is a circle in squares only");
    return around("fisheye", fmt::format("{}", camera.fov_degrees), 1, 1);
  }
  // POV-Ray turns the direction about the two other axes, in the sense of a left-handed system.
  std::string operator()(const PanoramaCamera& camera) const {
    const double degrees = camera.fov_degrees;
    return around("spherical", fmt::format("{} {}", degrees, degrees * size.y / size.x), -1, -1);
  }
  std::string operator()(const CylindricalCamera& camera) const {
    return around("cylinder 1", fmt::format("{}", camera.fov_degrees), 1, 2 * glm::length(frame.up));
  }
  std::string operator()(std::monostate) const {
    throw Error(ExitCode::bad_input, "the scene has a camera that is not written for POV-Ray");
  }

  // A camera that is defined by angles alone.
  std::string around(std::string_view word, const std::string& angle, double width, double height) const {
    return fmt::format("{} direction {} right {} up {} angle {}", word, vector(axes.w),
                       vector(width * axes.u), vector(height * axes.v), angle);
  }
};

std::string camera(const Scene& scene, int width, int height) {
  return fmt::format("camera {{ {} location {} }}\n",
                     std::visit(CameraText{scene, Vec2(width, height)}, scene.camera.projection->form()),
                     vector(scene.camera.eye));
}

std::string light_text(const DirectionalLight& light) {
  return fmt::format("light_source {{ {} color rgb {} parallel point_at 0 }}\n", vector(1e6 * light.to_light),
                     vector(light.intensity));
}

std::string light_text(const PointLight& light) {
  if (light.falloff == Falloff::none)
    return fmt::format("light_source {{ {} color rgb {} }}\n", vector(light.position),
                       vector(light.intensity));
  // POV-Ray's light fades by 2 / (1 + (r/d)²). If d is small compared with the scene, this is 2d² / r².
  constexpr double d = 1e-3;
  return fmt::format("light_source {{ {} color rgb {} fade_distance {} fade_power 2 }}\n",
                     vector(light.position), vector(light.intensity / (2 * d * d)), d);
}

std::string light_text(const SpotLight&) {
  throw Error(ExitCode::bad_input, "the scene has a spot light, which is not written for POV-Ray");
}

std::string light_text(std::monostate) {
  throw Error(ExitCode::bad_input, "the scene has a light that is not written for POV-Ray");
}

// With `radiosity`, the material gets no ambient light: radiosity replaces it.
std::string texture(const Material& material, const Vec3& ambient_light, bool radiosity) {
  if (material.mask)
    throw Error(ExitCode::bad_input, "material \"{}\" has cutouts, which are not written for POV-Ray",
                material.name);
  const Scattering s = material.scattering({.point = Vec2(0.0), .cos_view = 1, .ior_from = 1, .ior_to = 1});
  const std::string highlight =
      fmt::format("phong {} phong_size {}", mean(s.specular), std::max(1.0, s.shininess));
  if (material.medium())
    return fmt::format(
        "texture {{ pigment {{ rgbf 1 }} finish {{ ambient 0 diffuse 0 reflection {{ 0, 1 fresnel on }} "
        "conserve_energy {} }} }}",
        highlight);
  // POV-Ray multiplies the ambient share by the pigment too.
  const Vec3 pigment = glm::max(s.diffuse, Vec3(1e-6));
  if (radiosity)
    return fmt::format(
        "texture {{ pigment {{ rgb {} }} finish {{ diffuse 1 ambient 0 emission rgb {} reflection rgb {} }} "
        "}}",
        vector(pigment), vector(s.emitted / pigment), vector(s.reflected));
  return fmt::format(
      "texture {{ pigment {{ rgb {} }} finish {{ diffuse 1 ambient rgb {} {} reflection rgb {} }} }}",
      vector(pigment), vector((s.ambient * ambient_light + s.emitted) / pigment), highlight,
      vector(s.reflected));
}

// "texture { M3 }", and the interior of glass.
std::string look(const Scene& scene, int material) {
  const auto medium = scene.materials[size_t(material)]->medium();
  return fmt::format("texture {{M{}}}{}", material,
                     medium ? fmt::format(" interior {{ ior {} }}", medium->ior) : "");
}

std::string matrix(const Mat4& map) {
  std::string numbers;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) append(numbers, "{}{}", numbers.empty() ? "" : ",", map[column][row]);
  }
  return fmt::format("matrix <{}>", numbers);
}

std::string quadric(const QuadricForm& form) {
  const std::string surface = fmt::format("quadric {{{},{},{},{}", vector(form.square), vector(form.product),
                                          vector(form.linear), form.constant + 0.0);
  const std::string clip = fmt::format("box {{{},{}}}", vector(form.clip.min), vector(form.clip.max));
  return form.open ? fmt::format("{} clipped_by {{{}}}", surface, clip)
                   : fmt::format("intersection {{{}}} {}", surface, clip);
}

void add_shape(std::string& text, const Scene& scene, const Shape& shape);

// The points within any of the shapes or, with `all`, within all of them. A union would keep its inner
// surfaces, which are visible through glass.
void add_combination(std::string& text, const Scene& scene, const std::vector<const Shape*>& shapes,
                     bool all) {
  if (shapes.size() > 1) text += all ? "intersection {\n" : "merge {\n";
  for (const Shape* shape : shapes) add_shape(text, scene, *shape);
  if (shapes.size() > 1) text += "}\n";
}

// Each part has its own texture; the first part's fills the CSG object.
void add_csg_object(std::string& text, const Scene& scene, const CsgForm& csg) {
  if (!csg.removed.empty()) text += "difference {\n";
  add_combination(text, scene, csg.operands, csg.all);
  if (csg.removed.empty()) return;
  for (const Shape* shape : csg.removed) add_shape(text, scene, *shape);
  text += "}\n";
}

// The number of points, and the points. Each outline ends with its first point.
template <typename Point>
std::string closed(const std::vector<std::vector<Point>>& outlines) {
  size_t count = 0;
  std::string points;
  for (const auto& outline : outlines) {
    for (const Point& p : outline) append(points, ",{}", vector(p));
    append(points, ",{}", vector(outline[0]));
    count += outline.size() + 1;
  }
  return fmt::format("{}{}", count, points);
}

std::string control_points(const BezierForm& form) {
  std::string text;
  for (const Vec3& p : form.net) append(text, "{}{}", text.empty() ? "" : ",", vector(p));
  return text;
}

void add_shape(std::string& text, const Scene& scene, const Shape& shape) {
  const std::string material = look(scene, shape.material);
  const ShapeForm form = shape.form();
  if (const auto* sphere = std::get_if<SphereForm>(&form)) {
    append(text, "sphere {{{},{} {}}}\n", vector(sphere->center), sphere->radius, material);
  } else if (const auto* plane = std::get_if<PlaneForm>(&form)) {
    append(text, "plane {{{},{} {}}}\n", vector(plane->normal), glm::dot(plane->normal, plane->point),
           material);
  } else if (const auto* triangle = std::get_if<TriangleForm>(&form)) {
    const auto& [a, b, c] = triangle->vertices;
    append(text, "triangle {{{},{},{} {}}}\n", vector(a), vector(b), vector(c), material);
  } else if (const auto* box = std::get_if<BoxForm>(&form)) {
    append(text, "box {{-1,1 {} {}}}\n", matrix(box->to_world), material);
  } else if (const auto* disk = std::get_if<DiskForm>(&form)) {
    append(text, "disc {{0,y,1,{} {} {}}}\n", disk->inner, matrix(disk->to_world), material);
  } else if (const auto* capsule = std::get_if<CapsuleForm>(&form)) {
    if (capsule->low == capsule->high)
      append(text, "merge {{cylinder {{-y*{0},y*{0},1}} sphere {{-y*{0},1}} sphere {{y*{0},1}} {1} {2}}}\n",
             capsule->half, matrix(capsule->to_world), material);
    else
      append(text, "sphere_sweep {{linear_spline 2,-y*{0},{1},y*{0},{2} {3} {4}}}\n", capsule->half,
             capsule->low, capsule->high, matrix(capsule->to_world), material);
  } else if (const auto* shape_quadric = std::get_if<QuadricForm>(&form)) {
    append(text, "{} {} {}}}\n", quadric(*shape_quadric), matrix(shape_quadric->to_world), material);
  } else if (const auto* torus = std::get_if<TorusForm>(&form)) {
    append(text, "torus {{1,{} {} {}}}\n", torus->minor, matrix(torus->to_world), material);
  } else if (const auto* superellipsoid = std::get_if<SuperellipsoidForm>(&form)) {
    // POV-Ray's superellipsoid stands along z.
    append(text, "superellipsoid {{<{},{}> matrix <1,0,0,0,0,1,0,1,0,0,0,0> {} {}}}\n", superellipsoid->e,
           superellipsoid->n, matrix(superellipsoid->to_world), material);
  } else if (const auto* polygon = std::get_if<PolygonForm>(&form)) {
    append(text, "polygon {{{} {}}}\n", closed(polygon->outlines), material);
  } else if (const auto* prism = std::get_if<ExtrusionForm>(&form)) {
    append(text, "prism {{linear_sweep linear_spline -1,1,{} {} {}}}\n", closed(prism->outlines),
           matrix(prism->to_world), material);
  } else if (const auto* csg = std::get_if<CsgForm>(&form)) {
    add_csg_object(text, scene, *csg);
  } else if (const auto* bezier = std::get_if<BezierForm>(&form)) {
    // POV-Ray cuts the patch into triangles: into 2·4⁵ where it is not flat enough.
    append(text, "bicubic_patch {{type 1 flatness 1e-4 u_steps 5 v_steps 5 {} {}}}\n",
           control_points(*bezier), material);
  } else {
    throw Error(ExitCode::bad_input, "{}:{}: POV-Ray has no such shape", shape.position.file,
                shape.position.line);
  }
}

void add_instance(std::string& text, const Scene& scene, const Instance& instance) {
  append(text, "object {{ Mesh{} {} {} }}\n", instance.mesh, matrix(instance.transform),
         look(scene, instance.material));
}

void add_group(std::string& text, const Scene& scene, const Group& group, size_t index) {
  append(text, "#declare Group{} = union {{\n", index);
  for (const auto& shape : group.shapes) add_shape(text, scene, *shape);
  for (const Instance& instance : group.instances) add_instance(text, scene, instance);
  text += "}\n";
}

void add_vectors(std::string& text, const char* name, const std::vector<Vec3>& vectors) {
  append(text, "{} {{{},\n", name, vectors.size());
  for (const Vec3& v : vectors) append(text, "{},\n", vector(v));
  text += "}\n";
}

void add_mesh(std::string& text, const Mesh& mesh, size_t index) {
  append(text, "#declare Mesh{} = mesh2 {{\n", index);
  add_vectors(text, "vertex_vectors", mesh.positions);
  if (!mesh.normals.empty()) add_vectors(text, "normal_vectors", mesh.normals);
  append(text, "face_indices {{{},\n", mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) append(text, "<{},{},{}>,\n", a, b, c);
  text += "}\n}\n";
}

std::string written(const Scene& scene, int width, int height, bool radiosity) {
  std::string text = fmt::format(
      "#version 3.7;\n"
      "global_settings {{ assumed_gamma 1 max_trace_level {} adc_bailout {} ambient_light rgb 1 }}\n"
      "background {{ rgb {} }}\n",
      scene.render.max_depth + 1, scene.render.min_throughput, vector(scene.render.background));
  if (radiosity)
    text +=
        "global_settings { radiosity { count 400 recursion_limit 4 error_bound 0.3 nearest_count 10 "
        "pretrace_start 0.08 pretrace_end 0.01 brightness 1 normal off } }\n";
  text += camera(scene, width, height);
  for (const auto& light : scene.lights)
    text += std::visit([](const auto& form) { return light_text(form); }, light->form());
  for (size_t i = 0; i < scene.materials.size(); ++i)
    append(text, "#declare M{} = {}\n", i, texture(*scene.materials[i], scene.render.ambient, radiosity));
  for (const auto& shape : scene.shapes) add_shape(text, scene, *shape);
  for (size_t i = 0; i < scene.meshes.size(); ++i) add_mesh(text, scene.meshes[i], i);
  for (const Instance& instance : scene.instances) add_instance(text, scene, instance);
  for (size_t i = 0; i < scene.groups.size(); ++i) add_group(text, scene, scene.groups[i], i);
  for (const GroupInstance& instance : scene.group_instances)
    append(text, "object {{ Group{} {} }}\n", instance.group, matrix(instance.transform));
  return text;
}

}  // namespace

std::string povray_scene(const Scene& scene, int width, int height) {
  return written(scene, width, height, false);
}

std::string povray_radiosity(const Scene& scene, int width, int height) {
  if (scene.environment)
    throw Error(ExitCode::bad_input, "the scene has an environment, which is not written for POV-Ray");
  return written(scene, width, height, true);
}

}  // namespace eyeray::engine::contenders
