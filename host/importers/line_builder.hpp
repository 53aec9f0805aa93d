// Collects the lines of a file, which are shown as capsules. Private to the importers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/importers/import.hpp"

namespace eyeray::engine::importers {

class LineBuilder {
 public:
  // `width`: the diameter of lines, in the file's units; without it, none is shown.
  LineBuilder(std::string file, std::optional<double> width) : file_(std::move(file)), width_(width) {}

  bool shows() const { return width_.has_value(); }
  // Counts lines of a file that are not shown, since they have no width.
  void leave_out(size_t lines) { left_out_ += lines; }

  // InputError if a file shows `more` segments than it may.
  void check_room(size_t more) const;
  // Adds the segments, as lines of that material, to the scene. Leaves out those that are not finite, or
  // whose length a capsule of this width cannot have.
  void add(std::vector<LineSegment> segments, int material, ImportedScene& scene);

  // Adds the warnings.
  void report(std::vector<std::string>& warnings) const;

 private:
  std::string file_;
  std::optional<double> width_;
  size_t left_out_ = 0;  // lines without a width
  size_t shown_ = 0;     // segments
  size_t unfit_ = 0;     // segments that were left out
};

}  // namespace eyeray::engine::importers
