// A shader's text with everything it includes, taken at one moment.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace eyeray::engine::gpu {

// The text of a file below the include root ("shapes/sphere.glsl"), or nothing when there is no such file.
// The caller decides on the root: embedded shaders, folders laid over them, files made for a scene.
using SourceProvider = std::function<std::optional<std::string>(std::string_view path)>;

struct ShaderSource {
  std::string entry;
  std::map<std::string, std::string, std::less<>> files;  // path → text, the entry among them

  std::vector<std::string> file_names() const;
};

// Why a path may not be included, or "" when it may: paths are relative to the root, and never leave it.
std::string why_not_includable(std::string_view path);

// The entry and every file that an #include line of it names, directly or not, even under #if. A name that
// the provider does not know is left out: the compiler reports it if it reaches that line. Error (bad_input)
// when there is no entry.
ShaderSource read_shader(const SourceProvider& provider, std::string_view entry);

}  // namespace eyeray::engine::gpu
