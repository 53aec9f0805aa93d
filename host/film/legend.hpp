// The legend of an AOV's ids: a JSON file beside its picture.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "host/core/pixel.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::film {

using Json = nlohmann::ordered_json;

// The objects that may be hit, by the ids of one AOV.
class LegendEntries {
 public:
  virtual ~LegendEntries() = default;

  virtual size_t size() const = 0;
  // The index of the entry of a hit.
  virtual size_t of(const FirstHit& hit) const = 0;
  // The entry's ids, its name, its position in the scene file, and its colour in the picture.
  virtual Json entry(size_t index) const = 0;
};

// The entries of shapes and meshes, by their own numbers (AOV `shape`) or by the numbers of their primitives
// (AOV `primitive`), and the entries of materials. `scene` must outlive the entries.
std::unique_ptr<LegendEntries> legend_of_shapes(const Scene& scene);
std::unique_ptr<LegendEntries> legend_of_primitives(const Scene& scene);
std::unique_ptr<LegendEntries> legend_of_materials(const Scene& scene);

// The entries that were hit, by index, and the number of pixels of each. add() merges legends of parts of a
// picture.
struct LegendTally {
  struct Entry {
    std::string text;  // LegendEntries::entry as JSON
    uint64_t pixels = 0;
  };
  uint64_t nothing = 0;  // pixels where nothing is hit
  std::map<uint64_t, Entry> entries;

  void add(const LegendTally& other);
};

// Writes NAME.json for a picture NAME.png, and returns its path. Error (file_io) if it cannot be written.
std::filesystem::path write_legend(const LegendTally& tally, const std::filesystem::path& picture);

// Takes first hits, and lists the entries that they belong to, each with its number of pixels.
class Legend {
 public:
  explicit Legend(std::unique_ptr<LegendEntries> entries);

  const LegendEntries& entries() const { return *entries_; }
  void see(std::span<const FirstHit> hits);
  // Writes the legend as write_legend does, without holding the text of all entries.
  std::filesystem::path write(const std::filesystem::path& picture) const;
  LegendTally tally() const;

 private:
  std::unique_ptr<LegendEntries> entries_;
  std::vector<uint64_t> pixels_;  // the number of pixels of each entry
  uint64_t nothing_ = 0;          // pixels where nothing is hit
};

}  // namespace eyeray::engine::film
