// Checks whether parts make one picture, and merges them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/shards/part_reader.hpp"

namespace eyeray::engine::shards {

// The reasons why files do not make one picture: sentences that name the files.
struct PartFaults {
  std::vector<std::string> damaged;  // also files that are no parts, or do not exist
  std::vector<std::string> foreign;  // parts of another picture than most parts are
  std::vector<std::string> doubled;
  std::vector<int> missing;  // indices of shards, of `count`
  int count = 0;

  bool any() const { return !damaged.empty() || !foreign.empty() || !doubled.empty() || !missing.empty(); }
  // The first few files of each fault, in one sentence.
  std::string text() const;
  // Throws Error (file_io) if files are damaged, Error (bad_input) for other faults. Returns if there are
  // none.
  void refuse() const;
};

// Receives the next rows of a plane, from the top down.
using PlaneSink = std::function<void(size_t plane, const image::Image& rows)>;

class PartSet {
 public:
  // Reads every byte of the files. Finds all faults at once.
  explicit PartSet(const std::vector<std::filesystem::path>& files);

  const PartFaults& faults() const { return faults_; }
  // The header of the picture to which most of the parts belong; null if no file is a part.
  const PartHeader* header() const { return wanted_; }
  // The sound parts of that picture, one a shard, in the order of the shards.
  const std::vector<PartReader>& parts() const { return parts_; }
  // The totals of all parts.
  PartTotals totals() const;

  // Passes the picture to `sink`. Only some rows of all planes are in memory at a time. May be called once,
  // and only without faults. Error (file_io) if a file has changed, Error (interrupted).
  void merge(const PlaneSink& sink);

 private:
  void keep_most_frequent(std::vector<PartReader> read);

  PartFaults faults_;
  std::vector<PartReader> parts_;
  const PartHeader* wanted_ = nullptr;
};

}  // namespace eyeray::engine::shards
