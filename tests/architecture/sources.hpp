// The source tree as text, for tests of its shape.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

namespace eyeray::engine::test {

struct SourceFile {
  std::string path;  // from the source root: "host/scene/key.cpp"
  std::vector<std::string> lines;

  std::string name() const { return std::filesystem::path(path).filename().string(); }
  // The folder below its root, which under host/ and benchmarks/ is its layer: "scene".
  std::string layer() const { return std::next(std::filesystem::path(path).begin())->string(); }
  bool header() const { return path.ends_with(".hpp") || path.ends_with(".h"); }
  // "host/scene/key.cpp:12".
  std::string at(size_t line) const { return path + ":" + std::to_string(line + 1); }
};

// Every source file below `folder`, by path.
inline std::vector<SourceFile> source_files(const std::string& folder) {
  std::vector<SourceFile> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending != ".cpp" && ending != ".hpp" && ending != ".h" && ending != ".glsl") continue;
    SourceFile file{entry.path().string(), {}};
    std::ifstream stream(entry.path());
    for (std::string line; std::getline(stream, line);) file.lines.push_back(line);
    files.push_back(std::move(file));
  }
  std::ranges::sort(files, {}, &SourceFile::path);
  return files;
}

// The files of every layer.
inline std::vector<SourceFile> layer_files() {
  std::vector<SourceFile> files = source_files("host");
  std::ranges::move(source_files("benchmarks"), std::back_inserter(files));
  return files;
}

struct Include {
  size_t line;
  std::string name;
  bool system;  // in angle brackets
};

inline std::vector<Include> includes(const SourceFile& file) {
  static const std::regex directive(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> found;
  std::smatch match;
  for (size_t i = 0; i < file.lines.size(); ++i) {
    if (std::regex_search(file.lines[i], match, directive))
      found.push_back({i, match[2].str(), match[1].str() == "<"});
  }
  return found;
}

// A line of code without its // comment.
inline std::string code(const std::string& line) {
  return line.substr(0, line.find("//"));
}

}  // namespace eyeray::engine::test
