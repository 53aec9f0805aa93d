#include "host/loader/keyframes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "host/core/vec.hpp"
#include "host/reading/source_position.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {
namespace {

using Quaternion = glm::dquat;

struct Keyframe {
  double frame;
  const toml::node* value;
};

bool is_number(const toml::node& node) {
  return node.is_integer() || node.is_floating_point();
}

// The number as TOML text, which a reader turns back into a number of the same kind and value.
std::string number_text(double value, bool integer) {
  if (integer && value == std::floor(value) && std::abs(value) < 0x1p53) return fmt::format("{:.0f}", value);
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

// The key in quotes. The keys in tables of transforms and textures need no escapes.
std::string key_text(std::string_view key) {
  return fmt::format("\"{}\"", key);
}

// The value itself as TOML text.
std::string unchanged(const toml::node& node) {
  if (is_number(node)) return number_text(node.value_or(0.0), node.is_integer());
  if (node.is_boolean()) return node.value_or(false) ? "true" : "false";
  if (const toml::array* array = node.as_array()) {
    std::vector<std::string> elements;
    for (const toml::node& element : *array) elements.push_back(unchanged(element));
    return fmt::format("[{}]", fmt::join(elements, ", "));
  }
  std::vector<std::string> entries;
  for (const auto& [key, value] : *node.as_table())
    entries.push_back(fmt::format("{} = {}", key_text(key.str()), unchanged(value)));
  return fmt::format("{{ {} }}", fmt::join(entries, ", "));
}

// A rotation from a table { axis = [x, y, z], degrees = a } of numbers.
struct Rotation {
  Vec3 axis;
  double degrees;

  Quaternion quaternion() const { return glm::angleAxis(glm::radians(degrees), glm::normalize(axis)); }
};

std::optional<Rotation> as_rotation(const toml::node& node) {
  const toml::table* table = node.as_table();
  if (!table || table->size() != 2) return std::nullopt;
  const toml::node *axis = table->get("axis"), *degrees = table->get("degrees");
  const toml::array* list = axis ? axis->as_array() : nullptr;
  if (!list || list->size() != 3 || !degrees || !is_number(*degrees)) return std::nullopt;
  Rotation rotation{Vec3(0), degrees->value_or(0.0)};
  for (int i = 0; i < 3; ++i) {
    if (!is_number(*list->get(size_t(i)))) return std::nullopt;
    rotation.axis[i] = list->get(size_t(i))->value_or(0.0);
  }
  if (!(glm::length(rotation.axis) > 0)) return std::nullopt;
  return rotation;
}

// Values at four successive keyframes. The result lies between the middle two. A missing outer value is null.
using Four = std::array<const toml::node*, 4>;

class Between {
 public:
  Between(const std::array<double, 4>& frames, double frame, Curve curve, DiagnosticLog& log)
      : frames_(frames), share_((frame - frames[1]) / (frames[2] - frames[1])), curve_(curve), log_(log) {}

  // True if all values so far could be interpolated: no two had different forms.
  bool sound() const { return sound_; }

  std::string text(const Four& values) {
    const toml::node &from = *values[1], &to = *values[2];
    if (is_number(from) && is_number(to)) return number(values);
    const auto start = as_rotation(from), end = as_rotation(to);
    if (start && end &&
        glm::length(glm::cross(start->axis, end->axis)) >
            1e-9 * glm::length(start->axis) * glm::length(end->axis))
      return rotation(*start, *end);
    if (from.is_array() && to.is_array() && from.as_array()->size() == to.as_array()->size())
      return list(values);
    if (from.is_table() && to.is_table()) return table(values);
    if (from.is_boolean() && to.is_boolean() && from.value_or(false) == to.value_or(false))
      return unchanged(from);
    return unlike(to);
  }

 private:
  std::string unlike(const toml::node& node) {
    sound_ = false;
    log_.error(reading::position_of(node.source()),
               "this value has another form than that of the keyframe before it, so the two cannot be "
               "interpolated; curve = \"step\" jumps");
    return "0";
  }

  std::string number(const Four& values) const {
    const double from = values[1]->value_or(0.0), to = values[2]->value_or(0.0);
    double value = from + (to - from) * share_;
    if (curve_ == Curve::smooth) {
      const double length = frames_[2] - frames_[1], straight = (to - from) / length;
      const auto slope = [&](const toml::node* outer, double outer_frame, double inner, double inner_frame) {
        if (!outer || !is_number(*outer)) return straight;
        return (inner - outer->value_or(0.0)) / (inner_frame - outer_frame);
      };
      // Evaluate the cubic in Hermite's form.
      const double a = length * slope(values[0], frames_[0], to, frames_[2]);
      const double b = length * slope(values[3], frames_[3], from, frames_[1]);
      const double t = share_;
      value = from + t * (a + t * (3 * (to - from) - 2 * a - b + t * (2 * (from - to) + a + b)));
    }
    return number_text(value, values[1]->is_integer() && values[2]->is_integer());
  }

  std::string rotation(const Rotation& from, const Rotation& to) const {
    const Quaternion turned = glm::slerp(from.quaternion(), to.quaternion(), share_);
    const double degrees = glm::degrees(glm::angle(turned));
    const Vec3 axis = glm::axis(turned);
    return fmt::format("{{ axis = [{}, {}, {}], degrees = {} }}", number_text(axis.x, false),
                       number_text(axis.y, false), number_text(axis.z, false), number_text(degrees, false));
  }

  std::string list(const Four& values) {
    std::vector<std::string> elements;
    const size_t count = values[1]->as_array()->size();
    for (size_t i = 0; i < count; ++i) {
      Four inner{};
      for (size_t k = 0; k < 4; ++k) {
        const toml::array* array = values[k] ? values[k]->as_array() : nullptr;
        inner[k] = array && array->size() == count ? array->get(i) : nullptr;
      }
      elements.push_back(text(inner));
    }
    return fmt::format("[{}]", fmt::join(elements, ", "));
  }

  std::string table(const Four& values) {
    std::vector<std::string> entries;
    const toml::table &from = *values[1]->as_table(), &to = *values[2]->as_table();
    for (const auto& [key, value] : from) {
      Four inner{};
      for (size_t k = 0; k < 4; ++k) {
        const toml::table* table = values[k] ? values[k]->as_table() : nullptr;
        inner[k] = table ? table->get(key.str()) : nullptr;
      }
      if (from.size() != to.size() || !inner[2]) return unlike(to);
      entries.push_back(fmt::format("{} = {}", key_text(key.str()), text(inner)));
    }
    return fmt::format("{{ {} }}", fmt::join(entries, ", "));
  }

  const std::array<double, 4> frames_;
  const double share_;
  const Curve curve_;
  DiagnosticLog& log_;
  bool sound_ = true;
};

// A part of the node that cannot be animated, or null. Such a part is a string, which may name a file or be a
// formula, a date, or a key that no scene has.
const toml::node* immovable(const toml::node& node) {
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array)
      if (const toml::node* found = immovable(element)) return found;
    return nullptr;
  }
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table) {
      if (key.str().find_first_of("\"\\\n") != std::string_view::npos) return &value;
      if (const toml::node* found = immovable(value)) return found;
    }
    return nullptr;
  }
  return is_number(node) || node.is_boolean() ? nullptr : &node;
}

