// Kernels of scenes that combine features as no scene of the project does: each is compiled, without a
// device. Every two kinds of material stand side by side, and of all other features every pair occurs
// together.
#include <array>
#include <set>
#include <string>
#include <vector>

#include "host/loader/scene_file.hpp"
#include "host/pack/pack.hpp"
#include "tests/support/entries.hpp"
#include "tests/support/process.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

namespace eyeray::pairs {
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
    "type = 'principled'\ntransmission = 1\nthin = true\nroughness = 0",
    "type = 'principled'\ntransmission = 0.5\nthin = true\nroughness = 0.4\ncoat = 0.5",
};

enum Factor { integrator, camera, light, medium, surface, shape, sampler, storage, factors };

const std::array<std::vector<std::string>, factors> levels = {{
    {"'path'", "'sppm'\nphotons = 256\nphoton_radius = 0.1", "'whitted'", "'raycast'"},
    {"", "aperture = 0.1\nfocus = 4", "type = 'orthographic'", "type = 'fisheye'", "type = 'panorama'",
     "type = 'cylindrical'"},
    {"[[light]]\ntype = 'point'\nposition = [0, 4, 0]\nintensity = 9",
     "[[light]]\ntype = 'spot'\nposition = [0, 4, 0]\ndirection = [0, -1, 0]\nintensity = 9",
     "[[light]]\ntype = 'directional'\ndirection = [0, -1, 0]",
     "[[light]]\ntype = 'directional'\ndirection = [0, -1, 0]\nangle = 3",
     "[[material]]\nname = 'lamp'\ntype = 'phong'\ndiffuse = 0\nemission = 9\n[[sphere]]\ncenter = [0, 5, "
     "0]\nradius = 1\nmaterial = 'lamp'",
     "[environment]\ntype = 'sky'\nsun = [0, 1, 0]"},
    {"", "[medium]\nscattering = 0.1", "[medium]\nabsorption = 0.1",
     "[medium]\nscattering = 0.1\nscale_height = 2", "[medium]\nabsorption = 0.1\ntop = 3"},
    {"",
     "[[material]]\nname = 'netting'\ntype = 'mirror'\nalpha = { checker = { even = 0, odd = 1, size = 1 } "
     "}\n"
     "[[disk]]\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 1\nmaterial = 'netting'",
     "[[material]]\nname = 'veil'\ntype = 'phong'\nalpha = 0.5\nalpha_mode = 'blend'\n"
     "[[disk]]\ncenter = [0, 0, 0]\nnormal = [0, 0, 1]\nradius = 1\nmaterial = 'veil'",
     "bump = { checker = { even = 0, odd = 1, size = 1 } }\nbump_height = 0.1\nbump_width = 0.1"},
    {"[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = 'a'",
     "[[triangle]]\nvertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\nmaterial = 'a'",
     "[[csg]]\noperation = 'intersection'\nmaterial = 'a'\n[[csg.sphere]]\ncenter = [0, 0, 0]\nradius = "
     "1\n[[csg.sphere]]\ncenter = [0.5, 0, 0]\nradius = 1"},
    {"regular", "jittered", "random", "sobol"},
    {"constants", "buffers"},
}};

using Levels = std::array<size_t, factors>;

struct Row {
  size_t first, second;  // materials
  Levels level;
};

// Whether a scene may have both.
bool possible(const Levels& level) {
  const bool paths = level[integrator] < 2, raycast = level[integrator] == 3;
  const bool from_afar = level[light] == 2 || level[light] == 3 || level[light] == 5;
  const bool any_medium = level[medium] > 0, endless = level[medium] == 1 || level[medium] == 2;
  if ((any_medium && !paths) || (endless && from_afar)) return false;
  if (level[light] == 5 && !paths) return false;
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

// All pairs of materials meet in random walks, which alone need BSDFs. More rows follow until every pair of
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

std::string text_of(const Row& row) {
  const auto at = [&](Factor factor) { return levels[factor][row.level[factor]] + "\n"; };
  return "[image]\nwidth = 8\nheight = 8\npattern = '" + levels[sampler][row.level[sampler]] +
         "'\n[camera]\neye = [0, 1, 5]\n" + at(camera) + "[render]\nintegrator = " + at(integrator) +
         at(light) + at(medium) + "[[material]]\nname = 'a'\n" + materials[row.first] + "\n" + at(surface) +
         "[[material]]\nname = 'b'\n" + materials[row.second] + "\n" + at(shape) +
         "[[parallelogram]]\norigin = [-2, -1, 1]\nedge_u = [4, 0, 0]\nedge_v = [0, 2, 0]\nmaterial = 'b'\n" +
         // Photons are gathered on it.
         (row.level[integrator] == 1
              ? "[[material]]\nname = 'floor'\ntype = 'diffuse'\n[[plane]]\npoint = [0, -2, 0]\nnormal = [0, "
                "1, 0]\nmaterial = 'floor'\n"
              : "");
}

void compile(const Row& row, const std::string& file) {
  const records::PackedScene packed = pack::pack(loader::load_scene(file));
  const executors::Specialisation options{.constants = row.level[storage] == 0};
  compile_entry("kernels/render.comp.glsl", packed, options);
  if (row.level[integrator] == 1)
    compile_entry("kernels/photons.comp.glsl", packed, options, "#define SENDS_PHOTONS\n");
}

void check_compiles(const Row& row) {
  const TemporaryFolder folder;
  const std::string text = text_of(row);
  CAPTURE(text);
  write_text(folder / "scene.toml", text);
  CHECK_NOTHROW(compile(row, folder / "scene.toml"));
}

}  // namespace

TEST_CASE("a pane compiles beside an opaque material of each kind") {
  for (const size_t beside : {6, 9, 10}) check_compiles({beside, 4, {}});
}

TEST_CASE("all pairs of materials, and of other features, compile" * doctest::test_suite("long")) {
  for (const Row& row : all_rows()) check_compiles(row);
}

}  // namespace eyeray::pairs
