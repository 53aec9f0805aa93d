// PROBE in shaders: ordinary kernels contain none of it, and where a pixel is probed, GPU and twin have the
// same rays.
#include <algorithm>
#include <bit>
#include <regex>

#include "host/executors/shader_probe.hpp"
#include "host/loader/scene_file.hpp"
#include "host/pack/pack.hpp"
#include "tests/support/entries.hpp"
#include "tests/support/shader_overlay.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;
using namespace eyeray::engine::records;

namespace {

// The text without the PROBE statements.
std::string without_probes(const std::string& text, size_t& count) {
  static const std::regex statement(R"(\n *PROBE\w*\([^\n]*\);(?=\n))");
  count += size_t(std::distance(std::sregex_iterator(text.begin(), text.end(), statement), {}));
  return std::regex_replace(text, statement, "");
}

Scene small(const std::string& file) {
  Scene scene = loader::load_scene(file);
  scene.image.width = 96;
  scene.image.height = 72;
  return scene;
}

std::unique_ptr<Executor> executor(Backend backend, const Scene& scene, const std::string& shaders = "") {
  ExecutorOptions options;
  options.ray_kinds = true;
  options.shader_folder = shaders;
  return make_executor(backend, scene, options);
}

bool same_bits(const ProbedValue& a, const ProbedValue& b) {
  return a.name == b.name && a.type == b.type && a.size == b.size && a.line == b.line && a.file == b.file &&
         std::bit_cast<std::array<uint64_t, 4>>(a.numbers) ==
             std::bit_cast<std::array<uint64_t, 4>>(b.numbers);
}

const ProbedValue* find(const ProbedRay& ray, const std::string& name) {
  const auto value = std::ranges::find(ray.values, name, &ProbedValue::name);
  return value == ray.values.end() ? nullptr : &*value;
}

// Probes pixels of the scene by GPU and twin.
void check_pixels(const std::string& file, int count) {
  CAPTURE(file);
  const Scene scene = small(file);
  const auto gpu = executor(Backend::gpu, scene), twin = executor(Backend::twin, scene);
  for (int i = 0; i < count; ++i) {
    const int x = (17 + 37 * i) % 96, y = (31 + 23 * i) % 72;
    CAPTURE(x);
    CAPTURE(y);
    const Probed a = gpu->probe(x, y, 0), b = twin->probe(x, y, 0);
    PixelSample sample;
    REQUIRE(gpu->sample(Rect{x, y, 1, 1}, 0, std::span(&sample, 1)));
    CHECK(a.sample.color == sample.color);
    CHECK(b.sample.color == sample.color);
    CHECK(a.rays.lost == 0);

    // The rays are as many as were counted, and each is the same.
    CHECK(a.rays.rays.size() == sample.rays + 1);
    REQUIRE(a.rays.rays.size() == b.rays.rays.size());
    Vec3 sum(0.0);
    for (size_t r = 0; r < a.rays.rays.size(); ++r) {
      const ProbedRay &ray = a.rays.rays[r], &other = b.rays.rays[r];
      CHECK(ray.kind == other.kind);
      CHECK(ray.parent == other.parent);
      CHECK(ray.index == other.index);
      REQUIRE(ray.values.size() == other.values.size());
      for (size_t k = 0; k < ray.values.size(); ++k) {
        CAPTURE(ray.values[k].name);
        CHECK(same_bits(ray.values[k], other.values[k]));
        CHECK(ray.values[k].file != "");
      }
      if (ray.kind == RayKind::pixel || ray.kind == RayKind::shadow) continue;
      const ProbedValue *throughput = find(ray, "throughput"), *light = find(ray, "light");
      REQUIRE(throughput != nullptr);
      REQUIRE(light != nullptr);
      // The sum is made in float32, in this order.
      for (int c = 0; c < 3; ++c)
        sum[c] =
            double(float(sum[c]) + float(throughput->numbers[size_t(c)]) * float(light->numbers[size_t(c)]));
    }
    CHECK(sum == sample.color);
  }
}

}  // namespace

TEST_CASE("kernels that do not record contain nothing of PROBE") {
  const PackedScene packed = pack::pack(loader::load_scene("scenes/whitted.toml"));
  for (const char* entry :
       {"kernels/render.comp.glsl", "kernels/wavefront.comp.glsl", "kernels/query.comp.glsl"}) {
    for (const bool constants : {true, false}) {
      CAPTURE(entry);
      const gpu::ShaderSource source = test::entry_source(entry, packed, {.constants = constants});
      gpu::ShaderSource stripped = source;
      size_t count = 0;
      for (auto& [name, text] : stripped.files)
        if (name != "language.h" && name != "kernels/probe.glsl") text = without_probes(text, count);
      CHECK(count > 20);
      CHECK(gpu::compile_shader(source, "").spirv == gpu::compile_shader(stripped, "").spirv);
    }
  }
}

