// Faults put into the GPU's side alone, on purpose: the proof that `verify` turns red (tests/must_fail). Not
// for users.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "host/core/pixel.hpp"
#include "host/records/packer.hpp"

namespace eyeray::executors {

struct FaultType;

// docs/verification.md says what each fault does, and what the report says of it.
class Fault {
 public:
  // "" is none. Error (bad_input) that lists the known names otherwise.
  explicit Fault(const std::string& name);

  void damage(records::PackedScene& scene) const;
  // The text of a shader file.
  std::string damage(std::string_view file, std::string text) const;
  // What was read back.
  void damage(std::span<PixelSample> samples) const;
  // How many pixels the picture moves by.
  uint32_t shift() const;
  // Whether the driver may contract a·b + c.
  bool contracts() const;

 private:
  const FaultType* type_ = nullptr;  // null: none
};

}  // namespace eyeray::executors
