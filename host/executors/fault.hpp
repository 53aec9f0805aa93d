// Faults put into the GPU's side alone, on purpose: the proof that `verify` turns red (tests/must_fail). Not
// for users.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "host/core/pixel.hpp"
#include "host/records/packer.hpp"

namespace eyeray::executors {

class Fault {
 public:
  // "" is none. Error (bad_input) that lists the known names otherwise.
  explicit Fault(std::string name);

  bool is(std::string_view name) const { return name_ == name; }
  // ior: every medium's index is off by 5 %; light: the first light is dark.
  void damage(PackedScene& scene) const;
  // near_root: a sphere's near root even behind the ray; normal: all normals flipped; ids: neighbours' ids
  // swapped; steps: too few for many rays to find a superellipsoid.
  std::string damage(std::string_view file, std::string text) const;
  // nan: one pixel is no number; black: all pixels are black.
  void damage(std::span<PixelSample> samples) const;
  // shift: the picture moves by one pixel. (And contraction: the executor leaves out the float policy.)
  uint32_t shift() const { return is("shift") ? 1 : 0; }

 private:
  std::string name_;
};

}  // namespace eyeray::executors
