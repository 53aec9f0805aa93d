// Constants of shaders that a person moves while viewing the picture:
//
//   const float WIDTH = 0.5f;              // @slider 0 1
//   const int COUNT = 3;                   // @slider 1 16
//   const vec3 TINT = vec3(1, 0.5f, 0.2f); // @color
//   const bool STRIPES = true;             // @checkbox
//
// Kernels read them from a buffer, so that another value needs no other kernel. Where one must be a constant,
// as an array's size must, its value is written into the text instead.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine::executors {

struct Tunable {
  enum class Type { floating, integer, boolean, vector };
  using Value = std::array<double, 3>;  // of which a vector has three

  std::string id;  // "shapes/sphere.glsl:WIDTH"
  std::string file, name;
  int line = 0;
  Type type = Type::floating;
  double low = 0, high = 1;  // of a slider
  Value written{};           // in the text
};

class Tunables {
 public:
  static constexpr size_t most = 64;

  // The text with its tunables read from the buffer, or, once `as_constants`, written as they are chosen;
  // line by line as before. What looks like one and is none stays as it is.
  std::string apply(const std::string& file, std::string_view text);
  // Forgets which there are, but not the values chosen: before the texts are read anew.
  void begin();
  bool as_constants = false;

  // All that were seen since begin().
  const std::vector<Tunable>& found() const { return found_; }
  // Values by id; where nothing is chosen, the written value counts. Returns whether that changes anything.
  bool choose(std::map<std::string, Tunable::Value> values);
  // The number of the choice: executors compare it before they sample.
  uint64_t choice() const { return choice_; }
  bool any_chosen() const { return !chosen_.empty(); }
  Tunable::Value value(const Tunable& tunable) const;
  // BINDING_TUNABLES's buffer.
  std::array<std::array<float, 4>, most> records() const;

 private:
  size_t place_of(const std::string& id);

  std::vector<Tunable> found_;
  std::map<std::string, Tunable::Value> chosen_;
  uint64_t choice_ = 0;
  std::vector<std::string> places_;  // ids, as they lie in the buffer: once given, for ever
};

}  // namespace eyeray::engine::executors
