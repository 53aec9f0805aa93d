#include <algorithm>
#include <cmath>

#include "host/core/error.hpp"
#include "host/reading/value.hpp"

namespace eyeray::engine::reading {

TexturePtr plain_texture(const Vec3& color, const ValueSources& sources) {
  const auto plain = std::ranges::find_if(sources.textures, &TextureType::of_color);
  CHECK(plain != sources.textures.end());
  return (*plain)->of_color(color);
}

Value stand_in(const Key& key, const ValueSources& sources) {
  // Take the number in the key's range that is nearest to 1.
  const double low = key.above_min ? std::nextafter(key.min, Key::inf) : key.min;
  const double high = key.below_max ? std::nextafter(key.max, -Key::inf) : key.max;
  const double number = std::clamp(1.0, low, high);
  switch (key.type) {
    case KeyType::boolean:
      return false;
    case KeyType::integer:
      return static_cast<int64_t>(number);
    case KeyType::number:
      return number;
    case KeyType::string:
      return std::string();
    case KeyType::choice:
      return int64_t{0};
    case KeyType::choice2:
      return std::array<int64_t, 2>{};
    case KeyType::vec2:
    case KeyType::scale2:
      return Vec2(number);
    case KeyType::vec3:
    case KeyType::color:
    case KeyType::scale3:
      return Vec3(number);
    case KeyType::vec2_list:
      return std::vector<Vec2>();
    case KeyType::vec3_list:
      return std::vector<Vec3>();
    case KeyType::color_map:
      return std::vector<Vec4>();
    case KeyType::keyframes:
      return true;
    case KeyType::outlines:
      return std::vector<std::vector<Vec3>>();
    case KeyType::rows:
      return std::vector<std::vector<double>>();
    case KeyType::formula:
    case KeyType::formula_file:
      return formula::FormulaText();
    case KeyType::parameters:
      return std::vector<formula::FormulaParameter>();
    case KeyType::texture:
      return plain_texture(Vec3(number), sources);
    case KeyType::transform:
    case KeyType::rotation:
    case KeyType::matrix:
      return Mat4(1.0);
  }
  return false;
}

}  // namespace eyeray::engine::reading
