#include "host/executors/registry_text.hpp"

#include <fmt/format.h>

namespace eyeray::engine::executors {

std::string list_text(std::string_view list, std::span<const Row> rows, const std::set<uint32_t>& used) {
  std::string text = fmt::format("#define {}(X)", list);
  for (const Row& row : rows)
    if (used.contains(row.number))
      text +=
          fmt::format(" X({}, {}u{}{})", row.name, row.number, row.traits.empty() ? "" : ", ", row.traits);
  return text + "\n";
}

std::string registry_text(std::string_view list, std::string_view folder, std::span<const Row> rows,
                          const std::set<uint32_t>& used) {
  std::string text = list_text(list, rows, used);
  for (const Row& row : rows)
    if (used.contains(row.number)) text += fmt::format("#include \"{}/{}.glsl\"\n", folder, row.name);
  return text;
}

}  // namespace eyeray::engine::executors
