// The twin of a user's shaders: it has the bits of the device, and debuggers and sanitizers report its
// faults.
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <csignal>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// Exported shaders, one of which is changed, with a separate cache.
struct Users : SceneFolder {
  Users() {
    if (run_eyeray({"shaders", "--export", shaders}).code != 0)
      throw std::runtime_error("shaders --export failed");
  }
  ProcessResult run(std::vector<std::string> arguments, Environment environment = {}) const {
    environment.emplace_back("EYERAY_CACHE_DIR", *this / "cache");
    arguments.insert(arguments.end(), {"--shaders", shaders});
    return run_eyeray(arguments, environment);
  }
  ProcessResult render(const std::string& backend, const std::string& picture,
                       std::vector<std::string> options = {}, const Environment& environment = {}) const {
    options.insert(options.begin(), {"render", scene(), "--backend", backend, "-o", *this / picture});
    return run(options, environment);
  }
  // Puts `code` where a sphere's hit is returned; returns the number of its first line.
  int change_sphere(const std::string& code) const {
    const std::string before = "  return discriminant > 0.0f ? t : T_NONE;\n";
    replace_in_file(sphere, before, code + before);
    const std::string text = read_text(sphere);
    return 1 + int(std::count(text.begin(), text.begin() + std::ptrdiff_t(text.find(code)), '\n'));
  }

  const std::string shaders = *this / "shaders", sphere = shaders + "/shapes/sphere.glsl";
};

bool contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return true;
  MESSAGE("no '", part, "' in: ", text.substr(0, 4000));
  return false;
}

}  // namespace

TEST_CASE("the twin of a user's shaders has the device's bits, and verify suggests to compile it") {
  const Users users;
  REQUIRE(run_eyeray({"render", users.scene(), "--backend", "twin", "-o", users / "own.pfm"}).code == 0);
  REQUIRE(users.render("twin", "same.pfm").code == 0);
  CHECK(read_text(users / "own.pfm") == read_text(users / "same.pfm"));
  // CXXFLAGS cannot change the float policy. The headers of host/ and glm that are compiled come out of the
  // program itself.
  const Environment fast{
      {"CXXFLAGS", "-O2 -march=native -ffp-contract=fast -MD -MF " + (users / "included")}};
  REQUIRE(users.render("twin", "fast.pfm", {}, fast).code == 0);
  CHECK(read_text(users / "own.pfm") == read_text(users / "fast.pfm"));
  std::istringstream included(read_text(users / "included"));
  for (std::string file; included >> file;) {
    INFO(file);
    const bool ours = file.find("glm/") != std::string::npos || file.find("host/") != std::string::npos;
    CHECK((!ours || file.starts_with(users / "cache/twin/")));
  }

  users.change_sphere("  t = t * 1.0009765625f;\n");
  REQUIRE(users.render("gpu", "gpu.pfm").code == 0);
  REQUIRE(users.render("twin", "twin.pfm").code == 0);
  CHECK(read_text(users / "gpu.pfm") == read_text(users / "twin.pfm"));
  CHECK(read_text(users / "gpu.pfm") != read_text(users / "own.pfm"));
  CHECK(contains(users.run({"verify", users.scene()}).out, "gate A: gpu and twin: "));
  const std::string compiled = users.run({"verify", users.scene(), "--compile-twin"}).out;
  CHECK(contains(compiled, "gate B"));
  CHECK(compiled.find("gate A: gpu and twin: ") == std::string::npos);
}

TEST_CASE("C++ errors in a user's shaders are reported as compilers do, and missing tools too") {
  const Users users;
  const int line = users.change_sphere("  vec3 turned = f.zyx;\n");
  for (const char* const command : {"render", "dev"}) {
    std::vector<std::string> arguments{command, users.scene(), "--backend", "twin"};
    if (arguments[0] == "dev") arguments.push_back("--once");
    const ProcessResult result = users.run(arguments);
    CHECK(result.code == 2);
    CHECK(contains(result.err, fmt::format("{}:{}:", users.sphere, line)));
    CHECK(contains(result.err, ": error: "));
    CHECK(contains(result.err, "vec3 turned = f.zyx;\n"));
  }
  const Environment no_compiler{{"PATH", "/nowhere"}, {"CXX", ""}};
  CHECK(contains(users.render("twin", "a.pfm", {}, no_compiler).err, "needs a C++ compiler"));
  const ProcessResult dev = users.run({"dev", users.scene(), "--backend", "twin", "--once"}, no_compiler);
  CHECK(dev.code == 0);
  CHECK(contains(dev.err, "twin: the shaders as C++"));
  CHECK(contains(dev.err,
                 "warning: this is the twin of eyeray's own shaders: to compile those of " + users.shaders));
}

TEST_CASE("the twin of eyeray's own shaders can be compiled, too") {
  const Users users;
  const auto render = [&](const std::string& picture, const std::vector<std::string>& more) {
    std::vector<std::string> words{"render", users.scene(), "--backend", "twin", "-o", users / picture};
    words.insert(words.end(), more.begin(), more.end());
    return run_eyeray(words, {{"EYERAY_CACHE_DIR", users / "cache"}});
  };
  const ProcessResult compiled = render("a.pfm", {"--compile-twin"});
  CAPTURE(compiled.err);
  CHECK(compiled.code == 0);
  REQUIRE(render("b.pfm", {}).code == 0);
  CHECK(read_text(users / "a.pfm") == read_text(users / "b.pfm"));
}

