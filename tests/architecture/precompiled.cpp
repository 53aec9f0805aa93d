// Checks that a file includes the headers whose names it uses, which builds with precompiled headers do not
// detect.
#include <fmt/ranges.h>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <variant>

#include "sources.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine::test;

namespace {

using Names = std::set<std::string>;

// The precompiled headers (eyeray_precompiled in cmake/layers.cmake), by a name that needs one of them.
const std::map<std::string, Names> headers_of = [] {
  std::map<std::string, Names> headers;
  const auto add = [&](const Names& any_of, const Names& names) {
    for (const std::string& name : names) headers[name] = any_of;
  };
  add({"algorithm"},
      {"std::ranges", "std::sort", "std::stable_sort", "std::find", "std::find_if", "std::any_of",
       "std::all_of", "std::none_of", "std::count_if", "std::clamp", "std::minmax", "std::reverse",
       "std::unique", "std::nth_element", "std::lower_bound", "std::upper_bound"});
  add({"array"}, {"std::array", "std::to_array"});
  add({"atomic"}, {"std::atomic"});
  add({"cmath"}, {"std::sqrt", "std::fabs", "std::sin", "std::cos", "std::tan", "std::atan2", "std::pow",
                  "std::exp", "std::log", "std::floor", "std::ceil", "std::round", "std::lround",
                  "std::isnan", "std::isinf", "std::isfinite", "std::hypot", "std::fmod", "std::nextafter"});
  add({"filesystem"}, {"std::filesystem"});
  add({"fstream"}, {"std::ifstream", "std::ofstream", "std::fstream"});
  add({"functional"}, {"std::function", "std::invoke"});
  add({"map"}, {"std::map", "std::multimap"});
  add({"memory"}, {"std::unique_ptr", "std::shared_ptr", "std::make_unique", "std::make_shared"});
  add({"optional"}, {"std::optional", "std::nullopt"});
  add({"set"}, {"std::set", "std::multiset"});
  add({"span"}, {"std::span", "std::as_bytes"});
  add({"string", "filesystem", "sstream", "fstream"}, {"std::string", "std::to_string"});
  add({"string", "string_view"}, {"std::string_view"});
  add({"variant"}, {"std::variant", "std::get_if", "std::visit"});
  add({"vector"}, {"std::vector"});
  add({"fmt/format.h", "fmt/ranges.h"}, {"fmt::format", "fmt::print"});
  add({"fmt/ranges.h"}, {"fmt::join"});
  add({"glm/glm.hpp", "glm/geometric.hpp"}, {"glm::dot", "glm::cross", "glm::normalize", "glm::length"});
  return headers;
}();

// The names of std, fmt and glm in a line: "std::string" from "std::string::npos".
Names names_in(const std::string& line) {
  Names names;
  for (const char* space : {"std::", "fmt::", "glm::"}) {
    for (size_t at = line.find(space); at != std::string::npos; at = line.find(space, at + 1)) {
      const size_t end = line.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789", at + 5);
      names.insert(line.substr(at, end - at));
    }
  }
  return names;
}

// The includes of each file, the project's own by their paths.
std::map<std::string, Names> direct_includes(const std::map<std::string, SourceFile>& files) {
  std::map<std::string, Names> direct;
  for (const auto& [path, file] : files) {
    const std::string folder = path.substr(0, path.rfind('/') + 1);
    for (const Include& include : includes(file)) {
      std::string name = include.name;
      for (const std::string& root : {folder, std::string("shaders/"), std::string("tests/")})
        if (!include.system && !files.contains(name) && files.contains(root + include.name))
          name = root + include.name;
      direct[path].insert(name);
    }
  }
  return direct;
}

void add_all(const std::string& path, const std::map<std::string, Names>& direct, Names& included) {
  const auto of = direct.find(path);
  if (of == direct.end()) return;
  for (const std::string& name : of->second)
    if (included.insert(name).second) add_all(name, direct, included);
}

}  // namespace

TEST_CASE("a file includes each precompiled header whose names it uses") {
  std::map<std::string, SourceFile> files;
  for (const char* folder : {"host", "shaders", "tests"})
    for (SourceFile& file : source_files(folder)) files.emplace(file.path, std::move(file));
  const std::map<std::string, Names> direct = direct_includes(files);
  size_t seen = 0;
  for (const auto& entry : files) {
    const SourceFile& file = entry.second;
    if (file.path.starts_with("shaders/")) continue;
    Names included;
    add_all(file.path, direct, included);
    for (size_t line = 0; line < file.lines.size(); ++line) {
      for (const std::string& name : names_in(code(file.lines[line]))) {
        const auto headers = headers_of.find(name);
        if (headers == headers_of.end()) continue;
        ++seen;
        INFO(file.at(line), " says ", name, " without <", *headers->second.begin(), ">");
        CHECK(std::ranges::any_of(headers->second,
                                  [&](const std::string& header) { return included.contains(header); }));
      }
    }
  }
  CHECK(seen > 5000);
}

TEST_CASE("the table of names covers every precompiled header") {
  Names named;
  for (const auto& [name, headers] : headers_of) named.insert(headers.begin(), headers.end());
  size_t seen = 0;
  std::ifstream stream("cmake/layers.cmake");
  bool in_list = false;
  static const std::regex header("<([^>$]+)>");
  for (std::string line; std::getline(stream, line);) {
    in_list = in_list || line.find("target_precompile_headers(${owner}") != std::string::npos;
    for (std::sregex_iterator it(line.begin(), line.end(), header), end; in_list && it != end; ++it, ++seen) {
      CAPTURE((*it)[1].str());
      CHECK(named.contains((*it)[1].str()));
    }
    in_list = in_list && line.find(')') == std::string::npos;
  }
  CHECK(seen > 15);
}
