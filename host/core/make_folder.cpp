#include "host/core/make_folder.hpp"

#include "host/core/error.hpp"

namespace eyeray::engine {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw Error(ExitCode::file_io, "cannot make the folder {}: {}", folder.string(), error.message());
}

}  // namespace eyeray::engine
