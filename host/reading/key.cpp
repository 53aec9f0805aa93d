#include "host/reading/key.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "host/scene/texture_rows.hpp"

namespace eyeray::engine::reading {

namespace {

// The shortest text of a number: 1e12, 65536, 0.001.
std::string show(double value) {
  std::string text = fmt::format("{:g}", value);
  if (std::stod(text) != value) return fmt::format("{}", value);
  if (const size_t plus = text.find("e+"); plus != std::string::npos) text.erase(plus + 1, 1);
  return text;
}

// The range of a key as text; "" if every number is allowed. Examples: " above 0 and below 180",
// " above 0, at most 64", " from 0 to below 90", " from 1 to 65536", " of at least 0".
std::string describe_range(const Key& key) {
  const bool low = std::isfinite(key.min), high = std::isfinite(key.max);
  const std::string min = low ? show(key.min) : "", max = high ? show(key.max) : "";
  if (low && high) {
    const std::string_view text = key.above_min
                                      ? (key.below_max ? " above {} and below {}" : " above {}, at most {}")
                                      : (key.below_max ? " from {} to below {}" : " from {} to {}");
    return fmt::format(fmt::runtime(text), min, max);
  }
  if (low) return (key.above_min ? " above " : " of at least ") + min;
  if (high) return (key.below_max ? " below " : " of at most ") + max;
  return "";
}

std::string each(const Key& key) {
  std::string range = describe_range(key);
  if (range.starts_with(" of ")) range.erase(0, 3);
  return range.empty() ? "" : ", each" + range;
}

std::string describe_choices(std::span<const std::string_view> choices) {
  std::string text;
  for (size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) text += i + 1 == choices.size() ? " or " : ", ";
    text += fmt::format("\"{}\"", choices[i]);
  }
  return text;
}

// The values of a texture key as text, such as
// "a color [r, g, b], one number for all three, { checker = … } or { image = … }".
std::string describe_textures() {
  std::string text = "a color [r, g, b], one number for all three", last;
  for (const TextureRow& row : texture_rows) {
    if (!row.varies) continue;
    if (!last.empty()) text += ", " + last;
    last = fmt::format("{{ {} = … }}", row.name);
  }
  return text + " or " + last;
}

}  // namespace

std::string describe(const Key& declared) {
  Key key = declared;
  if (key.type == KeyType::color || key.type == KeyType::texture) key.min = std::max(key.min, 0.0);
  switch (key.type) {
    case KeyType::boolean:
      return "true or false";
    case KeyType::integer:
      return "an integer" + describe_range(key);
    case KeyType::number:
      return "a number" + describe_range(key) + (key.word.empty() ? "" : fmt::format(" or \"{}\"", key.word));
    case KeyType::string:
      return "a string";
    case KeyType::choice:
      return describe_choices(key.choices);
    case KeyType::choice2:
      return describe_choices(key.choices) + ", or two of them [u, v]";
    case KeyType::vec2:
      return "two numbers [x, y]" + each(key);
    case KeyType::vec3:
      return "three numbers [x, y, z]" + each(key);
    case KeyType::vec2_list:
      return "a list of points [[x, y], …]" + each(key);
    case KeyType::vec3_list:
      return "a list of points [[x, y, z], …]" + each(key);
    case KeyType::outlines:
      return "a list of lists of points [[[x, y, z], …], …]" + each(key);
    case KeyType::rows:
      return fmt::format("a list of rows [[{}], …]", fmt::join(key.choices, ", ")) + each(key);
    case KeyType::formula:
      return "GLSL in a string";
    case KeyType::formula_file:
      return "the name of a file";
    case KeyType::parameters:
      return "a table { NAME = number or [2 to 4 numbers], … }";
    case KeyType::color_map:
      return "a list of colors [[t, color], …], t rising from 0 to 1 at most";
    case KeyType::keyframes:
      return "a list of keyframes [[frame, value], …], frames rising";
    case KeyType::color:
      return "a color [r, g, b] or one number for all three" + each(key);
    case KeyType::texture:
      return describe_textures() + each(key);
    case KeyType::scale2:
      return "two numbers [u, v] or one for both" + each(key);
    case KeyType::scale3:
      return "three numbers [x, y, z] or one for all" + each(key);
    case KeyType::transform:
      return "a list of steps such as { translate = [x, y, z] }";
    case KeyType::rotation:
      return "{ axis = [x, y, z], degrees = a }";
    case KeyType::matrix:
      return "three rows of four numbers [[…], […], […]]";
  }
  return "";
}

}  // namespace eyeray::engine::reading
