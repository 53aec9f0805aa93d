#include "host/reading/source_position.hpp"

#include <algorithm>

namespace eyeray::engine::reading {

SourcePosition position_of(const toml::source_region& source) {
  return {source.path ? *source.path : std::string(), static_cast<int>(source.begin.line),
          static_cast<int>(source.begin.column)};
}

SourcePosition start_of_text(const toml::node& node) {
  SourcePosition start = position_of(node.source());
  const std::string text = node.value_or(std::string());
  const auto& [begin, end, path] = node.source();
  const auto breaks = size_t(std::ranges::count(text, '\n'));
  if (end.line - begin.line == breaks + 1)  // the first line break in """ … is left out
    return {start.file, start.line + 1, 1};
  if (end.line - begin.line != breaks) return {start.file, 0, 0};
  const bool triple = breaks > 0 || end.column - begin.column == text.size() + 6;
  return {start.file, start.line, start.column + (triple ? 3 : 1)};
}

}  // namespace eyeray::engine::reading
