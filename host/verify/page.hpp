// The report as one HTML page that needs no other file: its pictures lie in it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/compare/report.hpp"

namespace eyeray::engine::verify {

class Page {
 public:
  // A scene that was verified: the frames of the report's participants, the reference's last, and the
  // outcomes of all but that.
  void add(const compare::Report& report, std::span<const compare::Frame> frames,
           std::span<const std::vector<compare::PixelOutcome>> outcomes);
  // One that could not be.
  void add(const compare::Report& report);

  // `summary`: the line that sums all of them up.
  std::string html(const std::string& summary) const;

 private:
  std::vector<std::string> scenes_;  // JSON
};

}  // namespace eyeray::engine::verify
