// Malicious input: it may be refused, but it never crashes eyeray, hangs it or overflows the stack.
#include <sys/stat.h>

#include <fstream>
#include <iterator>
#include <random>

#include "host/core/input_file.hpp"
#include "host/loader/scene_file.hpp"
#include "host/reading/statements.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

std::string repeat(std::string_view text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

// True if the text is refused, with diagnostics that can be shown.
bool refused(const std::string& text) {
  try {
    parse_scene(text, "scene.toml");
    return false;
  } catch (const InputError& error) {
    REQUIRE_FALSE(error.diagnostics().empty());
    for (const Diagnostic& diagnostic : error.diagnostics()) {
      REQUIRE_FALSE(diagnostic.message.empty());
      REQUIRE(format_diagnostic(diagnostic).find('\0') == std::string::npos);
    }
    return true;
  }
}

std::string unreadable(const std::string& path) {
  try {
    load_scene(path);
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::file_io);
    return error.what();
  }
  return "read";
}

}  // namespace

TEST_CASE("deep nesting") {
  constexpr int deep = 200000;
  CHECK(refused("x = " + repeat("[", deep)));
  CHECK(refused("x = " + repeat("{x=", deep)));
  CHECK(refused("x" + repeat(".x", deep) + " = 1"));
  CHECK(refused("[x" + repeat(".x", deep) + "]"));
  CHECK(refused("x" + repeat(".\",=[\"", deep) + " = 1"));
  CHECK(refused("x" + repeat(".'\"'", deep) + " = 1"));
  CHECK(refused("[[x" + repeat(" . x", deep) + "]]\ny = 1"));
  const std::string key = "x" + repeat(".x", 15);
  CHECK(refused("[" + key + "]\n" + key + " = " + repeat("{" + key + " = ", 250) + "1" + repeat("}", 250)));
}

TEST_CASE("large input") {
  constexpr int many = 100000;
  CHECK(refused(repeat("a", 1 << 20)));
  CHECK(refused("[image]\nwidth = \"" + repeat("a", 1 << 20) + "\""));
  CHECK(refused(repeat("[[light]]\n", many)));
  CHECK(refused(repeat("\"", many)));
  CHECK(refused(repeat("x = \n", many)));
  CHECK(refused("[image]\nwidth = " + repeat("9", many)));
  CHECK(
      refused("[[material]]\nname = \"m\"\ntype = \"phong\"\n[[sphere]]\nmaterial = \"m\"\nradius = 1\nbatch "
              "= { center = [" +
              repeat("[1, 2], ", many) + "] }"));
}

TEST_CASE("keys and values are limited over all files of a scene; the error names the position") {
  const auto message = [](const std::string& text) -> std::string {
    try {
      parse_scene(text, "scene.toml");
    } catch (const InputError& error) {
      CHECK(error.diagnostics().size() == 1);
      return format_diagnostic(error.diagnostics()[0]);
    }
    return "accepted";
  };
  // Lists of numbers, tables, keys of two parts, headers of two.
  constexpr std::string_view much = ": error: the scene has more keys and values than eyeray reads";
  const auto starts = [&](const std::string& text, const std::string& location) {
    CAPTURE(text.substr(0, 200));
    return text.starts_with(location + std::string(much));
  };
  CHECK(starts(message("x = [\n" + std::string(size_t{1} << 25, ',') + "]"), "scene.toml:2:33554423"));
  CHECK(starts(message("x = [\n" + repeat("{},", 6'800'000) + "]"), "scene.toml:2:20132653"));
  CHECK(starts(message(repeat("k.k=1\n", 2'100'000)), "scene.toml:2097153:4"));
  CHECK(starts(message(repeat("[[a.b]]\n", 2'800'000)), "scene.toml:2796203:4"));

  // Text in strings and comments does not count, and floats in rows of a list do not count as keys.
  reading::TreeBudget budget;
  CHECK_FALSE(reading::find_excess(
      "x = \"" + std::string(100, '{') + "\" # [[[[\ny = '''" + std::string(100, '[') + "\n'''", budget));
  CHECK(budget.left == (size_t{1} << 25) - 16);
  CHECK_FALSE(reading::find_excess("x = [\n[0.5, 1.5],\n[0.5, 1.5]\n]", budget));
  CHECK(budget.left == (size_t{1} << 25) - 16 - 8 - 3 * 2 - 3);

  const test::TemporaryFolder folder;
  test::write_text(folder / "a.toml", "include = ['b.toml', 'c.toml']\n");
  for (const char* name : {"b.toml", "c.toml"})
    test::write_text(folder / name, "y = [\n" + repeat("#,\n", 10) + std::string(size_t{1} << 24, ',') + "]");
  try {
    load_scene(folder / "a.toml");
    FAIL("accepted");
  } catch (const InputError& error) {
    const std::string what = error.what();
    CHECK(what.find((folder / "c.toml") + ":12:") != std::string::npos);
    CHECK(what.find("the scene has more keys") != std::string::npos);
  }
}

TEST_CASE("groups nest 15 deep by their headers, and deeper by instances") {
  const auto nested = [](int deep) {
    std::string text = "[[material]]\nname = \"m\"\ntype = \"mirror\"\n", path = "group";
    for (int i = 0; i < deep; ++i, path += ".group") text += "[[" + path + "]]\n";
    path.replace(path.size() - 5, 5, "sphere");
    return text + "[[" + path + "]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n";
  };
  CHECK_FALSE(refused(nested(15)));
  try {
    parse_scene(nested(16), "scene.toml");
    FAIL("accepted");
  } catch (const InputError& error) {
    CHECK(std::string(error.what())
              .find("a key can have at most 16 parts; to nest groups deeper, use [[instance]]") !=
          std::string::npos);
  }
}

