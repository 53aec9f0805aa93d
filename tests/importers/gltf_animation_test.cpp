// Animations of glTF files: the state of nodes, skins and morph targets at a moment, and faults in them.
#include <functional>
#include <numbers>

#include "gltf_files.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

struct Sampled {
  std::string path;
  std::string interpolation;  // "": not written
  std::vector<double> times;
  std::vector<double> values;
  int component = 5126;
  bool normalized = false;
};

// Adds an animation that moves a node. Its accessors come last in the file: times, then values.
void animate(GltfFile& file, const Sampled& what, int node = 0) {
  const bool weights = what.path == "weights", rotation = what.path == "rotation";
  const int input = file.add(what.times, 5126, "SCALAR", 1);
  const int output = file.add(what.values, what.component,
                              weights    ? "SCALAR"
                              : rotation ? "VEC4"
                                         : "VEC3",
                              weights    ? 1
                              : rotation ? 4
                                         : 3,
                              what.normalized);
  Json sampler = {{"input", input}, {"output", output}};
  if (!what.interpolation.empty()) sampler["interpolation"] = what.interpolation;
  file.json["animations"].push_back(
      {{"samplers", {sampler}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", what.path}}}}}}});
}

GltfFile animated_square(const Sampled& what) {
  GltfFile file = square_file();
  animate(file, what);
  return file;
}

ImportedScene at(const GltfFile& file, double seconds, bool loop = false) {
  return import_sound(file.gltf(), "a.gltf", {.playing = {.seconds = seconds, .loop = loop}});
}

// The position to which the square's point p has moved after `seconds`.
Vec3 point_at(const GltfFile& file, double seconds, const Vec3& p = Vec3(0), bool loop = false) {
  const ImportedScene scene = at(file, seconds, loop);
  REQUIRE(scene.instances.size() == 1);
  return Vec3(scene.instances[0].transform * Vec4(p, 1));
}

bool near(const Vec3& a, const Vec3& b) {
  return glm::length(a - b) < 1e-6;
}

// The quaternion of a rotation about z.
std::vector<double> turn(double degrees) {
  const double half = glm::radians(degrees) / 2;
  return {0, 0, std::sin(half), std::cos(half)};
}
Vec3 turned(double degrees) {
  return {std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees)), 0};
}

std::vector<double> joined(const std::vector<std::vector<double>>& parts) {
  std::vector<double> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

TEST_CASE("translations step or are linear between keys, and stay constant beyond the ends") {
  const std::vector<double> times = {0.5, 1.5, 3.5}, values = {1, 0, 0, 3, 8, 0, 3, 4, -6};
  const GltfFile straight = animated_square({"translation", "", times, values});
  CHECK(near(point_at(straight, 0), Vec3(1, 0, 0)));
  CHECK(near(point_at(straight, -7), Vec3(1, 0, 0)));
  CHECK(near(point_at(straight, 0.75), Vec3(1.5, 2, 0)));
  CHECK(near(point_at(straight, 1.5), Vec3(3, 8, 0)));
  CHECK(near(point_at(straight, 3), Vec3(3, 5, -4.5)));
  CHECK(near(point_at(straight, 99), Vec3(3, 4, -6)));
  const ImportedScene scene = at(straight, 0);
  REQUIRE(scene.played);
  CHECK(scene.played->values == 1);
  CHECK(scene.played->first == 0.5);
  CHECK(scene.played->last == 3.5);
  CHECK(scene.warnings.empty());

  const GltfFile jumps = animated_square({"translation", "STEP", times, values});
  CHECK(near(point_at(jumps, 0), Vec3(1, 0, 0)));
  CHECK(near(point_at(jumps, 1.4375), Vec3(1, 0, 0)));
  CHECK(near(point_at(jumps, 1.5), Vec3(3, 8, 0)));
  CHECK(near(point_at(jumps, 3.5), Vec3(3, 4, -6)));

  // With `loop`, the animation starts again from 0 after the last key.
  CHECK(near(point_at(straight, 3.5 + 0.75, Vec3(0), true), Vec3(1.5, 2, 0)));
  CHECK(near(point_at(straight, 0.75 - 3.5, Vec3(0), true), Vec3(1.5, 2, 0)));
}

// Only one cubic f has f(2) = 1, f'(2) = −3, f(4) = 5 and f'(4) = 2. With u = (x − 2)/2 it is 1 − 6 u + 20 u²
// − 10 u³.
TEST_CASE("cubic splines have the values and the slopes of their keys") {
  const GltfFile file = animated_square(
      {"translation", "CUBICSPLINE", {2, 4}, {9, 9, 9, 1, 0, 7, -3, 0, 0, 2, 0, 0, 5, 0, 7, 9, 9, 9}});
  for (const double u : {0.0, 0.125, 0.5, 0.75, 1.0}) {
    const Vec3 p = point_at(file, 2 + 2 * u);
    CHECK(p.x == doctest::Approx(1 - 6 * u + 20 * u * u - 10 * u * u * u));
    CHECK(p.y == 0);
    CHECK(p.z == doctest::Approx(7));
  }
  CHECK(near(point_at(file, 0), Vec3(1, 0, 7)));
  CHECK(near(point_at(file, 9), Vec3(5, 0, 7)));

  // The four numbers of a rotation are interpolated in the same way, then normalised: half way between two
  // keys they are the mean.
  const std::vector<double> none = {0, 0, 0, 0};
  const GltfFile spun = animated_square(
      {"rotation", "CUBICSPLINE", {0, 1}, joined({none, turn(0), none, none, turn(90), none})});
  CHECK(near(point_at(spun, 0.5, Vec3(1, 0, 0)), turned(45)));
  CHECK(at(spun, 0.25).warnings.empty());
}

TEST_CASE("rotations take the shortest way at constant speed, whatever their signs") {
  const GltfFile file =
      animated_square({"rotation", "LINEAR", {0, 1, 2}, joined({turn(0), turn(120), turn(280)})});
  for (const double t : {0.0, 0.25, 0.9, 1.0}) CHECK(near(point_at(file, t, {1, 0, 0}), turned(120 * t)));
  CHECK(near(point_at(file, 1.25, {1, 0, 0}), turned(160)));
  // From 20° to 360° − 20°, and to the same quaternion with the other sign: both go back over 0.
  const auto back = [](double sign) {
    std::vector<double> last = turn(-20);
    for (double& x : last) x *= sign;
    return animated_square({"rotation", "", {0, 1}, joined({turn(20), last})});
  };
  for (const double sign : {1.0, -1.0}) CHECK(near(point_at(back(sign), 0.25, {1, 0, 0}), turned(10)));
  // Two axes: half way from 90° about z to 90° about x, the rotation is 2/3 of a half turn about (1, 0, 1),
  // by cos θ/2 = (1/2 + 1/2)/√3 …
  const double k = std::sqrt(0.5);
  const GltfFile over = animated_square({"rotation", "", {0, 1}, {0, 0, k, k, k, 0, 0, k}});
  const double w = 2 / std::sqrt(6), x = 1 / std::sqrt(6);
  CHECK(near(point_at(over, 0.5, {0, 1, 0}), Vec3(-2 * w * x, 1 - 4 * x * x, 2 * w * x)));
  // A rotation that is not of unit length is normalised.
  const GltfFile longer = animated_square({"rotation", "", {0, 1}, joined({{0, 0, 0, 3}, turn(120)})});
  CHECK(near(point_at(longer, 0.25, {1, 0, 0}), turned(30)));
  // A rotation in shorts, which is not quite of unit length.
  const GltfFile coarse =
      animated_square({"rotation", "", {0, 1}, {0, 0, 0, 32767, 0, 0, 23170, 23170}, 5122, true});
  CHECK(glm::length(point_at(coarse, 0.5, {1, 0, 0}) - turned(45)) < 1e-4);
  CHECK(at(coarse, 0.5).warnings.empty());
}

TEST_CASE("properties of a node that nothing animates stay, and child nodes move with it") {
  GltfFile file = square_file();
  file.json["nodes"] = {{{"children", {1}}, {"translation", {0, 0, 5}}, {"scale", {9, 9, 9}}}, {{"mesh", 0}}};
  animate(file, {"scale", "", {0, 1}, {1, 1, 1, 3, 1, 1}});
  CHECK(near(point_at(file, 0.5, {1, 1, 0}), Vec3(2, 1, 5)));
  // At a moment at which the mesh has no extent, nothing is shown, and nothing is reported.
  GltfFile hidden = animated_square({"scale", "STEP", {0, 1}, {0, 0, 0, 1, 1, 1}});
  CHECK(at(hidden, 0.5).instances.empty());
  CHECK(at(hidden, 0.5).warnings.empty());
  CHECK(at(hidden, 1).instances.size() == 1);
  const GltfFile flat = animated_square({"scale", "", {0}, {1, 1, 0}});
  CHECK(warns(at(flat, 0), "a node whose transforms flatten everything was left out"));
}

TEST_CASE("each animated node has separate weights of morph targets") {
  GltfFile file = square_file();
  const auto all = [](double x, double z) {
    std::vector<double> change;
    for (int i = 0; i < 4; ++i) change.insert(change.end(), {x, 0, z});
    return change;
  };
  file.primitive()["targets"] = {{{"POSITION", file.add(all(0, 1), 5126, "VEC3", 3)}},
                                 {{"POSITION", file.add(all(1, 0), 5126, "VEC3", 3)}}};
  file.json["meshes"][0]["weights"] = {0, 7};
  file.json["nodes"] = {{{"mesh", 0}, {"weights", {9, 9}}}, {{"mesh", 0}}};
  file.json["scenes"] = {{{"nodes", {0, 1}}}};
  animate(file, {"weights", "", {0, 2}, {0, 1, 1, 3}});
  const auto first = [&](const ImportedScene& scene, size_t i) {
    return scene.meshes[size_t(scene.instances[i].mesh)].positions[0];
  };
  const ImportedScene scene = at(file, 0.5);
  CHECK(first(scene, 0) == Vec3(1.5, 0, 0.25));
  CHECK(first(scene, 1) == Vec3(7, 0, 0));

  file.json["animations"] = Json::array();
  animate(file, {"weights", "CUBICSPLINE", {0, 2}, {0, 0, 0, 0, 0, 0, 0, 0, 255, 51, 0, 0}, 5121, true});
  CHECK(near(first(at(file, 1), 0), Vec3(0.1, 0, 0.5)));
  file.json["animations"] = Json::array();
  animate(file, {"weights", "", {0, 2}, {0, 1, 2, 3, 4, 5}});
  CHECK(contains(refusal(file.gltf(), "a.gltf"), "meshes[0].primitives[0] has 2 targets, but 3 weights"));
}

TEST_CASE("the skin follows animated joints") {
  GltfFile file = square_file();
  Json& attributes = file.primitive()["attributes"];
  attributes["JOINTS_0"] = file.add({0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5121, "VEC4", 4);
  attributes["WEIGHTS_0"] = file.add({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5126, "VEC4", 4);
  file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}}, {{"children", {2}}}, Json::object()};
  file.json["scenes"] = {{{"nodes", {0, 1}}}};
  file.json["skins"] = {{{"joints", {1, 2}}}};
  animate(file, {"translation", "", {0, 1}, {0, 0, 0, 0, 4, 0}}, 2);
  CHECK(at(file, 0.25).meshes[0].positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}});
}

