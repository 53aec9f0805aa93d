// eyeray dev, end to end: edits, broken and endless shaders, Ctrl-C.
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "dev.hpp"
#include "host/image/image_file.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::image;
using namespace eyeray::engine::test;

TEST_CASE("dev renders on every save, and survives faulty scenes, faulty shaders and dead workers") {
  const SceneFolder folder;
  const std::string shaders = folder / "shaders";
  REQUIRE(run_eyeray({"shaders", "--export", shaders}).code == 0);
  const std::string pixel = shaders + "/kernels/pixel.glsl";
  const std::string good_shader = read_text(pixel);
  Dev dev(folder, "20");
  REQUIRE(dev.says("gpu: "));
  REQUIRE(dev.says("rendered " + folder / "a.pfm" + " in "));
  REQUIRE(dev.says("watching for changes"));
  CHECK(read_image(folder / "a.pfm").pixel(0, 0)[0] == 0.25f);
  const pid_t worker = dev.worker();
  CHECK(worker > 0);

  // A scene that is saved in place.
  replace_in_file(folder.scene(), "background = [0.25", "background = [0.5");
  REQUIRE(dev.says("rendered "));
  CHECK(read_image(folder / "a.pfm").pixel(0, 0)[0] == 0.5f);

  // A scene that is saved the way careful editors do: the old file becomes a backup, a new one gets its name.
  std::filesystem::rename(folder.scene(), folder / "scene.toml~");
  write_text(folder / "new", replaced(read_text(folder / "scene.toml~"), "[0.5", "[0.125"));
  std::filesystem::rename(folder / "new", folder.scene());
  REQUIRE(dev.says("rendered "));
  CHECK(read_image(folder / "a.pfm").pixel(0, 0)[0] == 0.125f);

  // A broken scene and a broken shader: the position of the fault is named, the picture stays.
  const std::string picture = read_text(folder / "a.pfm");
  replace_in_file(folder.scene(), "radius = 1", "radius = 0");
  REQUIRE(dev.says(folder.scene() + ":26:10: error: "));
  REQUIRE(dev.says("is unchanged"));
  replace_in_file(folder.scene(), "radius = 0", "radius = 1");
  REQUIRE(dev.says("rendered "));
  write_text(pixel, with_pixel_code(good_shader, "  color = nonsense;\n"));
  REQUIRE(dev.says(pixel + ":"));
  REQUIRE(dev.says(": error: "));
  REQUIRE(dev.says("is unchanged"));
  CHECK(read_text(folder / "a.pfm") == picture);

  // A shader that is changed; all so far was done by one process, which kept its caches.
  write_text(pixel, with_pixel_code(good_shader, "  color += 1.0f;\n"));
  REQUIRE(dev.says("rendered "));
  CHECK(read_image(folder / "a.pfm").pixel(0, 0)[0] == 1.125f);
  CHECK(dev.worker() == worker);

  // Saving the same text again renders nothing anew.
  write_text(pixel, read_text(pixel));
  write_text(shaders + "/kernels/nobody_includes.glsl", "nonsense");

  // A worker that dies is replaced at the next save.
  kill(worker, SIGKILL);
  REQUIRE(wait_until_ended(worker));
  write_text(pixel, good_shader);
  REQUIRE(dev.says("rendered "));
  CHECK(read_text(folder / "a.pfm") == picture);

  // Ctrl-C ends it and its worker.
  const pid_t last_worker = dev.worker();
  dev.process().send_signal(SIGINT);
  CHECK(dev.process().wait(600));
  CHECK(dev.process().code() == 130);
  CHECK(wait_until_ended(last_worker));
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "scene.toml~", "shaders", "a.pfm"});
}

