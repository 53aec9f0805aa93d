// shaders/kernels/features.h is the written contract of the specialisation: every define is listed, and
// every listed name is defined.
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/doctest.hpp"
#include "tests/support/process.hpp"

using namespace eyeray::engine;

namespace {

using Names = std::set<std::string>;

// The matches of the first group of `pattern` in the text.
Names matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  Names names;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it) names.insert((*it)[1]);
  return names;
}

// The lines of the text that begin with #, if `wanted`; otherwise the other lines.
std::string directives(const std::string& text, bool wanted) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with('#') == wanted) kept += line + '\n';
  return kept;
}

Names listed() {
  const std::string text = test::read_text("shaders/kernels/features.h");
  Names names = matches(text, "\n#ifndef (\\w+)  //");
  names.merge(matches(text, "\n#ifndef (HAS_\\w+)\n"));
  names.merge(matches(text, "\n//   ([A-Z]\\w*)"));
  return names;
}

// The names that the twin defines, and those that host/executors writes into the text of kernels.
Names defined() {
  Names names =
      matches(directives(test::read_text("host/twin/shader_functions.hpp"), true), "#define ([A-Z]\\w*)");
  for (const auto& file : std::filesystem::directory_iterator("host/executors")) {
    if (file.path().extension() != ".cpp") continue;
    const std::string text = directives(test::read_text(file.path()), false);
    names.merge(matches(text, "#define ([A-Z]\\w*)"));
    names.merge(matches(text, "define\\(\"([A-Z]\\w*)"));
    names.merge(matches(text, "(?:registry|list)_text\\(\"([A-Z]\\w*)"));
    for (const std::string& family : matches(text, "\"([A-Z]+_)\\{\\}\"")) names.insert(family + "name");
  }
  return names;
}

std::string missing(const Names& from, const Names& names) {
  std::string text;
  for (const std::string& name : names)
    if (!from.contains(name)) text += name + ' ';
  return text;
}

}  // namespace

TEST_CASE("features.h lists exactly the names that a specialisation and the twin define") {
  CHECK(defined().size() > 40);
  CHECK(missing(listed(), defined()) == "");
  CHECK(missing(defined(), listed()) == "");
}