TEST_CASE("lights are limited; the error names the first one beyond the limit") {
  const std::string light = "[[light]]\ntype = \"point\"\nposition = [0, 1, 0]\nintensity = 1\n";
  CHECK_FALSE(refused(repeat(light, 2048)));
  try {
    parse_scene(repeat(light, 5000), "scene.toml");
    FAIL("accepted");
  } catch (const InputError& error) {
    CHECK(error.what() ==
          std::string("scene.toml:8193:1: error: a scene can have at most 2048 lights\n  [[light]]\n  ^"));
  }
}

TEST_CASE("errors beyond the first thousand are counted") {
  try {
    parse_scene(repeat("[[light]]\n", 1234), "scene.toml");
    FAIL("accepted");
  } catch (const InputError& error) {
    CHECK(error.diagnostics().size() == 1001);
    CHECK(error.diagnostics().back().message == "… and 234 more errors");
  }
}

TEST_CASE("devices, folders, pipes, and missing or too large files are refused") {
  const test::TemporaryFolder folder;
  CHECK(unreadable("/dev/zero") == "cannot read the scene /dev/zero: it is not a regular file");
  CHECK(unreadable(folder.path()) ==
        "cannot read the scene " + folder.path().string() + ": it is a folder; name a scene or a mesh in it");
  CHECK(unreadable("") == "cannot read the scene : No such file or directory");
  CHECK(unreadable(folder / std::string(300, 'x')).ends_with(": File name too long"));

  // A file of /proc has contents, but reports a size of 0 bytes.
  CHECK(!read_input_file("/proc/self/status", "the scene", 1 << 20).empty());
  CHECK_THROWS_WITH_AS(read_input_file("/proc/self/status", "the scene", 10),
                       "cannot read the scene /proc/self/status: it has more than 10 bytes", Error);

  std::ofstream(folder / "whitted.toml") << "";
  CHECK(unreadable(folder / "whited.toml") == "cannot read the scene " + (folder / "whited.toml") +
                                                  ": No such file or directory; did you mean " +
                                                  (folder / "whitted.toml") + "?");
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  CHECK(unreadable(folder / "pipe").ends_with("it is not a regular file"));
  std::ofstream(folder / "huge.toml") << "";
  std::filesystem::resize_file(folder / "huge.toml", (size_t{256} << 20) + 1);
  CHECK(
      unreadable(folder / "huge.toml").ends_with("it has 268435457 bytes; the most is 268435456 (256 MiB)"));
}

TEST_CASE("mutated scenes are either loaded or refused") {
  std::ifstream file("tests/loader/seed.toml", std::ios::binary);
  const std::string seed{std::istreambuf_iterator<char>(file), {}};
  REQUIRE_FALSE(refused(seed));

  // Damage one to eight positions of the text, in the ways of editors, bad disks and fuzzers.
  std::mt19937 random(20240711);
  const auto below = [&](size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(random); };
  constexpr std::string_view tokens[] = {"[",          "]",
                                         "[[",         "]]",
                                         "{",          "}",
                                         ",",          "=",
                                         ".",          "\"",
                                         "'",          "\"\"\"",
                                         "#",          "\n",
                                         "-",          "1e308",
                                         "1e-308",     "nan",
                                         "inf",        "0",
                                         "true",       "\\u",
                                         "é",          "\xff",
                                         "1979-05-27", "99999999999999999999"};
  int loaded = 0;
  int refusals = 0;
  for (int round = 0; round < 6000; ++round) {
    std::string text = seed;
    for (size_t change = 0, changes = 1 + below(8); change < changes && !text.empty(); ++change) {
      const size_t at = below(text.size());
      const size_t length = std::min(1 + below(20), text.size() - at);
      switch (below(6)) {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text.erase(at, length);
          break;
        case 2:
          text.insert(at, tokens[below(std::size(tokens))]);
          break;
        case 3:
          text.replace(at, length, tokens[below(std::size(tokens))]);
          break;
        case 4:
          text.insert(below(text.size()), text.substr(at, length));
          break;
        case 5:
          text.resize(at);
          break;
      }
    }
    ++(refused(text) ? refusals : loaded);
  }
  MESSAGE("loaded " << loaded << ", refused " << refusals);
  CHECK(loaded > 10);
  CHECK(refusals > 1000);
}

TEST_CASE("mutated overrides are either accepted or refused") {
  constexpr std::string_view seeds[] = {"image.width=3",     "camera.eye=[1, 2, 3]",
                                        "sphere.0.radius=2", "material.glass.ior=1.5",
                                        "camera.eye.1=3",    "render.integrator=raycast"};
  std::ifstream file("tests/loader/seed.toml", std::ios::binary);
  const std::string scene{std::istreambuf_iterator<char>(file), {}};
  std::mt19937 random(7);
  const auto below = [&](size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(random); };
  int loaded = 0;
  constexpr int rounds = 3000;
  for (int round = 0; round < rounds; ++round) {
    Override change{std::string(seeds[below(std::size(seeds))])};
    for (size_t i = 0, changes = below(4); i < changes; ++i) {
      const size_t at = below(change.text.size());
      if (below(2) == 0) {
        change.text[at] = "=.[]{}\"'\n 9a-#\0"[below(15)];
      } else {
        change.text.insert(at, change.text.substr(below(change.text.size())));
      }
    }
    try {
      parse_scene(scene, "scene.toml", {&change, 1});
      ++loaded;
    } catch (const InputError&) {
    }
  }
  CHECK(loaded > rounds / 10);
  CHECK(loaded < rounds);
}