TEST_CASE("dev stops a shader that never ends, and renders again after the fix") {
  const SceneFolder folder;
  const std::string pixel = folder / "shaders/kernels/pixel.glsl";
  replace_in_file(folder.scene(), "width = 64\nheight = 48", "width = 256\nheight = 256");
  lay_endless_shader(folder / "shaders");
  Dev dev(folder, "4");
  REQUIRE(dev.says("within 4 s: look for a loop that does not end"));
  REQUIRE(dev.says("watching for changes"));
  CHECK(dev.worker() == 0);
  CHECK_FALSE(folder.names().contains("a.pfm"));

  REQUIRE(run_eyeray({"shaders", "--export", folder / "shaders", "--force"}).code == 0);
  REQUIRE(dev.says("rendered "));
  CHECK(read_image(folder / "a.pfm").pixel(0, 0)[0] == 0.25f);

  // Killed before it can clean up, it leaves no worker behind.
  const pid_t worker = dev.worker();
  CHECK(worker > 0);
  dev.process().send_signal(SIGKILL);
  CHECK(dev.process().wait(600));
  CHECK(wait_until_ended(worker));
}

TEST_CASE("dev --once renders, or reports errors in the formats of editors and workflows") {
  const SceneFolder folder;
  const std::string shaders = folder / "shaders", pixel = shaders + "/kernels/pixel.glsl";
  const auto once = [&](std::vector<std::string> options) {
    options.insert(options.begin(),
                   {"dev", folder.scene(), "--shaders", shaders, "--once", "-o", folder / "a.pfm"});
    return run_eyeray(options);
  };
  REQUIRE(run_eyeray({"shaders", "--export", shaders}).code == 0);
  CHECK(once({}).code == 0);
  CHECK(read_image(folder / "a.pfm").pixel(0, 0)[0] == 0.25f);

  // Two mistakes: both are reported.
  write_text(pixel, with_pixel_code(read_text(pixel), "  color = nonsense;\n  color = more_nonsense;\n"));
  const ProcessResult gcc = once({});
  CHECK(gcc.code == 2);
  CHECK(gcc.err.find("error: 'nonsense': undeclared identifier\n") != std::string::npos);
  CHECK(gcc.err.find("  color = nonsense;\n") != std::string::npos);
  CHECK(gcc.err.find("'more_nonsense'") != std::string::npos);
  CHECK(gcc.err.find("http") == std::string::npos);  // no page
  const std::string github = once({"--diagnostics", "github"}).err;
  CHECK(github.find("::error file=" + pixel + ",line=") != std::string::npos);
  CHECK(github.find("::'more_nonsense'") != std::string::npos);
  const std::string json = once({"--diagnostics", "json"}).err;
  const auto reported = nlohmann::json::parse(json.substr(json.find('{')));
  CHECK(reported.at("diagnostics").size() >= 2);
  CHECK(reported.at("diagnostics").at(0).at("file") == pixel);
  CHECK(reported.at("diagnostics").at(0).at("column").get<int>() > 1);
}

