#include "host/core/diagnostic.hpp"

#include <array>
#include <sstream>
#include "tests/support/nasty_strings.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

TEST_CASE("a diagnostic shows position, message and source line") {
  CHECK(format_diagnostic({Severity::error, {"a.toml", 12, 5}, "wrong", "x = 1.2", 1}) ==
        "a.toml:12:5: error: wrong\n  x = 1.2\n      ^");
  CHECK(format_diagnostic({Severity::warning, {"a.toml", 12, 0}, "odd", "x = 1.2", 1}) ==
        "a.toml:12: warning: odd\n  x = 1.2");
  CHECK(format_diagnostic({Severity::error, {"-D x=1", 0, 0}, "wrong", "", 1}) == "-D x=1: error: wrong");
  CHECK(format_diagnostic({Severity::error, {"", 0, 0}, "wrong", "", 1}) == "error: wrong");
}

TEST_CASE("the caret is under the column, after tabs, long characters and a cut") {
  CHECK(format_diagnostic({Severity::error, {"a", 1, 4}, "m", "\t\"é\" 1", 1}) ==
        "a:1:4: error: m\n  \t\"é\" 1\n  \t  ^");
  CHECK(format_diagnostic({Severity::error, {"a", 1, 103}, "m", "12345", 101}) ==
        "a:1:103: error: m\n  …12345\n     ^");
  CHECK(format_diagnostic({Severity::error, {"a", 1, 99}, "m", "12", 1}) == "a:1:99: error: m\n  12\n    ^");
}

TEST_CASE("only the part of a long line around the column is shown") {
  const std::string line = std::string(5'000'000, ' ') + "x\x01y" + std::string(5'000'000, ' ');
  Diagnostic diagnostic{Severity::error, {"a", 1, 5'000'001}, "m", "", 1};
  show_source_line(diagnostic, line);
  const std::string shown = format_diagnostic(diagnostic);
  CHECK(shown.size() < 400);
  CHECK(shown.find("x?y") != std::string::npos);
  // The caret stands under the x: one character before it is the sign of the cut.
  const size_t text = shown.find("\n") + 1, caret = shown.rfind("\n") + 1;
  CHECK(shown.find('^') - caret + std::string("…").size() - 1 == shown.find('x', text) - text);

  diagnostic.position.column = 0;
  show_source_line(diagnostic, line);
  CHECK(format_diagnostic(diagnostic).size() < 400);
  show_source_line(diagnostic, "short", 3);
  CHECK(diagnostic.source_line == "short");
  CHECK(diagnostic.source_column == 3);
}

TEST_CASE("no text of a file acts as a command to a terminal or to GitHub's workflows") {
  for (const std::string& text : test::nasty_strings) {
    CAPTURE(text);
    for (const bool in_file : {false, true}) {
      Diagnostic diagnostic{Severity::error, {in_file ? text : "a.toml", 1, 3}, in_file ? "m" : text, "", 1};
      show_source_line(diagnostic, text);
      std::istringstream lines(format_diagnostic(diagnostic));
      int count = 0;
      for (std::string line; std::getline(lines, line); ++count) {
        CHECK(line == printable(line));
        CHECK(line.find("##[") == std::string::npos);
        const size_t first = line.find_first_not_of(" \t");
        CHECK((first == std::string::npos || line.compare(first, 2, "::") != 0));
      }
      CHECK(count == 3);
    }
  }
}

TEST_CASE("an InputError reports all its diagnostics") {
  const InputError error(
      {{Severity::error, {"a", 1, 1}, "x", "", 1}, {Severity::error, {"b", 2, 1}, "y", "", 1}});
  CHECK(std::string(error.what()) == "a:1:1: error: x\nb:2:1: error: y");
  CHECK(error.code() == ExitCode::bad_input);
  CHECK(error.diagnostics().size() == 2);
}

TEST_CASE("the nearest name is found, unless all names are too different") {
  constexpr std::array<std::string_view, 5> names = {"radius", "center", "material", "up", "eye"};
  CHECK(nearest_name("radis", names) == "radius");
  CHECK(nearest_name("centre", names) == "center");  // neighbours swapped count once
  CHECK(nearest_name("matrial", names) == "material");
  CHECK(nearest_name("matreail", names) == "material");
  CHECK(nearest_name("op", names) == "up");
  CHECK(nearest_name("radius", names) == "radius");
  CHECK(nearest_name("diameter", names) == "");
  CHECK(nearest_name("xy", names) == "");
  CHECK(nearest_name("", names) == "");
  CHECK(nearest_name(std::string(100000, 'a'), names) == "");
}