TEST_CASE("files that others may write to are not loaded, and damaged ones are written anew") {
  const Users users;
  REQUIRE(users.render("twin", "a.pfm").code == 0);
  const std::string twin = users / "cache/twin";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(twin)) {
    if (entry.path().filename() == "vec3.hpp") write_text(entry.path(), "damaged");
    if (entry.path().extension() == ".so") std::filesystem::remove(entry.path());
  }
  REQUIRE(users.render("twin", "b.pfm").code == 0);
  CHECK(read_text(users / "a.pfm") == read_text(users / "b.pfm"));

  std::filesystem::remove_all(twin);
  REQUIRE(std::filesystem::create_directory(twin));
  REQUIRE(chmod(twin.c_str(), 0777) == 0);
  const Environment elsewhere{{"TMPDIR", users / "scratch"}};
  REQUIRE(std::filesystem::create_directory(users / "scratch"));
  REQUIRE(users.render("twin", "c.pfm", {}, elsewhere).code == 0);
  CHECK(read_text(users / "a.pfm") == read_text(users / "c.pfm"));
  CHECK(std::filesystem::is_empty(twin));
  CHECK(std::filesystem::is_empty(users / "scratch"));
}

TEST_CASE("sanitizers find a user's shader's fault, at its line") {
  const Users users;
  const int line = users.change_sphere(
      "  float bands[4];\n"
      "  for (int i = 0; i < 4; ++i) bands[i] = 0.0f;\n"
      "  t = t + bands[int(floor(abs(t) * 2.0f))];\n");
  const std::string location = fmt::format("{}:{}", users.sphere, line + 2);
  const ProcessResult undefined = users.render("twin", "a.pfm", {"--sanitize", "undefined"});
  CHECK(undefined.code == 2);
  CHECK(contains(undefined.err, location + ":"));
  CHECK(contains(undefined.err, "runtime error: index 6 out of bounds for type 'float"));
  const ProcessResult address = users.render("twin", "a.pfm", {"--sanitize", "address"});
  CHECK(address.code == 2);
  CHECK(contains(address.err, "AddressSanitizer: stack-buffer-overflow"));
  CHECK(contains(address.err, location));
  // The same holds in dev's worker.
  const ProcessResult dev =
      users.run({"dev", users.scene(), "--backend", "twin", "--once", "--sanitize", "address,undefined"});
  CHECK(dev.code == 2);
  CHECK(contains(dev.err, location + ":"));
  CHECK_FALSE(std::filesystem::exists(users / "a.pfm"));

  CHECK(
      contains(users.render("twin", "a.pfm", {"--sanitize", "thread"}).err, "--sanitize must be address, "));
}

TEST_CASE("a shader without faults renders under a sanitizer, and the program ends") {
  const Users users;
  const ProcessResult result = users.render("twin", "a.pfm", {"--sanitize", "address"});
  CAPTURE(result.err);
  CHECK(result.code == 0);
  CHECK(std::filesystem::exists(users / "a.pfm"));
}

TEST_CASE("a debugger stops in a user's shader, which may print") {
  const Users users;
  const int line = users.change_sphere(
      "#ifdef __cplusplus\n"
      "  printf(\"t = %.9g\\n\", t);\n"
      "#endif\n"
      "  PROBE(middle, f);\n");
  const std::vector<std::string> probe{"probe", users.scene(), "32,24",       "--backends",
                                       "twin",  "--shaders",   users.shaders, "--compile-twin"};
  std::vector<std::string> gdb{"gdb", "-nx", "-batch"};
  const std::string stop = fmt::format("break shaders/shapes/sphere.glsl:{}", line + 3);
  for (const char* const command : {"set breakpoint pending on", stop.c_str(), "run", "print t", "print f",
                                    "backtrace 1", "up", "info source"})
    gdb.insert(gdb.end(), {"-ex", command});
  gdb.insert(gdb.end(), {"--args", eyeray_binary()});
  gdb.insert(gdb.end(), probe.begin(), probe.end());
  const ProcessResult debugged =
      run_process(gdb, {{"EYERAY_CACHE_DIR", users / "cache"}, {"DEBUGINFOD_URLS", ""}}, 600);
  CHECK(contains(debugged.out, "PROBE(middle, f);"));
  CHECK(contains(debugged.out, "{x = 0, y = 0, z = 4}"));
  CHECK(contains(debugged.out, "bvh/traverse.glsl"));

  const ProcessResult probed =
      users.run({"probe", users.scene(), "32,24", "--backends", "twin,gpu", "--compile-twin"});
  CHECK(probed.code == 0);
  CHECK(contains(probed.out, "t = "));
  CHECK(contains(probed.out, "middle"));
}

TEST_CASE("dev renders the twin of a user's shaders on every save") {
  const Users users;
  Process dev({eyeray_binary(), "dev", users.scene(), "--shaders", users.shaders, "--backend", "twin",
               "--no-page", "-o", users / "a.pfm"},
              {{"EYERAY_CACHE_DIR", users / "cache"}});
  REQUIRE(dev.wait_for_error_text("watching for changes", 600));
  CHECK(contains(dev.err(), "twin: " + users.shaders + " as C++, by "));
  const std::string picture = read_text(users / "a.pfm");
  const size_t seen = dev.err().size();
  users.change_sphere("  t = t * 1.0009765625f;\n");
  REQUIRE(dev.wait_for_error_text("rendered ", 600, seen));
  CHECK(read_text(users / "a.pfm") != picture);
  dev.send_signal(SIGINT);
  CHECK(dev.wait(600));
}
