#include <eyeray/eyeray.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace eyeray::inline v0 {

// Copies of an exception must not throw, so they share the diagnostics.
Error::Error(ErrorKind kind, const std::string& what, std::vector<Diagnostic> diagnostics)
    : std::runtime_error(what),
      kind_(kind),
      diagnostics_(std::make_shared<const std::vector<Diagnostic>>(std::move(diagnostics))) {}

Error::~Error() = default;

std::string_view version() noexcept {
  return EYERAY_VERSION;
}

}  // namespace eyeray::inline v0