TEST_CASE("GPU and twin record the same rays and values, and these add up to the pixel") {
  for (const char* scene : {"scenes/whitted.toml", "scenes/meshes.toml"}) check_pixels(scene, 6);
}

TEST_CASE("GPU and twin record the same rays and values in every kind of scene" *
          doctest::test_suite("long")) {
  for (const char* scene :
       {"scenes/alpha.toml", "scenes/cornell.toml", "scenes/inside_glass.toml", "scenes/textures.toml",
        "scenes/group_instances.toml", "scenes/sphereflake.toml", "scenes/orthographic.toml",
        "scenes/shapes/csg.toml", "scenes/shapes/implicit.toml", "scenes/shapes/bezier.toml",
        "scenes/edges/nested.toml"})
    check_pixels(scene, 6);
}

TEST_CASE("a user's PROBE records values of every type, with their line and their ray") {
  const test::TemporaryFolder folder;
  const std::string before = "  bool deeper = path.depth < frame.max_depth;\n";
  const std::string text = test::replaced(test::own_shader("integrators/whitted.glsl"), before,
                                          before +
                                              "  PROBE(a_float, 0.25f); PROBE( a_vec2, vec2(1.0f, 2.0f) );\n"
                                              "  PROBE(a_vec3, vec3(1.0f, 2.0f, 3.0f));\n"
                                              "  if (deeper) PROBE(a_vec4, vec4(1.0f, 2.0f, 3.0f, 4.0f));\n"
                                              "  PROBE(an_int, -7);\n"
                                              "  PROBE(a_uint, 0xffffffffu);\n"
                                              "  PROBE(a_bool, deeper);\n");
  test::lay_shader(folder.path(), "integrators/whitted.glsl", text);
  const auto line = uint32_t(std::ranges::count(text.substr(0, text.find("PROBE(a_float")), '\n')) + 1;

  const Scene scene = small("scenes/whitted.toml");
  const Probed probed = executor(Backend::gpu, scene, folder.path())->probe(48, 45, 0);
  int seen = 0;
  for (const ProbedRay& ray : probed.rays.rays) {
    const ProbedValue* primitive = find(ray, "primitive");
    const bool hit = primitive && primitive->numbers[0] >= 0;
    CHECK((find(ray, "a_float") != nullptr) == hit);
    if (!hit) continue;
    ++seen;
    using Type = ProbedValue::Type;
    const auto check = [&](const char* name, Type type, std::vector<double> numbers, uint32_t at) {
      CAPTURE(name);
      const ProbedValue* value = find(ray, name);
      REQUIRE(value != nullptr);
      CHECK(value->type == type);
      REQUIRE(size_t(value->size) == numbers.size());
      for (size_t c = 0; c < numbers.size(); ++c) CHECK(value->numbers[c] == numbers[c]);
      CHECK(value->line == at);
      CHECK(value->file == "integrators/whitted.glsl");
    };
    check("a_float", Type::real, {0.25}, line);
    check("a_vec2", Type::real, {1, 2}, line);
    check("a_vec3", Type::real, {1, 2, 3}, line + 1);
    check("an_int", Type::integer, {-7}, line + 3);
    check("a_uint", Type::integer, {4294967295.0}, line + 4);
    const bool deeper = find(ray, "a_bool")->numbers[0] == 1;
    CHECK((find(ray, "a_vec4") != nullptr) == deeper);
    if (deeper) check("a_vec4", Type::real, {1, 2, 3, 4}, line + 2);
  }
  CHECK(seen > 3);
}

TEST_CASE("records beyond the buffer's capacity are counted") {
  const std::map<std::string, std::string, std::less<>> files{{"a.glsl", "PROBE(x, 1.0f);\n"}};
  const ShaderProbe probe(files);
  std::vector<shader::ProbeRecord> records(3);
  records[0].name = 100;
  records[1] = {0, 1, PROBE_FLOAT, 1, {std::bit_cast<uint32_t>(2.5f), 0, 0, 0}};
  records[2] = {12345, 1, PROBE_FLOAT, 1, {}};  // no PROBE writes this, but a shader may write anything
  const RayTree tree = probe.tree(records);
  CHECK(tree.lost == 98);
  REQUIRE(tree.rays[0].values.size() == 1);
  CHECK(tree.rays[0].values[0].numbers[0] == 2.5);
  CHECK(tree.rays[0].values[0].file == "a.glsl");
}