// Reads a list of keyframes; nothing after an error.
std::optional<std::vector<Keyframe>> read(const toml::array& list, DiagnosticLog& log) {
  std::vector<Keyframe> keyframes;
  for (const toml::node& node : list) {
    const toml::array* pair = node.as_array();
    if (!pair || pair->size() != 2 || !is_number(*pair->get(0))) {
      log.error(reading::position_of(node.source()), "a keyframe must be a pair [frame, value]");
      return std::nullopt;
    }
    const double frame = pair->get(0)->value_or(0.0);
    if (!(std::abs(frame) <= most_frames)) {
      log.error(reading::position_of(pair->get(0)->source()),
                fmt::format("a frame must be a number from -{0} to {0}", int(most_frames)));
      return std::nullopt;
    }
    if (!keyframes.empty() && !(frame > keyframes.back().frame)) {
      log.error(reading::position_of(pair->get(0)->source()),
                fmt::format("keyframes must be in order of their frames: {} is not after {}", frame,
                            keyframes.back().frame));
      return std::nullopt;
    }
    if (const toml::node* fixed = immovable(*pair->get(1))) {
      log.error(reading::position_of(fixed->source()),
                "an animated value can be a number, true or false, or a list or table of these");
      return std::nullopt;
    }
    keyframes.push_back({frame, pair->get(1)});
  }
  return keyframes;
}

}  // namespace

std::optional<std::string> value_between(const toml::array& list, double frame, Curve curve,
                                         DiagnosticLog& log) {
  const auto keyframes = read(list, log);
  if (!keyframes || keyframes->empty()) return std::nullopt;
  size_t before = 0;
  while (before + 1 < keyframes->size() && (*keyframes)[before + 1].frame <= frame) ++before;
  const size_t last = keyframes->size() - 1;
  if (before == last || frame <= keyframes->front().frame || curve == Curve::step)
    return unchanged(*(*keyframes)[before].value);

  Four values{};
  std::array<double, 4> frames{};
  for (size_t k = 0; k < 4; ++k) {
    if (before + k < 1 || before + k - 1 > last) continue;
    values[k] = (*keyframes)[before + k - 1].value;
    frames[k] = (*keyframes)[before + k - 1].frame;
  }
  Between between(frames, frame, curve, log);
  std::string text = between.text(values);
  return between.sound() ? std::optional(text) : std::nullopt;
}

}  // namespace eyeray::engine::loader
