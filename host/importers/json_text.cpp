#include "host/importers/json_text.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_set>
#include <vector>

#include "host/core/json_depth.hpp"
#include "host/importers/malformed.hpp"

namespace eyeray::engine::importers {

namespace {

// Limit on the values of a text: a tree of so many values takes about 1 GiB.
constexpr size_t most_values = size_t{1} << 24;

// An object or a list whose closing bracket has not come yet.
struct Level {
  bool object;
  bool key_is_next;
  std::unordered_set<std::string> keys = {};
};

// The index of the closing quote of the string that begins at `i`, or the end of the text.
size_t end_of_string(std::string_view text, size_t i) {
  for (++i; i < text.size() && text[i] != '"'; ++i) i += text[i] == '\\';
  return std::min(i, text.size());
}

// The value of the string whose quotes are at `first` and `last`: "\u0061" is "a".
std::string value_of_string(std::string_view text, size_t first, size_t last) {
  const std::string_view inner = text.substr(first + 1, last - first - 1);
  if (inner.find('\\') == std::string_view::npos) return std::string(inner);
  const auto value = nlohmann::json::parse(text.substr(first, last - first + 1), nullptr, false);
  return value.is_string() ? value.get<std::string>() : std::string(inner);
}

}  // namespace

void check_json_text(std::string_view text, const std::string& file) {
  const auto fail = [&](size_t at, const std::string& message) {
    throw malformed_at(file, text, at, message);
  };
  std::vector<Level> open;
  size_t values = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    switch (text[i]) {
      case '"': {
        const size_t first = i;
        i = end_of_string(text, first);
        if (open.empty() || !open.back().key_is_next) break;
        open.back().key_is_next = false;
        const auto [key, fresh] = open.back().keys.insert(value_of_string(text, first, i));
        if (!fresh) fail(first, fmt::format("an object has the key \"{}\" twice", *key));
        break;
      }
      case '[':
      case '{':
        if (open.size() == deepest_json)
          fail(i, fmt::format("its JSON is nested more than {} deep", deepest_json));
        open.push_back({text[i] == '{', text[i] == '{'});
        ++values;
        break;
      case ']':
      case '}':
        if (!open.empty()) open.pop_back();
        break;
      case ',':
        if (++values > most_values) fail(i, fmt::format("its JSON has more than {} values", most_values));
        if (!open.empty()) open.back().key_is_next = open.back().object;
        break;
      default:
        break;
    }
  }
}

}  // namespace eyeray::engine::importers
