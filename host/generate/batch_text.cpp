#include "host/generate/batch_text.hpp"

#include <fmt/format.h>

#include <iterator>

namespace eyeray::engine::generate {

BatchText::BatchText(std::string_view table, std::string common, const std::vector<std::string_view>& keys)
    : table_(table), common_(std::move(common)) {
  for (const std::string_view key : keys) lists_.push_back({key, ""});
}

void BatchText::append(std::string& text, double number) {
  fmt::format_to(std::back_inserter(text), "{}", number);
}

void BatchText::append(std::string& text, const std::string& name) {
  fmt::format_to(std::back_inserter(text), "\"{}\"", name);
}

void BatchText::append(std::string& text, const Vec3& point) {
  fmt::format_to(std::back_inserter(text), "[{},{},{}]", point.x, point.y, point.z);
}

void BatchText::append(std::string& text, std::span<const Vec3> points) {
  char between = '[';
  for (const Vec3& point : points) {
    text += between;
    append(text, point);
    between = ',';
  }
  text += ']';
}

std::string BatchText::text() const {
  if (lists_.front().values.empty()) return "";
  std::string text = fmt::format("\n[[{}]]\n{}batch = {{", table_, common_);
  std::string_view before = " ";
  for (const List& list : lists_) {
    fmt::format_to(std::back_inserter(text), "{}{} = [\n{}]", before, list.key, list.values);
    before = ", ";
  }
  return text + " }\n";
}

}  // namespace eyeray::engine::generate