TEST_CASE("cameras and lights of a file move with their nodes") {
  GltfFile file = square_file();
  file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
  file.json["nodes"] = {{{"mesh", 0}}, {{"camera", 0}}};
  file.json["scenes"] = {{{"nodes", {0, 1}}}};
  animate(file, {"translation", "", {0, 1}, {0, 0, 0, 0, 0, 8}}, 1);
  CHECK(at(file, 0.25).cameras.at(0).eye == Vec3(0, 0, 2));
}

TEST_CASE("an animation is chosen by name or number, or is the first, or none") {
  GltfFile file = animated_square({"translation", "", {0}, {1, 0, 0}});
  animate(file, {"translation", "", {0}, {2, 0, 0}});
  animate(file, {"translation", "", {0}, {3, 0, 0}});
  file.json["animations"][1]["name"] = "Walk";
  file.json["animations"][2]["name"] = "1";
  file.json["nodes"][0]["translation"] = {7, 0, 0};
  const auto x = [&](std::optional<std::string> animation) {
    const ImportedScene scene =
        import_sound(file.gltf(), "a.gltf", {.playing = {.animation = std::move(animation)}});
    CHECK(scene.animations == std::vector<std::string>{"", "Walk", "1"});
    CHECK(scene.played.has_value() == (scene.instances[0].transform[3].x != 7));
    return scene.instances[0].transform[3].x;
  };
  CHECK(x(std::nullopt) == 1);
  CHECK(x("0") == 1);
  CHECK(x("Walk") == 2);
  CHECK(x("1") == 3);
  CHECK(x("2") == 3);
  for (const char* none : {"none", "", "3", "-1", "0x", "walk"}) CHECK(x(none) == 7);
}

