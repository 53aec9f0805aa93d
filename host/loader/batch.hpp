// Batches: one table for many shapes, meshes or groups that differ in some of their values. Private to the
// loader.
#pragma once

#include <toml++/toml.h>

#include <string_view>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/sections.hpp"

namespace eyeray::engine::loader {

// The batch of a table, once it has been checked.
struct Batch {
  const toml::table* lists = nullptr;  // null: the table is one object
  size_t count = 1;                    // 0 after an error
};

// Checks that the lists in a table's batch contain values for keys of the table, and are equally long.
Batch read_batch(const Section& section, const toml::table& table, DiagnosticLog& log);

// The name that is written in a table, or for an element of its batch; "" if there is no valid name.
std::string_view written_name(const toml::table& table, const Batch& batch, size_t element);

}  // namespace eyeray::engine::loader
