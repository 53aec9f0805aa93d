#include "generator.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "host/cameras/registry.hpp"
#include "host/lights/registry.hpp"
#include "host/loader/area_lights.hpp"
#include "host/loader/sections.hpp"
#include "host/materials/registry.hpp"
#include "host/shapes/registry.hpp"
#include "host/textures/registry.hpp"
#include "shaders/shapes/rows.h"

namespace eyeray::engine::test {

using reading::Key, reading::KeyType;

namespace {

constexpr double inf = Key::inf;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double extremes[] = {0,          -0.0,         1e-5,      1e-7,     1e-9,   1e-12,      1e-15,
                               1e-30,      1e-39,        1e-44,     5e-324,   1e-300, 1e4,        1e6,
                               1e9,        1e12,         1e15,      1e16,     3.4e38, 1e39,       1.7e308,
                               inf,        not_a_number, 1,         16777217, 65536,  0.99999999, 1.00000001,
                               89.9999999, 180,          179.999999};
constexpr int materials = 3;

class Writer {
 public:
  Writer(Random& random, const Wildness& wildness) : random_(random), wildness_(wildness) {
    for (const reading::TextureType* type : textures::types())
      if (type->parse && !type->is_flat()) tables_.push_back(type);  // flat ones name files
  }

  std::string write();

 private:
  bool coin(double share) { return random_.uniform() < share; }
  // True now and then, for a mistake that a legal scene does not have.
  bool mishap() { return !wildness_.legal && coin(0.001); }
  template <typename Type>
  const Type& one_of(std::span<const Type* const> types) {
    return *types[size_t(random_.below(int(types.size())))];
  }

  double extreme(const Key& key);
  double number(const Key& key);
  std::string numbers(const Key& key, int count);
  std::string direction();
  std::string value(const Key& key);
  std::string texture(const Key& key);
  std::string transform();
  std::string choice(const Key& key) {
    if (mishap()) return "\"nothing\"";
    return fmt::format("\"{}\"", key.choices[size_t(random_.below(int(key.choices.size())))]);
  }
  // A random shape that may be a part of a CSG object, unless it is open.
  const shapes::ShapeType& closed_shape() {
#define NAME(name, number) number,
    constexpr uint32_t kinds[] = {CLOSED_SHAPES(NAME)};
#undef NAME
    return *shapes::types()[kinds[random_.below(int(std::size(kinds)))]];
  }
  void table(const std::string& title, std::initializer_list<std::span<const Key>> keys,
             std::set<std::string_view> left_out, const std::string& given);

