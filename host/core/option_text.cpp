#include "host/core/option_text.hpp"

#include <fmt/format.h>

#include <atomic>

namespace eyeray::engine {
namespace {

std::atomic<bool> to_library = false;
std::atomic<bool> has_backends = false;

}  // namespace

OptionBackends::OptionBackends() {
  has_backends = true;
}
OptionBackends::~OptionBackends() {
  has_backends = false;
}

std::string option_text(std::string_view name) {
  if (name == "backend" && has_backends) name = "backends";
  if (!to_library) return fmt::format("--{}", name);
  return fmt::format("`{}`", name == "allow-path"    ? "allowed_folders"
                             : name == "no-formulas" ? "formulas"
                                                     : name);
}

std::string option_text(std::string_view name, std::string_view value) {
  return fmt::format("{} {}", option_text(name), value);
}

void speak_to_library() {
  to_library = true;
}

}  // namespace eyeray::engine
