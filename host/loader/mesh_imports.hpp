// The mesh files of one scene, each read once. Private to the loader.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/importers/import.hpp"
#include "host/loader/allowed_folders.hpp"

namespace eyeray::loader {

class MeshImports {
 public:
  // Names in one of `sources` (the scene, first, and what it includes) are relative to the folder of the file
  // that they stand in; names that stand in no file (an override) are relative to the scene's. `trees`: where
  // what the mesh files name may lie.
  MeshImports(const AllowedFolders& folders, std::vector<std::filesystem::path> trees,
              std::vector<std::filesystem::path> sources, image::PixelBudget& budget)
      : folders_(folders), trees_(std::move(trees)), sources_(std::move(sources)), budget_(budget) {}

  struct Loaded {
    importers::ImportedScene* scene;
    bool fresh;  // this is the first time that it is asked for
  };
  // What the file holds that is named in the file `from`; the pointer stays good. Error, one sentence, where
  // it cannot be had; the same one each time.
  Loaded load(const std::string& name, std::optional<double> smooth, const std::string& from);

  // What a mesh file holds that is itself the scene; it will not be fresh again. InputError and Error as
  // import_file's.
  Loaded load_alone(const std::filesystem::path& file);

  // Every file that was to be read, in the order in which they were first named.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  struct Entry {
    importers::ImportedScene scene;
    std::string refused;  // why there is none
    ExitCode code = ExitCode::ok;
  };
  void import(Entry& entry, const std::filesystem::path& file, std::optional<double> smooth);
  void add_file(const std::filesystem::path& file);

  const AllowedFolders& folders_;
  std::vector<std::filesystem::path> trees_;
  std::vector<std::filesystem::path> sources_;
  image::PixelBudget& budget_;
  std::vector<std::filesystem::path> files_;
  std::map<std::pair<std::filesystem::path, std::optional<double>>, Entry> entries_;  // by canonical path
};

}  // namespace eyeray::loader