  Random& random_;
  const Wildness wildness_;
  std::vector<const reading::TextureType*> tables_;  // kinds of texture that have a table
  std::string text_;
};

double Writer::extreme(const Key& key) {
  double value = extremes[random_.below(int(std::size(extremes)))];
  if (coin(0.4)) value = -value;
  if (coin(0.1)) value = key.min;
  if (coin(0.1)) value = key.max;
  if (!wildness_.legal)
    return coin(0.2) ? std::array{inf, -inf, not_a_number}[size_t(random_.below(3))] : value;

  // Clamps the value to the key's range, and to the range of float32 arithmetic.
  const double low =
      std::max({key.min, key.type == KeyType::color || key.type == KeyType::texture ? 0.0 : -1e15, -1e15});
  const double high = std::min(key.max, 1e15);
  if (!(value >= low)) value = low;
  if (value > high) value = high;
  if (key.above_min && key.min >= 0) value = std::max(value, 1e-15);
  if (key.below_max && value == key.max) value = key.max * (1 - 1e-9);
  return value;
}

double Writer::number(const Key& key) {
  if (coin(wildness_.share)) return extreme(key);
  const bool share = key.type == KeyType::color || key.type == KeyType::texture;
  const double low = share ? 0 : std::max(key.min, -3.0);
  const double high = share ? 1 : key.max <= 1000 || key.min >= 3 ? key.max : 3;
  // Avoids both ends, which may be excluded or extreme, and the parts of wide ranges that would show little.
  if (key.name == "fov") return random_.uniform(20, 110);
  if (key.name == "turbulence") return random_.uniform(0, 2);
  return random_.uniform(low + (high - low) * 0.05, high - (high - low) * 0.02);
}

std::string Writer::numbers(const Key& key, int count) {
  std::vector<std::string> each;
  const double first = number(key);
  const bool same = coin(0.2 * wildness_.share);
  if (mishap()) ++count;
  for (int i = 0; i < count; ++i) each.push_back(fmt::format("{}", same ? first : number(key)));
  return fmt::format("[{}]", fmt::join(each, ", "));
}

// A vector along an axis, or nearly.
std::string Writer::direction() {
  Vec3 v(0);
  v[random_.below(3)] = coin(0.5) ? 1 : -1;
  if (coin(0.3)) v[random_.below(3)] += random_.log_uniform(1e-18, 1e-3);
  if (coin(0.3)) v *= random_.log_uniform(1e-14, 1e14);
  if (coin(0.05)) v = Vec3(0);
  return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

std::string Writer::texture(const Key& key) {
  if (coin(0.4)) return numbers(key, 3);
  if (coin(0.5)) return fmt::format("{}", number(key));
  const reading::TextureType& type = one_of(std::span<const reading::TextureType* const>(tables_));
  std::vector<std::string> values;
  for (Key own : type.keys) {
    if (own.type == KeyType::formula_file) continue;  // there is no file
    if (own.type == KeyType::formula) {
      values.push_back("code = \"vec3 color(vec2 uv) { return vec3(uv, 1.0 / uv.x); }\"");
      continue;
    }
    if (own.type == KeyType::color) own.max = std::min(own.max, key.max);
    if (own.fallback.empty() || coin(0.7)) values.push_back(fmt::format("{} = {}", own.name, value(own)));
  }
  return fmt::format("{{ {} = {{ {} }} }}", type.name, fmt::join(values, ", "));
}

std::string Writer::transform() {
  const Key any{.name = "", .type = KeyType::number, .doc = ""};
  std::vector<std::string> steps;
  for (int i = random_.below(3); i > 0; --i) {
    const int kind = random_.below(wildness_.share > 0 ? 5 : 4);
    if (kind == 0) steps.push_back(fmt::format("{{ translate = {} }}", numbers(any, 3)));
    if (kind == 1)
      steps.push_back(
          fmt::format("{{ rotate = {{ axis = {}, degrees = {} }} }}", numbers(any, 3), number(any) * 60));
    if (kind == 2) steps.push_back(fmt::format("{{ scale = {} }}", number(any)));
    if (kind == 3) steps.push_back(fmt::format("{{ scale = {} }}", numbers(any, 3)));
    if (kind == 4)
      steps.push_back(
          fmt::format("{{ matrix = [{}, {}, {}] }}", numbers(any, 4), numbers(any, 4), numbers(any, 4)));
  }
  return fmt::format("[{}]", fmt::join(steps, ", "));
}

std::string Writer::value(const Key& key) {
  if (mishap()) return coin(0.5) ? "\"word\"" : "[[]]";
  switch (key.type) {
    case KeyType::boolean:
      return coin(0.5) ? "true" : "false";
    case KeyType::integer: {
      constexpr int64_t whole[] = {0,         -1,       2, 7, 64, 65536, 65537, 4294967295, int64_t{1} << 53,
                                   INT64_MAX, INT64_MIN};
      const int64_t sane =
          key.name == "samples" ? 4 : int64_t(random_.uniform(key.min, std::min(key.max, 12.0)));
      if (!coin(wildness_.share)) return fmt::format("{}", sane);
      const int64_t wild = whole[random_.below(int(std::size(whole)))];
      return fmt::format("{}", wildness_.legal ? std::clamp(wild, int64_t(key.min), int64_t(key.max)) : wild);
    }
    case KeyType::number:
      return fmt::format("{}", number(key));
    case KeyType::string:
      return key.name == "material" ? fmt::format("\"m{}\"", random_.below(materials)) : "\"text\"";
    case KeyType::formula:
      return "\"float f(vec3 p) { return dot(p, p) - 0.25; }\"";
    case KeyType::formula_file:
      return "\"none.glsl\"";
    case KeyType::parameters:
      return "{}";
    case KeyType::choice:
      return choice(key);
    case KeyType::choice2:
      return fmt::format("[{}, {}]", choice(key), choice(key));
    case KeyType::vec2:
      return numbers(key, 2);
    case KeyType::vec3:
      return coin(0.5 * wildness_.share) ? direction() : numbers(key, 3);
    case KeyType::vec2_list:
      return fmt::format("[{}, {}, {}]", numbers(key, 2), numbers(key, 2), numbers(key, 2));
    case KeyType::vec3_list: {
      // As many points as in a Bézier patch, a bilinear patch, or a triangle.
      const int count = key.name == "points" ? 16 : key.name == "corners" ? 4 : 3;
      std::vector<std::string> points;
      for (int i = 0; i < count; ++i) points.push_back(numbers(key, 3));
      if (coin(0.3 * wildness_.share)) points[2] = points[size_t(random_.below(2))];
      if (mishap()) points[1] = "[]";
      return fmt::format("[{}]", fmt::join(points, ", "));
    }
    case KeyType::rows: {
      const auto columns = int(key.choices.size());
      return fmt::format("[{}, {}]", numbers(key, columns), numbers(key, columns));
    }
    case KeyType::outlines:
      return fmt::format("[[{}, {}, {}]]", numbers(key, 3), numbers(key, 3), numbers(key, 3));
    case KeyType::color:
      return coin(0.7) ? numbers(key, 3) : fmt::format("{}", number(key));
    case KeyType::color_map: {
      const Key color{.name = "", .type = KeyType::color, .doc = "", .min = key.min, .max = key.max};
      return fmt::format("[[0, {}], [1, {}]]", numbers(color, 3), numbers(color, 3));
    }
    case KeyType::texture:
      return texture(key);
    case KeyType::scale2:
      return coin(0.5) ? numbers(key, 2) : fmt::format("{}", number(key));
    case KeyType::scale3:
      return numbers(key, 3);
    case KeyType::transform:
      return transform();
    case KeyType::keyframes:
    case KeyType::rotation:
    case KeyType::matrix:
      return "[]";
  }
  return "";
}

void Writer::table(const std::string& title, std::initializer_list<std::span<const Key>> keys,
                   std::set<std::string_view> left_out, const std::string& given) {
  text_ += title + "\n" + given;
  for (const auto& list : keys) {
    for (const Key& key : list) {
      if (left_out.contains(key.name) && !mishap()) continue;
      const bool needed = !key.optional && key.fallback.empty();
      if (!coin(needed ? (wildness_.legal ? 1 : 0.999) : key.optional ? 0.3 : 0.7)) continue;
      text_ += fmt::format("{} = {}\n", key.name, value(key));
    }
  }
}

std::string Writer::write() {
  table("[image]", {loader::find_section("image")->keys}, {}, "");

  // The first type of camera is the most frequent.
  const double which = std::max(0.0, 1 - random_.uniform() / 0.3) * double(cameras::types().size() - 1);
  const cameras::CameraType& camera = *cameras::types()[size_t(std::ceil(which))];
  table("[camera]", {loader::find_section("camera")->keys, camera.keys}, {"type"},
        fmt::format("type = \"{}\"\n", camera.name));
  table("[render]", {loader::find_section("render")->keys}, {}, "");

  for (int i = random_.below(4); i > 0; --i) {
    // A light states its strength in one unit.
    std::set<std::string_view> left_out = {"type", "shape", "normals", "transform"};
    left_out.insert(coin(0.5) ? "lumens" : "candela");
    if (left_out.contains("candela")) left_out.insert("nits");
    if (coin(0.25)) {
      const std::span<const loader::AreaShape> forms = loader::area_shapes();
      const loader::AreaShape& form = forms[size_t(random_.below(int(forms.size())))];
      table("[[light]]", {form.section.keys, form.section.shape->keys}, left_out,
            fmt::format("type = \"area\"\nshape = \"{}\"\n", form.name));
      continue;
    }
    const lights::LightType& type = one_of(lights::types());
    table("[[light]]", {loader::find_section("light")->keys, type.keys}, left_out,
          fmt::format("type = \"{}\"\n", type.name));
  }
  for (int i = 0; i < materials; ++i) {
    const materials::MaterialType& type = one_of(materials::types());
    // Few shapes may have holes. The keys that bend a coat require a coat and each other. A conductor has one
    // of several keys.
    std::set<std::string_view> left_out;
    if (coin(0.9)) left_out = {"alpha", "alpha_cutoff", "coat_normal", "coat_normal_scale"};
    const bool conductor = type.name == "conductor";
    if (conductor) left_out.insert({"metal", "n", "k", "color"});
    table("[[material]]", {type.keys}, left_out,
          fmt::format("name = \"m{}\"\ntype = \"{}\"\n{}", i, type.name,
                      conductor ? "metal = \"gold\"\n" : ""));
  }
  for (int i = random_.below(6); i > 0; --i) {
    const shapes::ShapeType& type = one_of(shapes::types());
    // Half of all random normals point to the wrong side and are refused, so most triangles have none.
    std::set<std::string_view> mostly;
    if (coin(0.8)) mostly = {"normals"};
    // A sphere cannot have an uneven scale.
    if (coin(0.5)) mostly.insert("transform");
    // `given` writes the one formula of a shape, and never as the name of a file.
    mostly.insert({"code", "file", "ready", "lipschitz"});
    const auto given = [&](const shapes::ShapeType& shape) {
      if (shape.name != "implicit") return "";
      return coin(0.5) ? "ready = \"rounded-box\"\n"
                       : "code = \"float f(vec3 p) { return dot(p, p) - 0.25; }\"\nlipschitz = 4\n";
    };
    table(fmt::format("[[{}]]", type.name), {type.keys, loader::find_section(type.name)->keys}, mostly,
          given(type));
    if (!type.combine) continue;
    for (int part = 1 + random_.below(3); part > 0; --part) {
      const shapes::ShapeType& inner = closed_shape();
      const char* holder = part > 1 && coin(0.3) ? "csg.minus" : "csg";
      table(fmt::format("[[{}.{}]]", holder, inner.name), {inner.keys, loader::find_section("sphere")->keys},
            mostly, given(inner));
    }
  }
  return text_;
}

}  // namespace

std::string random_scene_text(Random& random, const Wildness& wildness) {
  return Writer(random, wildness).write();
}

}  // namespace eyeray::engine::test
