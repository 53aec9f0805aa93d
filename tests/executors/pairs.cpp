// Scenes that combine features as no scene of the project does. Their kernels are compiled without a device:
// every two kinds of material stand side by side, and every pair of other features occurs together. Random
// ones are verified.
#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "host/loader/scene_file.hpp"
#include "host/pack/pack.hpp"
#include "host/scene/integrator.hpp"
#include "host/verify/verify.hpp"
#include "tests/support/entries.hpp"
#include "tests/support/process.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

namespace eyeray::engine::pairs {
namespace {

using namespace test;

// The keys of each kind of material.
const std::vector<std::string> materials = {
    "type = 'phong'\ndiffuse = 0.5\nspecular = 0.2",
    "type = 'mirror'",
    "type = 'dielectric'",
    "type = 'dielectric'\nroughness = 0.3\nabsorption = 0.5",
    "type = 'dielectric'\nthin = true",
    "type = 'dielectric'\nthin = true\nroughness = 0.3",
    "type = 'diffuse'",
    "type = 'diffuse'\nroughness = 0.5",
    "type = 'conductor'\nmetal = 'gold'",
    "type = 'plastic'",
    "type = 'principled'\nmetallic = 0.5",
    "type = 'principled'\nspecular_color = { checker = { even = 0.1, odd = 0.5, size = 1 } }\nsheen_color = "
    "0.5",
    "type = 'principled'\ncoat = 1\ncoat_roughness = 0.2",
    "type = 'principled'\ntransmission = 1\nroughness = 0",
    "type = 'principled'\ntransmission = { checker = { even = 0.1, odd = 1, size = 1 } }\nroughness = 0.4",
    "type = 'principled'\ntransmission = 0.8\nior = 1\ncoat = 0.5",
    "type = 'principled'\ntransmission = 1\nthin = true\nroughness = 0",
    "type = 'principled'\ntransmission = 0.5\nthin = true\nroughness = 0.4\ncoat = 0.5",
    "type = 'principled'\ndiffuse_transmission = 0.6\nmetallic = 0.2\nanisotropy = 0.7",
    "type = 'principled'\niridescence = 1\ntransmission = 0.5\nthin = true",
    "type = 'dielectric'\nior = 1.7\ndispersion = 2",
    "type = 'principled'\ncoat = 1\ncoat_normal = { image = 'studs_normal.png' }",
};

// 80 points, enough for a light BVH.
std::string many_points() {
  std::string text;
  for (int i = 0; i < 80; ++i)
    text += std::string(i == 0 ? "" : ", ") + "[" + std::to_string(i % 8 - 4) + ", " +
            std::to_string(4 + i / 8) + ", " + std::to_string(i % 3) + "]";
  return text;
}

enum Factor { integrator, camera, light, medium, surface, shape, sampler, motion, storage, factors };

const std::array<std::vector<std::string>, factors> levels = {{
    {"'path'", "'sppm'\nphotons = 256\nphoton_radius = 0.1", "'whitted'", "'raycast'"},
    {"", "aperture = 0.1\nfocus = 4", "type = 'orthographic'", "type = 'fisheye'", "type = 'panorama'",
     "type = 'cylindrical'",
     "type = 'formula'\nfile = 'little_planet.glsl'\nparameters = { zoom = 2.2, aperture = 0.03, focus = 3.5 "
     "}"},
    {"[[light]]\ntype = 'point'\nposition = [0, 4, 0]\nintensity = 9",
     "[[light]]\ntype = 'spot'\nposition = [0, 4, 0]\ndirection = [0, -1, 0]\nintensity = 9",
     "[[light]]\ntype = 'directional'\ndirection = [0, -1, 0]",
     "[[light]]\ntype = 'directional'\ndirection = [0, -1, 0]\nangle = 3",
     "[[material]]\nname = 'lamp'\ntype = 'phong'\ndiffuse = 0\nemission = 9\n[[sphere]]\ncenter = [0, 5, "
     "0]\nradius = 1\nmaterial = 'lamp'",
     "[environment]\ntype = 'sky'\nsun = [0, 1, 0]", "[environment]\nimage = 'studio.hdr'",
     // Many area lights, for a light BVH; their light comes from a texture and leaves on one side.
     "[[material]]\nname = 'lamp'\ntype = 'phong'\ndiffuse = 0\nemission_side = 'front'\nemission = { "
     "checker = "
     "{ even = 1, odd = 9, size = 1 } }\n[[parallelogram]]\nedge_u = [0.1, 0, 0]\nedge_v = [0, 0, "
     "0.1]\nmaterial = 'lamp'\nbatch = { origin = [" +
         many_points() + "] }",
     // Several lights.
     "[[light]]\ntype = 'point'\nposition = [0, 4, 0]\nintensity = 9\n[[light]]\ntype = 'spot'\nposition = "
     "[1, 4, 1]\n"
     "direction = [0, -1, 0]\nintensity = 9\n[[material]]\nname = 'lamp'\ntype = 'phong'\ndiffuse = "
     "0\nemission = 9\n"
     "[[sphere]]\ncenter = [0, 6, 0]\nradius = 1\nmaterial = 'lamp'\n[[disk]]\ncenter = [3, 3, 0]\nnormal = "
     "[-1, -1, 0]\n"
     "radius = 0.5\nmaterial = 'lamp'",
     "[environment]\ntype = 'sky'\nsun = [0, 1, 0]\n[[light]]\ntype = 'directional'\ndirection = [0.3, -1, "
     "0]\nangle = 3\n"
     "[[light]]\ntype = 'directional'\ndirection = [0, -1, 0.3]\n[[light]]\ntype = 'point'\nposition = [0, "
     "4, 0]\nintensity = 9"},
    {"", "[medium]\nscattering = 0.1", "[medium]\nabsorption = 0.1",
     "[medium]\nscattering = 0.1\nscale_height = 2", "[medium]\nabsorption = 0.1\ntop = 3"},
    {"",
     "[[material]]\nname = 'netting'\ntype = 'mirror'\nalpha = { checker = { even = 0, odd = 1, size = 1 } "
     "}\n"
     "[[disk]]\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 1\nmaterial = 'netting'",
     "[[material]]\nname = 'veil'\ntype = 'phong'\nalpha = 0.5\nalpha_mode = 'blend'\n"
     "[[disk]]\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 1\nmaterial = 'veil'",
     "bump = { checker = { even = 0, odd = 1, size = 1 } }\nbump_height = 0.1\nbump_width = 0.1",
     "[[material]]\nname = 'tiles'\ntype = 'phong'\ndiffuse = { formula = { file = 'hexagons.glsl', "
     "parameters = "
     "{ tiles = 3, joint = 0.06, light = [0.72, 0.66, 0.55], dark = [0.12, 0.1, 0.09] } } "
     "}\n[[disk]]\ncenter = "
     "[0, 0, 0]\nnormal = [0, 0, 1]\nradius = 1\nmaterial = 'tiles'"},
    {"[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = 'a'",
     "[[triangle]]\nvertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\nmaterial = 'a'",
     "[[csg]]\noperation = 'intersection'\nmaterial = 'a'\n[[csg.sphere]]\ncenter = [0, 0, 0]\nradius = "
     "1\n[[csg.sphere]]\ncenter = [0.5, 0, 0]\nradius = 1",
     "[[material]]\nname = 'lid'\ntype = 'mirror'\n[[csg]]\noperation = 'union'\nmaterial = "
     "'a'\n[[csg.torus]]\ncenter = [0, 0, 0]\nmajor_radius = "
     "0.8\nminor_radius = 0.2\n[[csg.sphere]]\ncenter = [0.5, 0, 0]\nradius = 0.4\nmaterial = 'lid'",
     "[[mesh]]\nfile = 'triangle.gltf'", "[[mesh]]\nfile = 'unlit.gltf'",
     "[[mesh]]\nfile = 'ring.ply'\nmaterial = 'a'",
     "[[group]]\nbatch = { transform = [[{ translate = [-1, 0, 0] }], [{ translate = [1, 0, 0] }]] "
     "}\n[[group.mesh]]\nfile = 'ring.ply'\nmaterial = 'a'\n[[group.sphere]]\ncenter = [0, 0, 0]\nradius = "
     "0.2\nmaterial = 'a'",
     "[[implicit]]\nready = 'gyroid'\nmin = [-0.8, -0.8, -0.8]\nmax = [0.8, 0.8, 0.8]\nmaterial = 'a'"},
    {"pattern = 'regular'", "pattern = 'jittered'", "pattern = 'random'", "pattern = 'sobol'",
     "pattern = 'sobol'\nfilter = 'gaussian'"},
    {"",
     "[animation]\nframe = 1\nshutter = 1\nshutter_steps = 2\n[[track]]\ntarget = "
     "'sphere.mover.center'\nkeyframes = [[0, "
     "[-1, 1, 0]], [2, [1, 1, 0]]]\n[[material]]\nname = 'moved'\ntype = 'diffuse'\n[[sphere]]\nname = "
     "'mover'\ncenter = "
     "[0, 0, 0]\nradius = 0.4\nmaterial = 'moved'"},
    {"constants", "buffers"},
}};

// A triangle of glTF with a material. Materials that are not doubleSided have a front only.
std::string gltf_triangle(const std::string& material) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "extensionsUsed": ["KHR_materials_unlit"], "nodes": [{"mesh": 0}], "materials": [)" +
         material + R"(],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

using Levels = std::array<size_t, factors>;

struct Row {
  size_t first, second;  // materials
  Levels level;
};

// True if a scene may combine these levels.
bool possible(const Levels& level) {
  const bool paths = level[integrator] < 2, raycast = level[integrator] == 3;
  const bool environment = level[light] == 5 || level[light] == 6 || level[light] == 9;
  const bool from_afar = level[light] == 2 || level[light] == 3 || environment;
  const bool any_medium = level[medium] > 0, endless = level[medium] == 1 || level[medium] == 2;
  if ((any_medium && !paths) || (endless && from_afar)) return false;
  if (environment && !paths) return false;
  return !raycast || level[light] == 0;
}

using Pair = std::array<size_t, 4>;

void add_pairs(const Levels& level, std::set<Pair>& pairs) {
  for (size_t i = 0; i < factors; ++i)
    for (size_t j = i + 1; j < factors; ++j) pairs.insert({i, level[i], j, level[j]});
}

Levels any_levels(Random& random) {
  Levels level;
  do {
    for (size_t i = 0; i < factors; ++i) level[i] = size_t(random.below(int(levels[i].size())));
  } while (!possible(level));
  return level;
}

std::set<Pair> possible_pairs() {
  std::set<Pair> pairs;
  Random random(1);
  for (int i = 0; i < 20000; ++i) add_pairs(any_levels(random), pairs);
  return pairs;
}

// The random candidate with the most uncovered pairs.
Levels best_levels(Random& random, const std::set<Pair>& covered, bool paths) {
  Levels best{};
  size_t most = 0;
  for (int i = 0; i < 60 || most == 0; ++i) {
    const Levels level = any_levels(random);
    if (paths && level[integrator] > 1) continue;
    std::set<Pair> pairs = covered;
    add_pairs(level, pairs);
    const size_t gain = pairs.size() - covered.size();
    if (gain + 1 > most) {
      best = level;
      most = gain + 1;
    }
  }
  return best;
}

// All pairs of materials occur in random walks, which alone need BSDFs. More rows follow until every pair of
// levels has occurred.
std::vector<Row> all_rows() {
  const std::set<Pair> wanted = possible_pairs();
  std::set<Pair> covered;
  std::vector<Row> rows;
  Random random(2);
  const auto add_row = [&](size_t first, size_t second, bool paths) {
    rows.push_back({first, second, best_levels(random, covered, paths)});
    add_pairs(rows.back().level, covered);
  };
  for (size_t a = 0; a < materials.size(); ++a)
    for (size_t b = a; b < materials.size(); ++b) add_row(a, b, true);
  for (size_t i = 0; covered.size() < wanted.size() || i < materials.size(); ++i)
    add_row(i % materials.size(), (i * 5 + 1) % materials.size(), false);
  return rows;
}

std::string text_of(const Row& row, const std::string& eye = "[0, 1, 5]") {
  const auto at = [&](Factor factor) { return levels[factor][row.level[factor]] + "\n"; };
  return "[image]\nwidth = 8\nheight = 8\n" + levels[sampler][row.level[sampler]] +
         "\n[camera]\neye = " + eye + "\n" + at(camera) +
         "[render]\ngroups = 'instanced'\nintegrator = " + at(integrator) + at(light) + at(medium) +
         at(motion) + "[[material]]\nname = 'a'\n" + materials[row.first] + "\n" + at(surface) +
         "[[material]]\nname = 'b'\n" + materials[row.second] + "\n" + at(shape) +
         "[[parallelogram]]\norigin = [-2, -1, 1]\nedge_u = [4, 0, 0]\nedge_v = [0, 2, 0]\nmaterial = 'b'\n" +
         // A floor on which photons are gathered.
         (row.level[integrator] == 1
              ? "[[material]]\nname = 'floor'\ntype = 'diffuse'\n[[plane]]\npoint = [0, -2, 0]\nnormal = [0, "
                "1, 0]\nmaterial = 'floor'\n"
              : "");
}

// The values that each HAS_* has had, in any kernel.
using Features = std::map<std::string, std::set<std::string>>;

void add_features(const std::string& text, Features& features) {
  static const std::regex line("#define (HAS_\\w+) (\\w+)");
  for (std::sregex_iterator at(text.begin(), text.end(), line), end; at != end; ++at)
    features[(*at)[1]].insert((*at)[2]);
}

void compile(const Row& row, const std::string& file, Features& features) {
  const records::PackedScene packed = pack::pack(loader::load_scene(file));
  const executors::Specialisation options{.constants = row.level[storage] == 0};
  add_features(executors::specialise(packed, options), features);
  compile_entry("kernels/render.comp.glsl", packed, options);
  if (row.level[integrator] == 1)
    compile_entry("kernels/photons.comp.glsl", packed, options, "#define SENDS_PHOTONS\n");
}

// Writes the scene's file beside the files that it names, and returns its path.
std::string write_scene(const TemporaryFolder& folder, const std::string& text) {
  for (const char* file :
       {"scenes/cameras/little_planet.glsl", "scenes/patterns/hexagons.glsl", "scenes/meshes/ring.ply",
        "scenes/path/studio.hdr", "scenes/textures/studs_normal.png"})
    std::filesystem::copy_file(file, folder.path() / std::filesystem::path(file).filename());
  write_text(folder / "triangle.gltf", gltf_triangle("{}"));
  write_text(folder / "unlit.gltf", gltf_triangle(R"({"extensions": {"KHR_materials_unlit": {}}})"));
  write_text(folder / "scene.toml", text);
  return folder / "scene.toml";
}

void check_compiles(const Row& row, Features& features) {
  const TemporaryFolder folder;
  const std::string text = text_of(row);
  CAPTURE(text);
  CHECK_NOTHROW(compile(row, write_scene(folder, text), features));
}

std::string toml(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

// A shape of either material, anywhere around the middle.
std::string any_shape(Random& random) {
  static const std::string kinds[] = {
      "[[sphere]]\ncenter = [0, 0, 0]\nradius = 0.5",
      "[[box]]\nmin = [-0.4, -0.3, -0.5]\nmax = [0.4, 0.3, 0.5]",
      "[[torus]]\ncenter = [0, 0, 0]\nmajor_radius = 0.5\nminor_radius = 0.2",
      "[[cylinder]]\nfrom = [0, -0.4, 0]\nto = [0, 0.4, 0]\nradius = 0.3",
      "[[ellipsoid]]\ncenter = [0, 0, 0]\nradii = [0.3, 0.5, 0.4]",
      "[[disk]]\ncenter = [0, 0, 0]\nnormal = [0, 1, 0]\nradius = 0.6",
  };
  return fmt::format(
      "{}\nmaterial = '{}'\ntransform = [{{ rotate = {{ axis = {}, degrees = {} }} }}, {{ translate = {} "
      "}}]\n",
      kinds[random.below(int(std::size(kinds)))], random.below(2) ? 'a' : 'b', toml(random.direction()),
      random.uniform(0, 360), toml(random.point(1.4)));
}

// Checks gates A to D on a random scene made from the seed.
void check_verified(uint64_t seed) {
  Random random(seed);
  const auto material = [&] { return size_t(random.below(int(materials.size()))); };
  const Row row{material(), material(), any_levels(random)};
  Vec3 eye = random.direction() * 5.0;
  eye.y = std::abs(eye.y);  // above the floor
  std::string text = text_of(row, toml(eye));
  for (int i = 0; i < 3; ++i) text += any_shape(random);
  const TemporaryFolder folder;
  Scene scene = loader::load_scene(write_scene(folder, text));
  scene.image.width = 24;
  scene.image.height = 18;
  scene.image.samples = 4;
  scene.image.transparent = seed % 2 == 0;
  scene.render.seed = uint32_t(seed);
  if (scene.render.integrator == IntegratorType::sppm) {
    scene.render.photons = 2048;
    scene.render.photon_radius = 0.3;
  }
  verify::Options options;
  options.executor.gpu.constants = row.level[storage] == 0;
  options.executor.gpu.timeout_seconds = 600;  // compilers are slow on a busy machine
  options.max_explained = 0.05;
  const compare::Report report = verify::verify_scene({scene, fmt::format("seed {}", seed), "", ""}, options);
  INFO(text);
  INFO(to_text(report));
  CHECK(report.passes());
}

}  // namespace

TEST_CASE("a pane compiles beside an opaque material of each kind") {
  Features features;
  for (const size_t beside : {6, 9, 10}) check_compiles({beside, 4, {}}, features);
}

TEST_CASE("all pairs of materials, and of other features, compile" * doctest::test_suite("long")) {
  Features features;
  for (const Row& row : all_rows()) check_compiles(row, features);
  // No feature is in all of these kernels, or in none.
  for (const auto& feature : features) {
    CAPTURE(feature.first);
    CHECK(feature.second.size() == 2);
  }
}

TEST_CASE("random scenes that combine everything pass every gate") {
  for (uint64_t seed = 1; seed <= 3; ++seed) check_verified(seed);
}

TEST_CASE("60 random scenes that combine everything pass every gate" * doctest::test_suite("long")) {
  for (uint64_t seed = 1; seed <= 60; ++seed) check_verified(seed);
}

}  // namespace eyeray::engine::pairs
