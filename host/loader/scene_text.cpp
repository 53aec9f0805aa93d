#include "host/loader/scene_text.hpp"

#include "host/core/input_file.hpp"
#include "host/importers/import.hpp"

namespace eyeray::engine::loader {
namespace {

constexpr size_t most_bytes = size_t{256} << 20;

}  // namespace

std::string read_scene_text(const std::filesystem::path& file) {
  if (std::error_code error; std::filesystem::is_directory(file, error))
    throw Error(ExitCode::file_io, "cannot read the scene {}: it is a folder; name a scene or a mesh in it",
                file.string());
  std::string text = read_input_file(file, "the scene", most_bytes);
  if (file.extension() != ".toml" && text.find('\0') != std::string::npos)
    throw Error(ExitCode::bad_input,
                "{} is not a scene: it contains bytes that are not text; a scene ends in .toml, a mesh in {}",
                file.string(), importers::mesh_endings);
  return text;
}

}  // namespace eyeray::engine::loader
