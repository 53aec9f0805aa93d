// The implementation of TableReader: the TOML of one table, read against its Keys. For this layer and the
// loader.
#pragma once

#include <toml++/toml.h>

#include <array>

#include "host/reading/formula_source.hpp"
#include "host/reading/image_source.hpp"
#include "host/reading/value.hpp"

namespace eyeray::engine::reading {

// A table as it stands in the file, and the keys allowed in it.
struct TableSource {
  std::string_view title;                         // for messages: "[camera]", "[[sphere]]"
  const toml::table* table = nullptr;             // null: not written, all keys take their defaults
  std::array<std::span<const Key>, 2> keys = {};  // those that all such tables share, and its own
  const toml::table* batch = nullptr;             // lists of values that stand in for values of the table …
  size_t element = 0;                             // … and which element of them to take
  std::span<const std::string_view> extra_keys = {};    // that are allowed and read elsewhere
  std::span<const std::string_view> refused_keys = {};  // that an error elsewhere is about
  bool open = false;                                    // whether any other key is
  ValueSources sources = {};
};

// Reads and checks every key; problems go to the log, which must outlive the reader.
TableReader read_table(const TableSource& source, DiagnosticLog& log);

// The fallback of a key as a node.
const toml::node& fallback_of(const Key& key);

// The keys of the tables inside of values, for the schema and the manual.
std::span<const Key> transform_step_keys();
std::span<const Key> rotation_keys();

}  // namespace eyeray::engine::reading
