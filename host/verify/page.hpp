// The report as one HTML page that needs no other file: its pictures lie in it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/compare/report.hpp"

namespace eyeray::engine::verify {

class Page {
 public:
  // Adds a scene that was verified: the frames of the report's participants, of which the reference's is
  // last, and the outcomes of all frames but the last.
  void add(const compare::Report& report, std::span<const compare::Frame> frames,
           std::span<const std::vector<compare::PixelOutcome>> outcomes);
  // Adds a scene that could not be verified.
  void add(const compare::Report& report);

  // `summary`: the line that sums up all scenes.
  std::string html(const std::string& summary) const;

 private:
  std::vector<std::string> scenes_;  // JSON
};

}  // namespace eyeray::engine::verify
