// Batches: one table for many shapes, meshes or groups that differ in some of their values. Private to the
// loader.
#pragma once

#include <toml++/toml.h>

#include <string_view>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/sections.hpp"

namespace eyeray::engine::loader {

// A batch of a table's values, as it was checked.
struct Batch {
  const toml::table* lists = nullptr;  // null: the table is one object
  size_t count = 1;                    // 0 after an error
};

// Checks that all lists of a table's batch are lists of its values, and equally long.
Batch read_batch(const Section& section, const toml::table& table, DiagnosticLog& log);

// The name that a table, or an element of its batch, gives itself, where it is one; "" where there is none.
std::string_view written_name(const toml::table& table, const Batch& batch, size_t element);

}  // namespace eyeray::engine::loader
