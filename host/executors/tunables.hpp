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
  using Value = std::array<double, 3>;  // a vector uses all three

  std::string id;  // "shapes/sphere.glsl:WIDTH"
  std::string file, name;
  int line = 0;
  Type type = Type::floating;
  double low = 0, high = 1;  // range of a slider
  Value written{};           // in the text
};

class Tunables {
 public:
  static constexpr size_t most = 64;

  // The text with its tunables read from the buffer; if `as_constants`, with their chosen values written in.
  // No line moves. A declaration that only resembles a tunable stays unchanged.
  std::string apply(const std::string& file, std::string_view text);
  // Forgets the tunables found, but not the values chosen. Call it before the texts are read again.
  void begin();
  bool as_constants = false;

  // All tunables found since begin().
  const std::vector<Tunable>& found() const { return found_; }
  // Chooses values, by id. A tunable without a chosen value keeps the one written in the text. Returns true
  // if this changes any choice.
  bool choose(std::map<std::string, Tunable::Value> values);
  // The number of the present choice. Executors compare it before they sample.
  uint64_t choice() const { return choice_; }
  bool any_chosen() const { return !chosen_.empty(); }
  Tunable::Value value(const Tunable& tunable) const;
  // The contents of BINDING_TUNABLES's buffer.
  std::array<std::array<float, 4>, most> records() const;

 private:
  size_t index_of(const std::string& id);

  std::vector<Tunable> found_;
  std::map<std::string, Tunable::Value> chosen_;
  uint64_t choice_ = 0;
  std::vector<std::string> ids_;  // ids by position in the buffer; a position never changes
};

}  // namespace eyeray::engine::executors
