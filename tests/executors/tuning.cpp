// Every key of --tune chooses something, and docs/tuning.md has a row for each key.
#include "host/executors/tuning.hpp"

#include <fmt/ranges.h>

#include <set>

#include "host/executors/executor.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::executors;

namespace {

// The options that a setting results in.
std::string chosen(const std::string& setting) {
  ExecutorOptions options;
  tune(options, setting);
  const ProfileOptions& profile = options.gpu.profile;
  return fmt::format("{} {} {} {} {} {} {} {} {}", int(options.pack.acceleration), options.pack.split,
                     profile.profile, profile.loads, profile.rays, profile.incoherent, profile.stack,
                     options.gpu.constants, options.gpu.optimise);
}

}  // namespace

TEST_CASE("every value of a key makes a different choice") {
  for (const Tuning& tuning : tunings()) {
    std::set<std::string> seen;
    for (const std::string_view value : tuning.values) {
      CAPTURE(tuning.key);
      CAPTURE(value);
      CHECK(seen.insert(chosen(fmt::format("{}={}", tuning.key, value))).second);
    }
  }
  CHECK(chosen("acceleration=brute-force").starts_with("2 false auto"));
  CHECK(chosen("rays=lanes") == "0 false auto  lanes   true true");
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
