// A cache that other users could have changed is not used, and eyeray warns of it once.
#include <sys/stat.h>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_CASE("commands with a device warn once of a cache that they do not use, and write nothing there") {
  const SceneFolder folder;
  const std::string cache = folder / "cache";
  REQUIRE(mkdir(cache.c_str(), 0700) == 0);
  REQUIRE(chmod(cache.c_str(), 0777) == 0);
  const Environment environment{{"EYERAY_CACHE_DIR", cache}};
  const std::string warning = "eyeray: warning: the cache " + cache + " is not used";
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"render", folder.scene(), "-q", "-o", folder / "a.png"},
           {"render", folder.scene(), "-q", "-o", folder / "a.png", "--backend", "twin", "--compile-twin"},
           {"verify", folder.scene(), "-q"},
           {"probe", folder.scene(), "3,3"},
           {"dev", folder.scene(), "--once"}}) {
    CAPTURE(words[0]);
    const ProcessResult result = run_eyeray(words, environment);
    CAPTURE(result.err);
    CHECK(result.code == 0);
    CHECK(count(result.err, warning) == 1);
    CHECK(std::filesystem::is_empty(cache));
  }
  CHECK(run_eyeray({"check", folder.scene()}, environment).err == "");
}

TEST_CASE("Mesa's cache is not used where others may write to it, and a warning says so") {
  const SceneFolder folder;
  const std::string chosen = folder / "mesa", usual = folder / "home/mesa_shader_cache";
  for (const std::string& cache : {chosen, usual}) {
    REQUIRE(std::filesystem::create_directories(cache));
    REQUIRE(chmod(cache.c_str(), 0777) == 0);
  }
  const std::string own = folder / "own";
  for (const Environment& environment : std::vector<Environment>{
           {{"MESA_SHADER_CACHE_DIR", chosen}, {"EYERAY_CACHE_DIR", own}},
           {{"MESA_SHADER_CACHE_DIR", chosen}, {"EYERAY_CACHE_DIR", own}, {"LP_NATIVE_VECTOR_WIDTH", "256"}},
           {{"MESA_GLSL_CACHE_DIR", chosen}, {"EYERAY_CACHE_DIR", own}},
           {{"XDG_CACHE_HOME", folder / "home"}, {"EYERAY_CACHE_DIR", own}}}) {
    const std::string& cache = environment[0].first == "XDG_CACHE_HOME" ? usual : chosen;
    CAPTURE(cache);
    const ProcessResult result =
        run_eyeray({"render", folder.scene(), "-q", "-o", folder / "a.png"}, environment);
    CAPTURE(result.err);
    CHECK(result.code == 0);
    CHECK(count(result.err, "eyeray: warning: Mesa's shader cache " + cache + " is not used") == 1);
    CHECK(std::filesystem::is_empty(cache));
    std::filesystem::remove_all(own);
  }
}
