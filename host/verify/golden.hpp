// Golden pictures: the look of a scene when somebody last examined it. A .pfm, and beside it a .json of the
// same name that states its origin.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/compare/report.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::verify {

enum class Update {
  never,
  failing,  // pictures that are missing, or that differ from the scene's picture
  all,
};

struct Golden {
  std::filesystem::path picture;
  Update update = Update::never;
  std::string version;  // version of eyeray
};

// Gate G compares the first frame's colours with the golden picture's, by the rules of gate B: where they
// differ, the golden picture must be within the reference's range around that pixel. Error (file_io) if the
// picture exists but cannot be read.
compare::GoldenResult compare_with_golden(const Golden& golden, const Scene& scene,
                                          const compare::Frame& frame, const compare::Reference& reference,
                                          const compare::Tolerances& tolerances,
                                          const compare::Report& report);

// Stores the frame as the golden picture if that is requested and no gate but G fails. An all-black frame is
// refused. Sets the outcome in the report's golden result. Error (file_io) when the files cannot be
// written.
void bless(const Golden& golden, const Scene& scene, const compare::Frame& frame, compare::Report& report);

}  // namespace eyeray::engine::verify
