// Bounds the depth of JSON before a tree is made of it: copying, printing and destroying a tree recurse.
#pragma once

#include <cstddef>
#include <string_view>

namespace eyeray::engine {

constexpr size_t deepest_json = 64;

// The text; or "", which no parser accepts, if the brackets are nested deeper than `deepest_json`.
inline std::string_view unless_too_deep(std::string_view text) {
  size_t depth = 0;
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"')
      in_string = !in_string;
    else if (in_string)
      i += c == '\\';
    else if ((c == '[' || c == '{') && ++depth > deepest_json)
      return {};
    else if ((c == ']' || c == '}') && depth > 0)
      --depth;
  }
  return text;
}

}  // namespace eyeray::engine
