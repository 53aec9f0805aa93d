// Every key of --tune chooses something, and docs/tuning.md has a row for each key.
#include "host/executors/tuning.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "host/executors/executor.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;

namespace {

ExecutorOptions chosen(std::string_view key, std::string_view value) {
  ExecutorOptions options;
  tune(options, fmt::format("{}={}", key, value));
  return options;
}

}  // namespace

TEST_CASE("every value of a key makes a different choice") {
  for (const Tuning& tuning : tunings()) {
    std::vector<ExecutorOptions> seen;
    for (const std::string_view value : tuning.values) {
      CAPTURE(tuning.key);
      CAPTURE(value);
      seen.push_back(chosen(tuning.key, value));
      CHECK(std::ranges::count(seen, seen.back()) == 1);
    }
  }
  CHECK(chosen("acceleration", "brute-force").pack.acceleration == eyeray::engine::Acceleration::brute_force);
  CHECK(chosen("rays", "lanes").gpu.profile.rays == "lanes");
}

TEST_CASE("an unknown key or value is refused") {
  for (const char* wrong :
       {"", "rays", "=lanes", "ray=lanes", "rays=", "rays=lane", "rays=lanes=", "Rays=lanes"}) {
    CAPTURE(wrong);
    ExecutorOptions options;
    CHECK_THROWS_AS(tune(options, wrong), Error);
  }
}

TEST_CASE("docs/tuning.md has a row of each key, and of no other") {
  const std::string page = test::read_text("docs/tuning.md");
  size_t rows = 0;
  for (size_t at = 0; (at = page.find("\n| `", at)) != std::string::npos; ++at) ++rows;
  CHECK(rows == tunings().size());
  for (const Tuning& tuning : tunings()) {
    CAPTURE(tuning.key);
    CHECK(page.find(fmt::format("\n| `{}={}` | {} |\n", tuning.key, fmt::join(tuning.values, "\\|"),
                                tuning.text)) != std::string::npos);
  }
}
