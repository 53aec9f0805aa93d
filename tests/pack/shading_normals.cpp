// Shading normals under maps that stretch: however an object gets its map, normals are interpolated in its
// own space and then mapped. This test computes the expected normals itself.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <glm/ext/matrix_transform.hpp>
#include <span>

#include "host/loader/scene_file.hpp"
#include "host/pack/pack.hpp"
#include "host/reference/tracer.hpp"
#include "host/scene/affine.hpp"
#include "host/twin/shader_functions.hpp"
#include "host/twin/twin.hpp"
#include "tests/support/process.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::records;
using namespace eyeray::engine::test;

namespace {

// A turn about the axis v; if `degrees` is 0, a stretch by v along the axes.
struct Step {
  Vec3 v;
  double degrees = 0;

  Mat4 map() const {
    return degrees == 0 ? glm::scale(Mat4(1), v)
                        : glm::rotate(Mat4(1), glm::radians(degrees), glm::normalize(v));
  }
};
using Steps = std::vector<Step>;

struct Case {
  std::string name;
  Steps inner, outer;  // the outer steps are applied after the inner ones

  Mat4 map() const {
    Mat4 all(1);
    for (const Steps* steps : {&inner, &outer})
      for (const Step& step : *steps) all = step.map() * all;
    return all;
  }
};

const Case cases[] = {
    {"alike along all axes", {{Vec3(0.7)}}, {{{1, 2, 3}, 40}}},
    {"stretched", {{{1, 1, 2}}}, {{{1, 2, 3}, 40}}},
    {"sheared", {{{1, 0.4, 1.5}}, {{3, 1, -1}, 50}}, {{{2, 1, 0.3}}, {{0, 1, 2}, 80}}},
    {"mirrored and sheared", {{{-1, 1, 2}}, {{1, 0, 1}, 35}}, {{{0.5, 1, 3}}}},
    {"stretched much", {{{1, 1, 1e-3}}}, {{{1, 1, 0}, 30}}},
    {"stretched, and undone", {{{0, 1, 0}, 50}, {{1, 1, 8}}}, {{{1, 1, 0.125}}, {{0, 1, 0}, -50}}},
};

// Two triangles whose normals differ much from corner to corner.
constexpr int corners[2][3] = {{0, 1, 2}, {0, 2, 3}};
const Vec3 positions[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0.5}, {-1, 1, 0}};
const Vec3 normals[] = {{-2, -0.5, 0.75}, {1.5, -0.25, 1}, {0.5, 0.5, 0.5}, {-2.25, 1, 1}};

std::string vector(const Vec3& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x, v.y, v.z);
}

std::string steps_text(std::initializer_list<const Steps*> all) {
  std::string text;
  for (const Steps* steps : all)
    for (const Step& step : *steps)
      text += step.degrees == 0 ? fmt::format("{{ scale = {} }}, ", vector(step.v))
                                : fmt::format("{{ rotate = {{ axis = {}, degrees = {} }} }}, ",
                                              vector(step.v), step.degrees);
  return text;
}

void write_ply(const std::string& file) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nelement face 2\nproperty list uchar int "
      "vertex_indices\n"
      "end_header\n";
  for (int i = 0; i < 4; ++i)
    text += fmt::format("{} {} {} {} {} {}\n", positions[i].x, positions[i].y, positions[i].z, normals[i].x,
                        normals[i].y, normals[i].z);
  for (const auto& [a, b, c] : corners) text += fmt::format("3 {} {} {}\n", a, b, c);
  write_text(file, text);
}

// Writes a file with a node for each step. Each node holds the node of the step before; the first shows the
// triangles.
void write_gltf(const std::string& file, const std::string& data, const Steps& steps) {
  std::string bytes;
  const auto add = [&](float x) { bytes.append(reinterpret_cast<const char*>(&x), sizeof x); };
  for (const auto& list : {std::span(positions), std::span(normals)})
    for (const auto& triangle : corners)
      for (const int corner : triangle)
        for (int i = 0; i < 3; ++i) add(float(list[size_t(corner)][i]));
  write_text(data, bytes);
  std::string nodes = "{\"mesh\":0}";
  for (size_t i = 0; i < steps.size(); ++i) {
    const Vec3 half = glm::normalize(steps[i].v) * std::sin(glm::radians(steps[i].degrees / 2));
    nodes += fmt::format(",{{\"children\":[{}],", i);
    nodes += steps[i].degrees == 0
                 ? fmt::format("\"scale\":{}}}", vector(steps[i].v))
                 : fmt::format("\"rotation\":[{:.17g},{:.17g},{:.17g},{:.17g}]}}", half.x, half.y, half.z,
                               std::cos(glm::radians(steps[i].degrees / 2)));
  }
  write_text(file,
             fmt::format(R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{}]}}],"nodes":[{}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1}}}}]}}],