TEST_CASE("animations that break rules are reported, one row for each rule") {
  const Sampled plain{"translation", "", {0, 1}, {0, 0, 0, 1, 0, 0}};
  struct Row {
    Sampled sampled;
    std::function<void(Json& file)> breach;
    std::string message;
  };
  const auto none = [](Json&) {};
  const auto set = [](const char* pointer, const Json& value) {
    return [=](Json& json) { json[Json::json_pointer(pointer)] = value; };
  };
  const auto erase = [](const char* parent, const char* key) {
    return [=](Json& json) { json[Json::json_pointer(parent)].erase(key); };
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string sampler = "animations[0].samplers[0]", channel = "animations[0].channels[0]";
  const std::vector<Row> rows = {
      {plain, none, "accepted"},
      {{"translation", "", {1, 1}, plain.values},
       none,
       "accessors[2] contains the time 1 after 1: times must increase"},
      {{"translation", "", {nan, 1}, plain.values}, none, "accessors[2] contains a time that is not finite"},
      {{"translation", "", {0, 1}, {0, 0, 0, 0, nan, 0}},
       none,
       "accessors[3] contains a translation that is not finite"},
      {{"translation", "", {0, 1}, {0, 0, 0}}, none, sampler + " has 1 outputs for 2 times"},
      {{"translation", "CUBICSPLINE", {0, 1}, plain.values}, none, sampler + " has 2 outputs for 2 times"},
      {{"weights", "", {0, 1, 2}, {1, 2}},
       set("/meshes/0/primitives/0/targets", Json::array({{{"POSITION", 0}}})),
       sampler + " has 2 outputs for 3 times"},
      {{"translation", "CUBIC", {0, 1}, plain.values},
       none,
       sampler + " has an interpolation that glTF does not define"},
      {{"rotation", "", {0}, {0, 0, 0, 0}}, none, "accessors[3] contains a rotation of length 0"},
      {{"rotation",
        "CUBICSPLINE",
        {0, 1},
        joined({{0, 0, 0, 0}, turn(0), {0, 0, 0, 0}, {0, 0, 0, 0}, turn(360), {0, 0, 0, 0}})},
       none,
       "animations[0] gives nodes[0] a rotation of length 0"},
      {{"rotation", "", {0}, {0, 0, 0, 1}, 5121},
       none,
       "accessors[3] contains rotation, which cannot be componentType 5121"},
      {{"translation", "", {0}, {0, 0, 1}, 5122, true},
       none,
       "accessors[3] contains translation, which cannot be normalized componentType 5122"},
      {plain, set("/accessors/2/componentType", 5125),
       "accessors[2] contains times, which cannot be componentType"},
      {plain, set("/accessors/2/type", "VEC2"), "accessors[2] must be of type SCALAR"},
      {plain, set("/accessors/2/count", 9), "accessors[2] reaches beyond the end of its bufferView"},
      {plain, set("/accessors/3/type", "VEC4"), "accessors[3] must be of type VEC3"},
      {plain, set("/bufferViews/3/byteStride", 12),
       "accessors[3] is in bufferViews[3], which has a byteStride"},
      {plain, set("/animations/0/samplers/0/input", 9), sampler + ".input must be an index below 4"},
      {plain, erase("/animations/0/samplers/0", "output"), sampler + " needs an input and an output"},
      {plain, set("/animations/0/channels/0/sampler", 1), channel + ".sampler must be an index below 1"},
      {plain, erase("/animations/0/channels/0", "sampler"), channel + " has no sampler"},
      {plain, erase("/animations/0/channels/0", "target"), channel + " has no target"},
      {plain, set("/animations/0/channels/0/target/node", 1),
       channel + ".target.node must be an index below 1"},
      {plain, set("/animations/0/channels/0/target/path", "colour"),
       channel + ".target has a path that glTF does not define"},
      {plain, set("/nodes/0/matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}),
       channel + ".target moves the translation of nodes[0], which has a matrix"},
      {plain,
       [](Json& json) {
         Json& channels = json["animations"][0]["channels"];
         channels.push_back(channels[0]);
       },
       "animations[0].channels[1].target moves the translation of nodes[0], as another channel does"},
      {plain, set("/animations", 3), "animations must be a list"},
  };
  for (const Row& row : rows) {
    GltfFile file = animated_square(row.sampled);
    row.breach(file.json);
    CAPTURE(row.message);
    const std::string message = refusal(file.gltf(), "a.gltf", {.playing = {.seconds = 0.5}});
    CHECK(contains(message, row.message));
  }

  // A broken rule whose meaning is clear causes only a warning.
  CHECK(warns(at(animated_square({"rotation", "", {0}, {0, 0, 0, 2}}), 0),
              "rotations that are not of unit length, normalised: 1, the first accessors[3]"));
  CHECK(warns(at(animated_square({"translation", "", {-1, 1}, plain.values}), 0),
              "animations that begin before 0: 1, the first accessors[2]"));
  // Channels that name no node are left out.
  GltfFile pointer = animated_square(plain);
  pointer.json["animations"][0]["channels"][0]["target"] = {{"path", "pointer"}};
  CHECK(warns(at(pointer, 0), "left out: animated values that belong to no node (1)"));
  // Animations that are not played are not checked.
  GltfFile second = animated_square(plain);
  animate(second, {"translation", "CUBICSPLINE", {1, 1}, {0, 0, 0}});
  CHECK(at(second, 0).warnings.empty());
}
