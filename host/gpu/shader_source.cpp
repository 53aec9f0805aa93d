#include "host/gpu/shader_source.hpp"

#include <sstream>

#include "host/core/error.hpp"

namespace eyeray::engine::gpu {
namespace {

// The path of a line `#include "path"`, or "".
std::string_view included_path(std::string_view line) {
  const auto skip_blanks = [&line] {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  };
  skip_blanks();
  if (!line.starts_with('#')) return "";
  line.remove_prefix(1);
  skip_blanks();
  if (!line.starts_with("include")) return "";
  line.remove_prefix(7);
  skip_blanks();
  if (!line.starts_with('"')) return "";
  const size_t end = line.find('"', 1);
  return end == std::string_view::npos ? "" : line.substr(1, end - 1);
}

void read_file_and_its_includes(const SourceProvider& provider, const std::string& path,
                                ShaderSource& source) {
  if (source.files.contains(path) || !why_not_includable(path).empty()) return;
  const std::optional<std::string> text = provider(path);
  if (!text) return;
  source.files.emplace(path, *text);
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line);)
    if (const std::string_view included = included_path(line); !included.empty())
      read_file_and_its_includes(provider, std::string(included), source);
}

}  // namespace

std::vector<std::string> ShaderSource::file_names() const {
  std::vector<std::string> names;
  for (const auto& [name, text] : files) names.push_back(name);
  return names;
}

std::string why_not_includable(std::string_view path) {
  if (path.empty()) return "the path is empty";
  if (path.starts_with('/')) return "the path is absolute: it must be relative to the shader root";
  if (path.find('\\') != std::string_view::npos) return "the path has a backslash";
  for (size_t begin = 0; begin <= path.size();) {
    const size_t end = std::min(path.find('/', begin), path.size());
    const std::string_view part = path.substr(begin, end - begin);
    if (part.empty() || part == "." || part == "..") return "the path may not have '.', '..' or empty parts";
    begin = end + 1;
  }
  return "";
}

ShaderSource read_shader(const SourceProvider& provider, std::string_view entry) {
  ShaderSource source{std::string(entry), {}};
  read_file_and_its_includes(provider, source.entry, source);
  if (!source.files.contains(source.entry))
    throw Error(ExitCode::bad_input, "there is no shader '{}'", entry);
  return source;
}

}  // namespace eyeray::engine::gpu
