#include "host/scene/names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace eyeray::engine {

int32_t Names::add(std::string_view text, uint32_t number, int32_t group) {
  const auto [found, fresh] = indices_.try_emplace(std::string(text), uint32_t(texts_.size()));
  if (fresh) texts_.emplace_back(text);
  entries_.push_back({found->second, number, group});
  return int32_t(entries_.size()) - 1;
}

std::string Names::path(int32_t index) const {
  std::vector<std::string> parts;
  for (; index != none; index = entries_[size_t(index)].group) {
    const Entry& entry = entries_[size_t(index)];
    parts.push_back(texts_[entry.text]);
    if (entry.number > 0) parts.back() += fmt::format(" {}", entry.number);
  }
  std::ranges::reverse(parts);
  return fmt::format("{}", fmt::join(parts, "/"));
}

std::string describe(std::string_view kind, const NameRef& name, const Names& names) {
  if (name.index == Names::none) return std::string(kind);
  return fmt::format("{} {}\"{}\"", kind, name.own ? "" : "in ", names.path(name.index));
}

}  // namespace eyeray::engine
