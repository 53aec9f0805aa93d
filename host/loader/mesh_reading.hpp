// The keys of [[mesh]] that decide how its file is read. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include "host/importers/import.hpp"
#include "host/reading/table_reader.hpp"

namespace eyeray::engine::loader {

importers::ImportOptions read_mesh_reading(const reading::TableReader& reader);
// Adds the keys from which read_mesh_reading() makes `options`, but for those of animations.
void write_mesh_reading(const importers::ImportOptions& options, toml::table& mesh);

// Adds an error at each key that names an animation, a scene or a variant which the file lacks. True if there
// is none.
bool check_mesh_names(const importers::ImportOptions& options, const importers::ImportedScene& import,
                      reading::TableReader& reader);

}  // namespace eyeray::engine::loader
