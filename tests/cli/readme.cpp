// README.md shows a report of `eyeray verify`; a real run reports the same gates.
#include <sstream>

#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("the report in README.md has today's counts") {
  const ProcessResult result = run_eyeray({"verify", "scenes/whitted.toml"});
  CHECK(result.code == 0);
  const std::string readme = read_text("README.md");
  std::istringstream lines(result.out);
  int gates = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  gate")) continue;
    CAPTURE(line);
    CHECK(readme.find("\n" + line + "\n") != std::string::npos);
    ++gates;
  }
  CHECK(gates == 5);
}
