// Values written into a scene's text.
#include "host/loader/scene_edit.hpp"

#include "host/core/error.hpp"
#include "host/loader/scene_file.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

std::string edited(const std::string& text) {
  return with_value(text, "verify", "max_explained", "0.00042");
}

}  // namespace

TEST_CASE("a new value replaces the old one, and the rest of the file is unchanged") {
  CHECK(edited("[verify]\nmax_explained = 0.01\n") == "[verify]\nmax_explained = 0.00042\n");
  CHECK(edited("# kept\n[verify] # too\n  max_explained=1e-3 # and this\r\n[image]\nwidth = 8") ==
        "# kept\n[verify] # too\n  max_explained=0.00042 # and this\r\n[image]\nwidth = 8");
  CHECK(edited("verify = { max_explained = 0.01 }\n") == "verify = { max_explained = 0.00042 }\n");
  CHECK(edited("verify.max_explained = 0.01") == "verify.max_explained = 0.00042");
  CHECK(edited("[image]\nwidth = 8\n# max_explained = 3\n[verify]\nmax_explained = 0") ==
        "[image]\nwidth = 8\n# max_explained = 3\n[verify]\nmax_explained = 0.00042");
  CHECK(edited("[verify]\n\"max_explained\" = 0.01\n") == "[verify]\n\"max_explained\" = 0.00042\n");
  CHECK(edited("verify = { \"é max_explained = 1\" = 2, max_explained = 0.01 }") ==
        "verify = { \"é max_explained = 1\" = 2, max_explained = 0.00042 }");
}

TEST_CASE("a missing value becomes a new line of its table, or a new table at the end") {
  CHECK(edited("") == "\n[verify]\nmax_explained = 0.00042\n");
  CHECK(edited("[image]\nwidth = 8") == "[image]\nwidth = 8\n\n[verify]\nmax_explained = 0.00042\n");
  CHECK(edited("[verify]\n[image]\nwidth = 8\n") ==
        "[verify]\nmax_explained = 0.00042\n[image]\nwidth = 8\n");
  CHECK(edited("[verify]") == "[verify]\nmax_explained = 0.00042\n");
  CHECK(parse_scene(edited("[image]\nwidth = 8\n[verify]\n"), "scene.toml").verify.max_explained == 0.00042);
}

TEST_CASE("invalid TOML is reported, and not changed") {
  CHECK_THROWS_AS(edited("v 1 2 3\nf 1 2 3\n"), Error);
}

TEST_CASE("a table without a line of its own is not edited") {
  CHECK_THROWS_WITH_AS(
      edited("verify = {}\n"),
      "write max_explained = 0.00042 into `verify` by hand: the table has no header on a line of its own",
      Error);
}
