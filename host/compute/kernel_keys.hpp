// The keys of a kernel file. Each table's keys are declared here once.
#pragma once

#include <span>
#include <string_view>

#include "host/reading/key.hpp"

namespace eyeray::engine::compute {

struct KernelTable {
  std::string_view title;                   // "[buffer.NAME]"
  std::span<const reading::Key> keys;       // checked by their declarations
  std::span<const std::string_view> lists;  // keys whose values are read in another way
};

enum class Table { top, buffer, image, noise, expect, same };
const KernelTable& kernel_table(Table table);
// All tables, for the test of docs/kernel-files.md.
std::span<const KernelTable> kernel_tables();

}  // namespace eyeray::engine::compute
