// The implementation of TableReader: it reads the TOML of one table, and checks it by its Keys. Private to
// this layer and the loader.
#pragma once

#include <toml++/toml.h>

#include <array>

#include "host/reading/formula_source.hpp"
#include "host/reading/image_source.hpp"
#include "host/reading/value.hpp"

namespace eyeray::engine::reading {

// A table as it stands in the file, and the keys allowed in it.
struct TableSource {
  std::string_view title;                             // for messages: "[camera]", "[[sphere]]"
  const toml::table* table = nullptr;                 // null: not written, all keys take their defaults
  std::array<std::span<const Key>, 2> keys = {};      // the keys that all such tables share; the table's own
  const toml::table* batch = nullptr;                 // lists of values that replace values of the table …
  size_t element = 0;                                 // … and the element to take from each list
  std::span<const std::string_view> extra_keys = {};  // allowed keys that other code reads
  std::span<const std::string_view> refused_keys = {};  // keys that other code reports as errors
  bool open = false;                                    // true: any other key is allowed, too
  ValueSources sources = {};
};

// Reads and checks every key. Errors go to the log, which must outlive the reader.
TableReader read_table(const TableSource& source, DiagnosticLog& log);

// The fallback of a key as a TOML node.
const toml::node& fallback_of(const Key& key);

// The keys of the tables inside of values, for the schema and the manual.
std::span<const Key> transform_step_keys();
std::span<const Key> rotation_keys();

}  // namespace eyeray::engine::reading
