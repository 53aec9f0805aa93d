#include "host/executors/shader_files.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

#include "host/core/atomic_file.hpp"
#include "host/core/diagnostic.hpp"
#include "host/core/embedded_shaders.hpp"
#include "host/core/error.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/input_file.hpp"
#include "host/core/option_text.hpp"

namespace eyeray::engine::executors {
namespace {

constexpr std::string_view shared_files[] = {"records.h", "result_records.h"};  // used by shaders and host

std::string_view embedded(std::string_view name) {
  for (const EmbeddedFile& shader : embedded_shaders())
    if (shader.name == name) return shader.text;
  return {};
}

struct Line {
  int number;
  std::string text;  // as written
  std::string code;  // without comment and space
};

std::vector<Line> code_lines(std::string_view text) {
  std::vector<Line> lines;
  std::istringstream stream{std::string(text)};
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    std::string code = line.substr(0, line.find("//"));
    std::erase_if(code, [](unsigned char c) { return std::isspace(c); });
    if (!code.empty()) lines.push_back({number, line, code});
  }
  return lines;
}

// The buffers' layout is compiled into the program: other records would be read wrongly.
void check_records(const std::filesystem::path& folder, std::string_view shared) {
  const std::filesystem::path file = folder / shared;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return;
  const std::vector<Line> theirs = code_lines(read_file(file)), ours = code_lines(embedded(shared));
  const auto [at, own] = std::ranges::mismatch(theirs, ours, {}, &Line::code, &Line::code);
  if (at == theirs.end() && own == ours.end()) return;
  Diagnostic diagnostic;
  diagnostic.position = {file.string(), at == theirs.end() ? 0 : at->number, 0};
  diagnostic.message = fmt::format(
      "eyeray packs scenes by the {} that it was compiled with, which has '{}' here: change records only in "
      "eyeray's own source",
      shared, own == ours.end() ? "nothing more" : own->text);
  if (at != theirs.end()) show_source_line(diagnostic, at->text);
  throw InputError({std::move(diagnostic)});
}

}  // namespace

ShaderFiles::ShaderFiles(std::filesystem::path folder, std::string scene_glsl)
    : folder_(std::move(folder)), scene_glsl_(std::move(scene_glsl)) {
  if (!folder_.empty() && !std::filesystem::is_directory(folder_))
    throw Error(ExitCode::file_io, "{}: not a folder; `eyeray shaders --export {}` makes one",
                option_text("shaders", folder_.string()), shell_word(folder_.string()));
  if (!folder_.empty())
    for (const std::string_view shared : shared_files) check_records(folder_, shared);
}

std::optional<std::string> ShaderFiles::read(std::string_view name) {
  if (name == "scene.glsl") return scene_glsl_;
  if (!folder_.empty()) {
    const std::filesystem::path path = folder_ / name;
    looked_for_.insert(path);
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) {
      std::string text = read_file(path);
      drop_byte_order_mark(text);
      gave_users_ = true;
      return text;
    }
  }
  const std::string_view text = embedded(name);
  return text.empty() ? std::nullopt : std::optional(std::string(text));
}

std::optional<std::string_view> ShaderFiles::replaced(std::string_view name) const {
  std::error_code error;
  const bool is_there = !folder_.empty() && std::filesystem::is_regular_file(folder_ / name, error);
  return is_there ? std::optional(embedded(name)) : std::nullopt;
}

std::string ShaderFiles::shown(const std::string& name) const {
  if (folder_.empty()) return name;
  const std::filesystem::path path = folder_ / name;
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) ? path.string() : name;
}

std::vector<std::string> changed_shaders(const std::filesystem::path& folder) {
  std::vector<std::string> changed;
  if (folder.empty()) return changed;
  for (const EmbeddedFile& shader : embedded_shaders()) {
    const std::filesystem::path file = folder / shader.name;
    std::error_code error;
    if (std::filesystem::is_regular_file(file, error) && read_file(file) != shader.text)
      changed.push_back(file.string());
  }
  return changed;
}

}  // namespace eyeray::engine::executors
