// The layers as CMakeLists.txt lists them, which is the only list.
#pragma once

#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace eyeray::engine::test {

// The layers and libraries that a layer links.
using Links = std::set<std::string>;

// The folder of each program under host/, which is not a library.
inline const std::map<std::string, std::string> command_lines = {{"eyeray", "cli"},
                                                                 {"eyeray-bench", "bench_cli"}};

// The links of every layer, and of the programs' command lines.
inline std::map<std::string, Links> read_layers() {
  std::ifstream stream("CMakeLists.txt");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  std::map<std::string, Links> layers;
  static const std::regex call(
      R"((?:eyeray_layer\((\w+)|target_link_libraries\((eyeray|eyeray-bench) PRIVATE)([^)]*)\))");
  for (auto it = std::sregex_iterator(text.begin(), text.end(), call); it != std::sregex_iterator(); ++it) {
    std::istringstream words((*it)[3].str());
    Links& links = layers[(*it)[1].matched ? (*it)[1].str() : command_lines.at((*it)[2].str())];
    for (std::string word; words >> word;)
      if (!std::set<std::string>{"COMPUTES", "LINK", "PUBLIC", "PRIVATE"}.contains(word)) links.insert(word);
  }
  return layers;
}

}  // namespace eyeray::engine::test
