// The mesh files of one scene, each read once. Private to the loader.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/importers/import.hpp"
#include "host/loader/allowed_folders.hpp"
#include "host/loader/scene_file.hpp"

namespace eyeray::engine::loader {

// The value of `animation` in [[mesh]] that shows a file at rest.
inline constexpr const char* no_animation = "none";

// The error for a part of a file that the file lacks. `kind`: "animation". `names`: those of its animations.
std::string no_such(std::string_view kind, const std::string& wanted, std::span<const std::string> names);

class MeshImports {
 public:
  // `sources`: the scene's file, then the files that it includes. A name in one of them is relative to that
  // file's folder. A name in none of them, such as an override, is relative to the scene's folder. `trees`:
  // folder trees that may contain the files that mesh files name.
  MeshImports(const AllowedFolders& folders, std::vector<std::filesystem::path> trees,
              std::vector<std::filesystem::path> sources, image::PixelBudget& budget)
      : folders_(&folders), trees_(std::move(trees)), sources_(std::move(sources)), budget_(budget) {}
  // The mesh files of a scene in memory. `memory` must outlive this object.
  MeshImports(const MemoryFiles& memory, image::PixelBudget& budget) : memory_(&memory), budget_(budget) {}

  struct Loaded {
    importers::ImportedScene* scene;
    bool fresh;  // true if this is the first request for it
  };
  // Sets the moment at which animated files are shown, in seconds; it is 0 before that.
  void show(double seconds) { seconds_ = seconds; }

  using Reading = importers::ImportOptions;

  // The contents of the file that is called `name` in the file `from`. The pointer stays valid. The moment in
  // `reading.playing` is ignored. If the file cannot be read: Error, one sentence, the same each time.
  Loaded load(const std::string& name, Reading reading, const std::string& from);

  // The contents of a mesh file that is itself the scene; later requests do not return it as fresh. The
  // moment in `reading.playing` is ignored. InputError and Error as import_file.
  Loaded load_alone(const std::filesystem::path& file, Reading reading);
  // The file without animation, which is read but not shown. InputError, as from import_file, if nothing
  // could be seen.
  importers::ImportedScene rest(const std::filesystem::path& file, Reading reading) const;

  // The animations of the files shown: one for each way in which a file is shown.
  std::vector<importers::PlayedAnimation> played() const;

  // Every file that was requested, in the order in which they were first named.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  struct Entry {
    importers::ImportedScene scene;
    std::string refused;  // the reason why there is no scene
    ExitCode code = ExitCode::ok;
    bool shown = false;
  };
  // A file, by its canonical path, and the way to read it.
  struct Wanted {
    std::filesystem::path file;
    Reading reading;

    auto operator<=>(const Wanted&) const = default;
  };
  AllowedFolders::File find(const std::string& name, const std::string& from) const;
  importers::ImportedScene read(const std::filesystem::path& file, const Wanted& wanted);
  void import(Entry& entry, const std::filesystem::path& file, const Wanted& wanted);
  void add_file(const std::filesystem::path& file);

  const AllowedFolders* folders_ = nullptr;  // null for a scene in memory
  const MemoryFiles* memory_ = nullptr;      // null for a scene in a file
  std::vector<std::filesystem::path> trees_;
  std::vector<std::filesystem::path> sources_;
  image::PixelBudget& budget_;
  std::vector<std::filesystem::path> files_;
  std::map<Wanted, Entry> entries_;
  std::set<std::string> reported_;  // the warnings given so far
  double seconds_ = 0;
};

}  // namespace eyeray::engine::loader
