#include "host/compare/buffer_result.hpp"

#include <fmt/format.h>

namespace eyeray::engine::compare {
namespace {

std::string counts(const BufferResult& result) {
  std::string text = fmt::format("{} of {} numbers differ", result.different, result.numbers);
  if (result.different == 0) return text;
  if (result.largest > 0) text += fmt::format(", by at most {} ULP", result.largest);
  if (result.ulp > 0) text += fmt::format(" (allowed: {})", result.ulp);
  if (result.absolute > 0) text += fmt::format(", and {} by more than {}", result.beyond, result.absolute);
  return text;
}

}  // namespace

std::string to_text(const BufferResult& result) {
  return fmt::format("gate {} {} {} = {}, {}: {}", result.gate, result.passes() ? "passed" : "FAILED",
                     result.value, result.other, result.buffer,
                     result.incomparable.empty() ? counts(result) : result.incomparable);
}

std::string failure_of(const BufferResult& result) {
  return fmt::format("gate {}: {} and {}, {}: {}", result.gate, result.value, result.other, result.buffer,
                     result.incomparable.empty()
                         ? fmt::format("{}; the first is {}", counts(result), result.first)
                         : result.incomparable);
}

}  // namespace eyeray::engine::compare
