// Choices for people who measure: how kernels are made and how they find hits. No choice changes a pixel.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace eyeray::engine::executors {

struct ExecutorOptions;

struct Tuning {
  std::string_view key;
  std::vector<std::string_view> values;
  std::string_view text;  // its effect, for people
  void (*choose)(ExecutorOptions& options, std::string_view value);
};
std::span<const Tuning> tunings();

// Applies a setting such as "rays=lanes". Error (bad_input) for an unknown key or value.
void tune(ExecutorOptions& options, std::string_view setting);

}  // namespace eyeray::engine::executors
