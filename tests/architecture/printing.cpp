// Text from files and names is escaped where it leaves the program.
#include <set>

#include "sources.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine::test;

TEST_CASE("text for people is printed by print_lines, and JSON is made by json_text") {
  // A whole text may be printed by the format "{}" alone: some function has made the text for its target.
  const std::regex prints(R"(\bfmt::print\(|\bstd::(f?puts|f?printf)\(|\bstd::(cout|cerr)\b)");
  const std::regex prints_whole(R"re(\bfmt::print\((stderr, )?"\{\}(\\n)?",)re");
  const std::regex makes_json(R"(\.dump\()");
  // The bar draws by escape sequences; a check that fails prints in every state of the program.
  const std::set<std::string> may_print{"host/program/bar.cpp", "host/core/error.cpp"};
  size_t printed = 0;
  for (const SourceFile& file : layer_files()) {
    for (size_t i = 0; i < file.lines.size(); ++i) {
      const std::string line = code(file.lines[i]);
      INFO(file.at(i), ": ", line);
      if (file.path != "host/core/escaped_text.hpp") CHECK_FALSE(std::regex_search(line, makes_json));
      if (may_print.contains(file.path) || !std::regex_search(line, prints)) continue;
      CHECK(std::regex_search(line, prints_whole));
      ++printed;
    }
  }
  CHECK(printed > 5);
}
