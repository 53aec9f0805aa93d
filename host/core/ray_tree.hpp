// The rays of one sample of a pixel, and the values that were recorded along them: `eyeray probe` compares
// these.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine {

// `pixel` is no ray: it holds the values that belong to no ray.
enum class RayKind : uint32_t { pixel, eye, reflected, refracted, shadow };

struct ProbedValue {
  enum class Type { real, integer, boolean };

  std::string name;
  Type type = Type::real;
  int size = 1;                     // components
  std::array<double, 4> numbers{};  // float32 is widened exactly, −0 is 0; a truth is 0 or 1
  uint32_t line = 0;                // line of the shader file that recorded it; 0: no shader did
  std::string file = {};            // the shader file; "" where unknown
};

struct ProbedRay {
  RayKind kind = RayKind::pixel;
  uint32_t number = 0;  // a shadow ray's light
  size_t parent = 0;    // index in RayTree::rays, less than this ray's; the pixel is its own parent
  size_t index = 0;     // number of the parent's values that come before this ray
  std::vector<ProbedValue> values = {};
};

struct RayTree {
  std::vector<ProbedRay> rays = {{}};  // the pixel first; the others in the order in which they were traced
  uint64_t lost = 0;                   // values and rays beyond RayRecorder::most
};

// Builds the tree from events, which it receives in order of time.
class RayRecorder {
 public:
  // Limit on the rays and values that are kept.
  static constexpr uint32_t most = 1 << 17;

  // From here on values belong to a new ray. `depth` counts reflections and refractions. The parent of a
  // reflected or refracted ray is the last ray of depth − 1; a shadow ray's is the last ray of `depth`.
  void ray(RayKind kind, uint32_t number, uint32_t depth);
  // From here on values belong to the last ray of `depth` again, or to the pixel if there is no such ray.
  void back(uint32_t depth);
  void value(ProbedValue value);
  void lose(uint64_t count) { tree_.lost += count; }

  // A number, a truth or a vector of numbers.
  template <typename T>
  void value(std::string_view name, uint32_t line, const T& v) {
    ProbedValue value{.name = std::string(name), .line = line};
    if constexpr (std::is_arithmetic_v<T>) {
      value.numbers[0] = double(v);
      if (std::is_integral_v<T>) value.type = ProbedValue::Type::integer;
      if (std::is_same_v<T, bool>) value.type = ProbedValue::Type::boolean;
    } else {
      value.size = T::length();
      for (int i = 0; i < value.size; ++i) value.numbers[size_t(i)] = double(v[i]);
    }
    this->value(std::move(value));
  }

  RayTree& tree() { return tree_; }

 private:
  bool has_room();

  RayTree tree_;
  std::vector<size_t> last_of_depth_;
  size_t current_ = 0;
  uint32_t kept_ = 0;
};

}  // namespace eyeray::engine