"buffers":[{{"uri":"roof.bin","byteLength":144}}],
"bufferViews":[{{"buffer":0,"byteLength":72}},{{"buffer":0,"byteOffset":72,"byteLength":72}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0.5]}},
{{"bufferView":1,"componentType":5126,"count":6,"type":"VEC3"}}]}})",
                         steps.size(), nodes));
}

std::string triangles(const std::string& table) {
  const auto list = [](std::span<const Vec3> of) {
    std::vector<std::string> texts;
    for (const auto& [a, b, c] : corners)
      texts.push_back(
          fmt::format("[{}, {}, {}]", vector(of[size_t(a)]), vector(of[size_t(b)]), vector(of[size_t(c)])));
    return fmt::format("[{}]", fmt::join(texts, ", "));
  };
  return fmt::format("[[{}]]\nmaterial = \"wall\"\nbatch = {{ vertices = {}, normals = {} }}\n", table,
                     list(positions), list(normals));
}

std::string mesh(const std::string& table, const char* file) {
  return fmt::format("[[{}]]\nfile = \"{}\"\nmaterial = \"wall\"\n", table, file);
}

// A batch that shows the object twice, the second time far away.
std::string twice(const std::string& steps) {
  return fmt::format("batch = {{ transform = [[{0}], [{0} {{ translate = [900, 0, 0] }}]] }}\n", steps);
}

// All ways to put the triangles under the case's map: names and scenes. roof.gltf contains the inner steps,
// whole.gltf all steps.
std::vector<std::pair<std::string, std::string>> ways_to_stand(const Case& of) {
  const std::string inner = steps_text({&of.inner}), outer = steps_text({&of.outer});
  const std::string all = inner + outer;
  std::vector<std::pair<std::string, std::string>> ways = {
      {"mesh, once", mesh("mesh", "roof.ply") + "transform = [" + all + "]\n"},
      {"mesh, twice", mesh("mesh", "roof.ply") + twice(all)},
      {"glTF, once", mesh("mesh", "whole.gltf")},
      {"glTF, twice", mesh("mesh", "roof.gltf") + twice(outer)},
      {"triangles", triangles("triangle") + "transform = [" + all + "]\n"},
  };
  for (const char* groups : {"flat", "instanced"}) {
    const std::string group = fmt::format("[render]\ngroups = \"{}\"\n[[group]]\n", groups) + twice(outer);
    const std::string own = "transform = [" + inner + "]\n";
    ways.emplace_back(fmt::format("mesh in a group, {}", groups),
                      group + mesh("group.mesh", "roof.ply") + own);
    ways.emplace_back(fmt::format("glTF in a group, {}", groups), group + mesh("group.mesh", "roof.gltf"));
    ways.emplace_back(fmt::format("triangles in a group, {}", groups),
                      group + triangles("group.triangle") + own);
    ways.emplace_back(fmt::format("triangles in a group in a group, {}", groups),
                      group + "[[group.group]]\n" + own + triangles("group.group.triangle"));
  }
  return ways;
}

// The shading normal where the ray hits the triangles under the map: Σ weight · normal, mapped; or the
// triangle's own normal, if that sum is on the other side. Nothing if rounding decides.
std::optional<Vec3> expected_normal(const Mat4& map, const Ray& ray) {
  const Mat3 linear(map), cotangent = glm::transpose(glm::inverse(linear));
  std::optional<Vec3> nearest;
  double nearest_t = HUGE_VAL;
  for (const auto& [a, b, c] : corners) {
    const Vec3 p = linear * positions[a];
    const Mat3 edges(linear * positions[b] - p, linear * positions[c] - p, -ray.d);
    const Vec3 uvt = glm::inverse(edges) * (ray.o - p);
    const Vec3 weights(1 - uvt.x - uvt.y, uvt.x, uvt.y);
    const double inside = std::min({weights.x, weights.y, weights.z});
    if (inside > -1e-3 && inside < 1e-3) return std::nullopt;
    if (inside < 0 || uvt.z > nearest_t) continue;
    nearest_t = uvt.z;
    const Vec3 own = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
    const Vec3 outward = glm::normalize(cotangent * own);
    const Vec3 shading = glm::normalize(cotangent * (weights.x * glm::normalize(normals[a]) +
                                                     weights.y * glm::normalize(normals[b]) +
                                                     weights.z * glm::normalize(normals[c])));
    const double cosine = glm::dot(outward, shading);
    if (std::abs(cosine) < 1e-3 || std::abs(glm::dot(ray.d, outward)) < 0.1) return std::nullopt;
    nearest = cosine > 0 ? shading : outward;
  }
  return nearest;
}

Vec3 reference_normal(const reference::Tracer& tracer, const Ray& ray) {
  const auto hit = tracer.trace(ray);
  return hit ? tracer.surface(ray, *hit).normal : Vec3(0);
}

Vec3 by_twin(const Scene& scene, const Ray& world) {
  const shader::Ray ray = shader::make_ray(glm::vec3(world.o - scene.camera.eye), glm::vec3(world.d));
  uint32_t flags = 0;
  const shader::Hit hit = shader::trace(ray, flags);
  return hit.slot == NONE ? Vec3(0) : Vec3(shader::surface_at(shader::primitive_at(hit), ray, hit).normal);
}

}  // namespace

