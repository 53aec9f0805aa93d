// The mesh files of one scene, each read once. Private to the loader.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/importers/import.hpp"
#include "host/loader/allowed_folders.hpp"
#include "host/loader/scene_file.hpp"

namespace eyeray::engine::loader {

// The value of `animation` in [[mesh]] for a file at rest.
inline constexpr const char* no_animation = "none";

class MeshImports {
 public:
  // Names in one of `sources` (the scene, first, and its includes) are relative to the folder of the file
  // that they stand in. Names that stand in no file (an override) are relative to the scene's. `trees`:
  // folder trees that may contain the files that mesh files name.
  MeshImports(const AllowedFolders& folders, std::vector<std::filesystem::path> trees,
              std::vector<std::filesystem::path> sources, image::PixelBudget& budget)
      : folders_(&folders), trees_(std::move(trees)), sources_(std::move(sources)), budget_(budget) {}
  // For a scene that is in no file. `memory` must outlive this object.
  MeshImports(const MemoryFiles& memory, image::PixelBudget& budget) : memory_(&memory), budget_(budget) {}

  struct Loaded {
    importers::ImportedScene* scene;
    bool fresh;  // this is the first time that it is asked for
  };
  // The moment that animated files are shown at, in seconds; 0 until it is set.
  void show(double seconds) { seconds_ = seconds; }

  // The contents of the file `name`, as the file `from` writes it. The pointer stays valid. The moment in
  // `playing` is ignored. Error, one sentence, if the file cannot be read; the same one each time.
  Loaded load(const std::string& name, std::optional<double> smooth, importers::Playing playing,
              const std::string& from);

  // The contents of a mesh file that is itself the scene; it will not be fresh again. InputError and Error as
  // import_file.
  Loaded load_alone(const std::filesystem::path& file);
  // The file at rest, which is not shown. InputError, as from import_file, if nothing could be seen.
  importers::ImportedScene rest(const std::filesystem::path& file) const;

  // The animations of the loaded files, each once for each way in which it is shown.
  std::vector<importers::PlayedAnimation> played() const;

  // Every file that was to be read, in the order in which they were first named.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  struct Entry {
    importers::ImportedScene scene;
    std::string refused;  // why there is none
    ExitCode code = ExitCode::ok;
    bool shown = false;
  };
  // A file, by its canonical path, and the way to read it.
  struct Wanted {
    std::filesystem::path file;
    std::optional<double> smooth;
    importers::Playing playing;

    auto operator<=>(const Wanted&) const = default;
  };
  AllowedFolders::File find(const std::string& name, const std::string& from) const;
  importers::ImportedScene read(const std::filesystem::path& file, const Wanted& wanted);
  void import(Entry& entry, const std::filesystem::path& file, const Wanted& wanted);
  void add_file(const std::filesystem::path& file);

  const AllowedFolders* folders_ = nullptr;  // or else
  const MemoryFiles* memory_ = nullptr;
  std::vector<std::filesystem::path> trees_;
  std::vector<std::filesystem::path> sources_;
  image::PixelBudget& budget_;
  std::vector<std::filesystem::path> files_;
  std::map<Wanted, Entry> entries_;
  std::set<std::string> reported_;  // warnings
  double seconds_ = 0;
};

}  // namespace eyeray::engine::loader
