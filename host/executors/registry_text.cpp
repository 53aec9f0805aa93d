#include "host/executors/registry_text.hpp"

#include <fmt/format.h>

namespace eyeray::executors {

std::string registry_text(std::string_view list, std::string_view folder, std::span<const Row> rows,
                          const std::set<uint32_t>& used) {
  std::string includes;
  std::string entries;
  for (const Row& row : rows) {
    if (!used.contains(row.number)) continue;
    includes += fmt::format("#include \"{}/{}.glsl\"\n", folder, row.name);
    entries +=
        fmt::format(" X({}, {}u{}{})", row.name, row.number, row.traits.empty() ? "" : ", ", row.traits);
  }
  return fmt::format("#define {}(X){}\n{}", list, entries, includes);
}

}  // namespace eyeray::executors
