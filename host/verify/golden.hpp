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
  failing,  // pictures that are missing, or from which the scene's differs
  all,
};

struct Golden {
  std::filesystem::path picture;
  Update update = Update::never;
  std::string version;  // of eyeray
};

// Gate G: the first frame's colours against the golden picture's, as gate B has it: where they differ, the
// golden picture must be within the reference's range around that pixel. Error (file_io) for a picture that
// is there and cannot be read.
compare::GoldenResult compare_with_golden(const Golden& golden, const Scene& scene,
                                          const compare::Frame& frame, const compare::Reference& reference,
                                          const compare::Tolerances& tolerances,
                                          const compare::Report& report);

// Stores the frame as the golden picture where that is asked for and nothing but gate G fails; an all-black
// one is refused. Sets the outcome in the report's golden result. Error (file_io) when the files cannot be
// written.
void bless(const Golden& golden, const Scene& scene, const compare::Frame& frame, compare::Report& report);

}  // namespace eyeray::engine::verify
