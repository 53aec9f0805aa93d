// Golden pictures: what a scene looked like when somebody last looked at it. A .pfm, and beside it a .json of
// the same name that says what it was made of.
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
// golden picture must be what the reference says around that pixel. Error (file_io) for a picture that is
// there and cannot be read.
compare::GoldenResult compare_with_golden(const Golden& golden, const Scene& scene,
                                          const compare::Frame& frame, const compare::Reference& reference,
                                          const compare::Tolerances& tolerances,
                                          const compare::Report& report);

// Stores the frame as the golden picture where that is asked for and nothing but gate G fails; what is black
// throughout is refused. Says in the report's golden result what came of it. Error (file_io) when the files
// cannot be written.
void bless(const Golden& golden, const Scene& scene, const compare::Frame& frame, compare::Report& report);

}  // namespace eyeray::engine::verify