TEST_CASE("vertex normals are interpolated in object space, however the object is placed in the world") {
  const TemporaryFolder folder;
  write_ply(folder / "roof.ply");
  for (const Case& of : cases) {
    Steps all = of.inner;
    all.insert(all.end(), of.outer.begin(), of.outer.end());
    write_gltf(folder / "roof.gltf", folder / "roof.bin", of.inner);
    write_gltf(folder / "whole.gltf", folder / "roof.bin", all);
    const Mat4 map = of.map();
    for (const auto& way : ways_to_stand(of)) {
      CAPTURE(of.name);
      CAPTURE(way.first);
      write_text(folder / "scene.toml", "[[material]]\nname = \"wall\"\ntype = \"phong\"\n" + way.second);
      const Scene scene = load_scene(folder / "scene.toml");
      const reference::Tracer tracer(scene);
      const PackedScene packed = pack::pack(scene);
      const shader::Binding binding(twin::view_of(packed));
      Random random(7);
      int compared = 0;
      double worst = 0, worst_twin = 0;
      while (compared < 200) {
        const double u = random.uniform(-1, 1), v = random.uniform(-1, 1);
        const Vec3 target = Mat3(map) * Vec3(u, v, 0.2);
        Ray ray{target + random.direction() * 5.0, {}};
        ray.d = glm::normalize(target - ray.o);
        const auto expected = expected_normal(map, ray);
        if (!expected) continue;
        ++compared;
        worst = std::max(worst, magnitude(reference_normal(tracer, ray) - *expected));
        worst_twin = std::max(worst_twin, magnitude(by_twin(scene, ray) - *expected));
      }
      CHECK(worst < 1e-9);
      CHECK(worst_twin < 1e-3);
    }
  }
}

TEST_CASE(
    "normals of stretched CSG objects follow the gradient, however the objects are placed in the world") {
  // A ball less a smaller ball; the equations of both give the expected normals.
  const auto csg = [](const std::string& table) {
    return fmt::format(
        "[[{0}]]\nmaterial = \"wall\"\n[[{0}.sphere]]\ncenter = [0, 0, 0]\nradius = 1\n"
        "[[{0}.minus.sphere]]\ncenter = [0, 0, 1]\nradius = 0.75\n",
        table);
  };
  for (const Case& of : cases) {
    if (of.name == "stretched much") continue;
    const Affine map(of.map());
    const std::string all = steps_text({&of.inner, &of.outer}), inner = steps_text({&of.inner});
    std::vector<std::string> ways = {csg("csg"), csg("csg")};
    ways[0].insert(ways[0].find('\n') + 1, "transform = [" + all + "]\n");
    ways[1].insert(ways[1].find('\n') + 1, twice(all));
    for (const char* groups : {"flat", "instanced"}) {
      std::string part = csg("group.csg");
      part.insert(part.find('\n') + 1, "transform = [" + inner + "]\n");
      ways.push_back(fmt::format("[render]\ngroups = \"{}\"\n[[group]]\n{}{}", groups,
                                 twice(steps_text({&of.outer})), part));
    }
    for (const std::string& way : ways) {
      CAPTURE(of.name);
      CAPTURE(way);
      const Scene scene =
          parse_scene("[[material]]\nname = \"wall\"\ntype = \"phong\"\n" + way, "scene.toml");
      const reference::Tracer tracer(scene);
      const PackedScene packed = pack::pack(scene);
      const shader::Binding binding(twin::view_of(packed));
      Random random(8);
      int outer = 0, hollow = 0;
      while (outer + hollow < 200) {
        const Vec3 target = map.linear * random.point(1);
        Ray ray{target + random.direction() * 9.0, {}};
        ray.d = glm::normalize(target - ray.o);
        const auto hit = tracer.trace(ray);
        if (!hit) continue;
        const SurfacePoint point = tracer.surface(ray, *hit);
        const Vec3 local = glm::inverse(map.linear) * point.position;
        const Vec3 from_hole = local - Vec3(0, 0, 1);
        const double off_ball = std::abs(glm::length(local) - 1),
                     off_hole = std::abs(glm::length(from_hole) - 0.75);
        REQUIRE(std::min(off_ball, off_hole) < 1e-9);
        if (std::max(off_ball, off_hole) < 1e-3 || std::abs(glm::dot(ray.d, point.normal)) < 0.1) continue;
        const bool on_ball = off_ball < off_hole;
        const Vec3 expected = map.normal(on_ball ? local : -from_hole);
        ++(on_ball ? outer : hollow);
        CHECK(magnitude(point.normal - expected) < 1e-8);
        CHECK(magnitude(by_twin(scene, ray) - expected) < 1e-3);
      }
      CHECK(outer > 20);
      CHECK(hollow > 5);
    }
  }
}
