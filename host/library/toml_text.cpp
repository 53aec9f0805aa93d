// Values and tables as TOML: strings are escaped, and numbers have the shortest text that is read back
// the same.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

#include "host/core/escaped_text.hpp"
#include "host/library/toml_text.hpp"

namespace eyeray::engine::library {
namespace {

std::string list_of(const v0::Value* begin, const v0::Value* end) {
  std::string text = "[";
  for (const v0::Value* each = begin; each != end; ++each) text += (each == begin ? "" : ", ") + each->toml();
  return text + "]";
}

bool is_bare(std::string_view key) {
  return !key.empty() && std::ranges::all_of(key, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

}  // namespace

std::string key_text(std::string_view key) {
  return is_bare(key) ? std::string(key) : toml_string(key);
}

std::string lines(const v0::Table& table) {
  std::string text;
  for (const auto& [key, value] : table.entries()) text += key_text(key) + " = " + value.toml() + "\n";
  return text;
}

}  // namespace eyeray::engine::library

namespace eyeray::inline v0 {

// to_chars writes the shortest text that is read back the same. A text without point and exponent, such
// as "3" for 3.0, is read as an integer, which keys for numbers accept as well as keys for integers.
std::string Value::of_floating(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  return {text, end};
}

std::string Value::of_signed(int64_t value) {
  return std::to_string(value);
}

std::string Value::of_unsigned(uint64_t value) {
  if (value > uint64_t(std::numeric_limits<int64_t>::max()))
    throw Error(
        ErrorKind::bad_input,
        fmt::format("{} is too large for a scene: the largest integer is 9223372036854775807", value));
  return std::to_string(value);
}

std::string Value::quoted(std::string_view text) {
  return engine::toml_string(text);
}

Value::Value(std::initializer_list<Value> list) : toml_(engine::library::list_of(list.begin(), list.end())) {}
Value::Value(const std::vector<Value>& list)
    : toml_(engine::library::list_of(list.data(), list.data() + list.size())) {}
Value::Value(const Table& table) : toml_("{ ") {
  for (const auto& [key, value] : table.entries())
    toml_ += (toml_.size() > 2 ? ", " : "") + engine::library::key_text(key) + " = " + value.toml();
  toml_ += " }";
}

Table& Table::set(std::string_view key, const Value& value) {
  entries_.emplace_back(key, value);
  return *this;
}

}  // namespace eyeray::inline v0
