// eyeray verify for kernels that users bring (docs/kernel-files.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/verify/verify.hpp"

namespace eyeray::engine::cli {

struct KernelSubject {
  std::string file;                  // a kernel file, or a kernel
  std::vector<std::string> defines;  // values that replace those of the file
  bool backends_given = false;       // whether Options::backends are the user's choice
  std::filesystem::path evidence;    // the folder for the buffers of a kernel that fails
  bool keep_always = false;          // whether `evidence` gets them even if no gate fails
};

// The report on a kernel. Prints its warnings on stderr. The errors of compute::load_job and
// compute::verify_job; Error (bad_input) if the user chose no backend for kernels.
compare::Report verify_kernel(const KernelSubject& subject, const verify::Options& options);

}  // namespace eyeray::engine::cli
