// A buffer in a few numbers.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/compute/type.hpp"

namespace eyeray::engine::compute {

// The numbers of one kind in a buffer; those of a structure with several kinds are taken together.
struct Summary {
  std::string type;  // "float[4096]"
  uint64_t numbers = 0;
  uint64_t nan = 0;
  std::optional<double> min{}, max{}, mean{};  // all of finite numbers alone
  std::vector<std::string> first{};            // the first numbers
};

Summary summarise(const Type& block, std::span<const std::byte> bytes);
// "float[4096]: min 0.1, max 0.9, mean 0.5; 0.25, 0.5, …"
std::string to_text(const Summary& summary);

}  // namespace eyeray::engine::compute
