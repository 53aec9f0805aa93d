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

// `pixel`: no ray; values that belong to no ray belong to it.
enum class RayKind : uint32_t { pixel, eye, reflected, refracted, shadow };

struct ProbedValue {
  enum class Type { real, integer, boolean };

  std::string name;
  Type type = Type::real;
  int size = 1;                     // components
  std::array<double, 4> numbers{};  // float32 is widened exactly, −0 is 0; a truth is 0 or 1
  uint32_t line = 0;                // of the shader's file that looked; 0: no shader did
  std::string file = {};            // which; "" where unknown
};

struct ProbedRay {
  RayKind kind = RayKind::pixel;
  uint32_t number = 0;  // of a shadow ray its light
  size_t parent = 0;    // in RayTree::rays, before this one; the pixel's own is itself
  size_t place = 0;     // how many of the parent's values come before this ray
  std::vector<ProbedValue> values = {};
};

struct RayTree {
  std::vector<ProbedRay> rays = {{}};  // the pixel first; the others in the order in which they were traced
  uint64_t lost = 0;                   // values and rays beyond RayRecorder::most
};

// Makes the tree of the events that it gets, in order of time.
class RayRecorder {
 public:
  // Rays and values that are kept.
  static constexpr uint32_t most = 1 << 17;

  // From here on values belong to a new ray. A reflected or refracted one comes from the last ray with one
  // reflection or refraction less than `depth`, a shadow ray from the last with as many.
  void ray(RayKind kind, uint32_t number, uint32_t depth);
  // From here on they belong to the last ray of `depth` again, beyond every depth to the pixel.
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
