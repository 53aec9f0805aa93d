// Shaders to be laid over eyeray's own, by --shaders or ExecutorOptions::shader_folder.
#pragma once

#include "tests/support/process.hpp"

namespace eyeray::engine::test {

// `text` with its only occurrence of `before` replaced; throws if there is no occurrence, or more than one.
inline std::string replaced(std::string text, const std::string& before, const std::string& after) {
  const size_t at = text.find(before);
  if (at == std::string::npos) throw std::runtime_error("no '" + before + "' in the text");
  if (text.find(before, at + 1) != std::string::npos)
    throw std::runtime_error("more than one '" + before + "' in the text");
  return text.replace(at, before.size(), after);
}

// The text of eyeray's own shader `file`, as "shapes/sphere.glsl".
inline std::string own_shader(const std::string& file) {
  return read_text("shaders/" + file);
}

// Writes `text` as the shader `file` below `folder`.
inline void lay_shader(const std::filesystem::path& folder, const std::string& file,
                       const std::string& text) {
  std::filesystem::create_directories((folder / file).parent_path());
  write_text(folder / file, text);
}

inline void lay_changed_shader(const std::filesystem::path& folder, const std::string& file,
                               const std::string& before, const std::string& after) {
  lay_shader(folder, file, replaced(own_shader(file), before, after));
}

}  // namespace eyeray::engine::test