TEST_CASE("dev's page works in a browser as the manual states" * doctest::test_suite("long")) {
  const SceneFolder folder;
  REQUIRE(run_eyeray({"shaders", "--export", folder / "shaders"}).code == 0);
  Dev dev(folder, "60");
  REQUIRE(dev.says("open "));
  const std::string words = dev.process().err();
  const size_t from = words.find("http://");
  const std::string address = words.substr(from, words.find_first_of(" \n", from) - from);
  const ProcessResult result = run_process(
      {"node", "tests/cli/page/drive_dev.mjs", address, folder / "shaders", folder.path()}, {}, 900);
  CAPTURE(result.err);
  CAPTURE(dev.process().err());
  CHECK(result.code == 0);
  for (const char* picture : {"light.png", "failure.png", "dark.png"})
    CHECK(std::filesystem::file_size(folder / picture) > 10'000);
}

TEST_CASE("dev outlives hostile shaders, and keeps the last good picture") {
  const SceneFolder folder;
  const std::string shaders = folder / "shaders", pixel = shaders + "/kernels/pixel.glsl";
  REQUIRE(run_eyeray({"shaders", "--export", shaders}).code == 0);
  const std::string good = read_text(pixel);
  Dev dev(folder, "4");
  REQUIRE(dev.says("rendered "));
  const std::string picture = read_text(folder / "a.pfm");
  const auto back_to_good = [&] {
    write_text(pixel, good);
    REQUIRE(dev.says("rendered "));
    CHECK(read_text(folder / "a.pfm") == picture);
  };

  // So much work that it counts as endless; a newer edit need not wait for its end.
  lay_endless_shader(folder / "endless");
  write_text(pixel, read_text(folder / "endless/kernels/pixel.glsl"));
  REQUIRE(dev.says("pixel.glsl changed"));
  back_to_good();

  SUBCASE("a loop of a milliard iterations") {
    write_text(pixel,
               with_pixel_code(
                   good, "  for (int i = 0; i < 1000000000; ++i) color.x += sin(color.x + float(i));\n"));
    REQUIRE(dev.says("pixel.glsl changed"));
  }
  SUBCASE("NaN as a colour") {
    write_text(pixel, with_pixel_code(good, "  color = vec3(sqrt(-1.0 - color.x * color.x));\n"));
    REQUIRE(dev.says("rendered "));
  }
  SUBCASE("an error in an included file") {
    write_text(shaders + "/kernels/tile.glsl", "nonsense\n" + read_text(shaders + "/kernels/tile.glsl"));
    REQUIRE(dev.says("tile.glsl:1:"));
    CHECK(read_text(folder / "a.pfm") == picture);
    REQUIRE(run_eyeray({"shaders", "--export", shaders, "--force"}).code == 0);
    REQUIRE(dev.says("rendered "));
    CHECK(read_text(folder / "a.pfm") == picture);
    return;
  }
  SUBCASE("other records than the program's") {
    const std::string records = shaders + "/records.h", text = read_text(records);
    write_text(records, "// A comment is no change.\n" + text);
    write_text(pixel, with_pixel_code(good, "  color += 0.0f;\n"));
    REQUIRE(dev.says("rendered "));
    write_text(records, replaced(text, "  uint sample_index;\n", "  uint sample_number;\n"));
    REQUIRE(dev.says("records.h:"));
    REQUIRE(dev.says("eyeray packs scenes by the records.h that it was compiled with"));
    REQUIRE(dev.says("is unchanged"));
    write_text(records, text);
    REQUIRE(dev.says("rendered "));
  }
  SUBCASE("stores beyond the end") {
    const std::string entry = shaders + "/kernels/render.comp.glsl", text = read_text(entry);
    write_text(entry,
               replaced(text, "results[i] = render_sample(", "results[i + 100000000u] = render_sample("));
    REQUIRE(dev.says("render.comp.glsl changed"));
    // Whatever the result, it is reported, and dev is ready for the next edit.
    REQUIRE(dev.says("\n"));
    write_text(entry, text);
    REQUIRE(dev.says("rendered "));
    CHECK(read_text(folder / "a.pfm") == picture);
    return;
  }
  back_to_good();
}

TEST_CASE("dev reports in one sentence that its port is in use, and Ctrl-C ends it during start-up") {
  const SceneFolder folder;
  REQUIRE(run_eyeray({"shaders", "--export", folder / "shaders"}).code == 0);
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  REQUIRE(::bind(socket, reinterpret_cast<sockaddr*>(&address), size) == 0);
  REQUIRE(::listen(socket, 1) == 0);
  REQUIRE(::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0);
  const std::string port = std::to_string(ntohs(address.sin_port));
  Dev dev(folder, "60", {"--port", port});
  CHECK(dev.says("port " + port + " is in use; the page is on port "));
  CHECK(dev.says("open "));
  dev.process().send_signal(SIGINT);
  CHECK(dev.process().wait(600));
  CHECK(dev.process().code() == 130);
  ::close(socket);
}

TEST_CASE("dev reports an error that no save can fix, and ends at once") {
  const SceneFolder folder;
  CHECK(run_eyeray({"dev", folder / "nope.toml"}).code == 4);
  CHECK(run_eyeray({"dev", folder.scene(), "-o", folder / "a.gif"}).code == 2);
  CHECK(run_eyeray({"dev", folder.scene(), "-o", folder / "a.png"},
                   {{"EYERAY_VULKAN_LOADER", "/nonexistent.so"}})
            .code == 3);
  CHECK(run_eyeray({"dev", folder.scene(), "--port", "0"}).code == 2);
  CHECK(folder.names() == std::set<std::string>{"scene.toml"});
}
