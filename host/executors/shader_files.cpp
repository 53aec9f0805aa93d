#include "host/executors/shader_files.hpp"

#include "host/core/atomic_file.hpp"
#include "host/core/embedded_shaders.hpp"
#include "host/core/error.hpp"

namespace eyeray::executors {

ShaderFiles::ShaderFiles(std::filesystem::path folder, std::string scene_glsl)
    : folder_(std::move(folder)), scene_glsl_(std::move(scene_glsl)) {
  if (!folder_.empty() && !std::filesystem::is_directory(folder_))
    throw Error(ExitCode::file_io, "--shaders {}: not a folder; `eyeray shaders --export {}` makes one",
                folder_.string(), folder_.string());
}

std::optional<std::string> ShaderFiles::read(std::string_view name) {
  if (name == "scene.glsl") return scene_glsl_;
  if (!folder_.empty()) {
    const std::filesystem::path path = folder_ / name;
    looked_for_.insert(path);
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) return read_file(path);
  }
  for (const EmbeddedShader& shader : embedded_shaders())
    if (shader.name == name) return std::string(shader.text);
  return std::nullopt;
}

std::string ShaderFiles::shown(const std::string& name) const {
  if (folder_.empty()) return name;
  const std::filesystem::path path = folder_ / name;
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) ? path.string() : name;
}

}  // namespace eyeray::executors
