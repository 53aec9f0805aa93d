// Tests the exit of eyeray if a stream, a file, its time or its device fails first.
#include <fmt/format.h>

#include <csignal>

#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// Runs a line of bash in which $EYERAY is the program and $SCENE the scene. `gone` is a pipe nobody reads.
ProcessResult run_line(const SceneFolder& folder, const std::string& line) {
  return run_process(
      {"bash", "-c", "exec {gone}> >(exit); wait $!; cd " + folder.path().string() + "; " + line},
      {{"EYERAY", eyeray_binary()}, {"SCENE", folder.scene()}}, 120);
}

// A render that takes hours. The constructor returns once the render has written a checkpoint.
class LongRender : public Process {
 public:
  explicit LongRender(const SceneFolder& folder, const Environment& environment = {})
      : Process(
            {eyeray_binary(), "render", folder.scene(), "-s", "200x100", "--spp", "65536", "--backend",
             "twin", "--checkpoint", folder / "work", "--checkpoint-every", "0.01", "-o", folder / "a.pfm"},
            environment) {
    const Stopwatch watch;
    while (!std::filesystem::exists(folder / "work") && watch.seconds() < 600 && !wait(0.005)) {
    }
  }
};

}  // namespace

TEST_CASE("a standard error that accepts no text changes neither picture nor exit code") {
  const SceneFolder folder;
  // A warning is the first line printed.
  write_text(folder.scene(), std::string(small_scene) + "[[material]]\nname = \"spare\"\ntype = \"phong\"\n");
  REQUIRE(run_line(folder, "$EYERAY render $SCENE -o whole.png").err.find("warning") != std::string::npos);
  for (const std::string streams :
       {"2>&$gone", "2>/dev/full", "2>&-", "<&- >&- 2>&-", "<&- 2>/dev/full >&$gone"}) {
    CAPTURE(streams);
    CHECK(run_line(folder, "$EYERAY render $SCENE -o a.png " + streams).code == 0);
    CHECK(read_text(folder / "a.png") == read_text(folder / "whole.png"));
    std::filesystem::remove(folder / "a.png");
  }
  CHECK(run_line(folder, "$EYERAY render nowhere.toml 2>&-").code == 4);
}

TEST_CASE("a reader may close standard output; the exit code stays that of the work") {
  const SceneFolder folder;
  REQUIRE(run_line(folder,
                   "$EYERAY render $SCENE -o a.pfm && $EYERAY render $SCENE -o b.pfm -D "
                   "render.background=[1,1,1]")
              .code == 0);
  CHECK(run_line(folder, "$EYERAY check --manual >&$gone").code == 0);
  CHECK(run_line(folder, "$EYERAY compare a.pfm b.pfm >&$gone").code == 1);
  for (const std::string stream : {">&-", ">/dev/full"}) {
    CHECK(run_line(folder, "$EYERAY check --manual " + stream).code == 4);
    CHECK(run_line(folder, "$EYERAY --help " + stream).code == 4);
  }
}

TEST_CASE("exceeding the file size limit is a file error, and leaves no file") {
  const SceneFolder folder;
  const ProcessResult result = run_line(folder, "ulimit -f 1; $EYERAY render $SCENE -o a.pfm");
  CHECK(result.code == 4);
  CHECK(result.err.find("File too large") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"scene.toml"});
  // Mesa 25 keeps its memory in a file too, to which the limit applies. Only the greatest limit leaves room
  // for all of it.
  for (const int kib : {600, 2500, 5000, 7000, 100000}) {
    CAPTURE(kib);
    const ProcessResult limited =
        run_line(folder, fmt::format("ulimit -f {}; $EYERAY render $SCENE -s 640x480 -o a.png", kib));
    CAPTURE(limited.err);
    CHECK((limited.code == 0 || limited.code == 4));
    CHECK((limited.code == 4) == (limited.err.find("File too large") != std::string::npos));
    if (kib == 100000) CHECK(limited.code == 0);
  }
}

TEST_CASE("each signal that ends a render keeps its checkpoint, and shows in the exit code") {
  for (const int signal : {SIGHUP, SIGTERM}) {
    std::signal(signal, SIG_DFL);  // the render inherits that; nohup would ignore SIGHUP
    const SceneFolder folder;
    LongRender render(folder);
    render.send_signal(signal);
    REQUIRE(render.wait(600));
    CAPTURE(render.err());
    CHECK(render.code() == 128 + signal);
    CHECK(render.err().find(" of the work: to continue, give the same options and --resume ") !=
          std::string::npos);
    std::set<std::string> left = folder.names();
    left.erase("a.pfm");  // there if every pixel has a sample
    CHECK(left == std::set<std::string>{"scene.toml", "work"});
  }
}

TEST_CASE("one signal ends a pixel whose rays never end, and the checkpoint is kept") {
  // The picture has two rows, and each is a band. The second shows four walls of glass: each ray splits at
  // each face, up to depth 64.
  std::string scene =
      "[image]\nwidth = 32768\nheight = 2\nsamples = 16\n"
      "[camera]\ntype = \"orthographic\"\neye = [0, 0, 9]\ntarget = [0, 0, 0]\nsize = 1\n"
      "[render]\nmax_depth = 64\nmin_weight = 0\n"
      "[[light]]\ntype = \"point\"\nposition = [0, 5, 9]\n"
      "[[material]]\nname = \"glass\"\ntype = \"dielectric\"\nior = 1.5\n";
  for (const double z : {0, 1, 2, 3})
    scene += fmt::format("[[box]]\nmin = [-1, -1, {}]\nmax = [1, 0, {}]\nmaterial = \"glass\"\n", z, z + 0.5);
  for (const std::string backend : {"twin", "reference"}) {
    CAPTURE(backend);
    const SceneFolder folder;
    write_text(folder.scene(), scene);
    Process render({eyeray_binary(), "render", folder.scene(), "--backend", backend, "--band-memory", "1",
                    "--checkpoint", folder / "work", "--checkpoint-every", "0.01", "-o", folder / "a.pfm"},
                   {});
    const Stopwatch watch;
    while (!std::filesystem::exists(folder / "work") && watch.seconds() < 60 && !render.wait(0.005)) {
    }
    render.send_signal(SIGTERM);
    REQUIRE(render.wait(60));
    CAPTURE(render.err());
    CHECK(render.code() == 143);
    CHECK(render.err().find("to continue, give the same options and --resume ") != std::string::npos);
    CHECK(folder.names().count("work") == 1);
  }
}

TEST_CASE("a device that fails while it works leaves a message, and the checkpoint") {
  const SceneFolder folder;
  // The 30th wait: by then pixels have been rendered.
  const ProcessResult result = run_eyeray(
      {"render", folder.scene(), "--spp", "1024", "--checkpoint", folder / "work", "-o", folder / "a.pfm"},
      {{"EYERAY_VULKAN_LOADER", FAILING_VULKAN}, {"EYERAY_FAILING_CALL", "vkWaitForFences 30 -4"}});
  CHECK(result.code == 3);
  CHECK(result.err.find("eyeray: error: the Vulkan device was lost") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "work"});
}

TEST_CASE("a signal or --timeout ends eyeray even if the driver does not return" *
          doctest::test_suite("long")) {
  const SceneFolder folder;
  // Calls from opening the driver to a dispatch amid the picture.
  for (const std::string call : {"vkCreateInstance 1", "vkEnumeratePhysicalDevices 1", "vkCreateDevice 1",
                                 "vkCreateComputePipelines 2", "vkWaitForFences 10"}) {
    CAPTURE(call);
    const Environment environment{{"EYERAY_VULKAN_LOADER", FAILING_VULKAN},
                                  {"EYERAY_FAILING_CALL", call + " 1000"}};
    std::vector<std::string> arguments{eyeray_binary(), "render", folder.scene(),   "--spp",
                                       "1024",          "-o",     folder / "a.pfm", "--timeout"};
    arguments.push_back("1000");
    Process render(arguments, environment);
    REQUIRE(render.wait_for_error_text("hanging", 60));
    render.send_signal(SIGTERM);
    REQUIRE(render.wait(30));
    CHECK(render.code() == 143);
    CHECK(render.err().find("eyeray: error: interrupted\n") != std::string::npos);

    arguments.back() = "0.5";
    const ProcessResult late = run_process(arguments, environment);
    CHECK(late.code == 5);
    CHECK(late.err.find("within 0.5 s") != std::string::npos);
  }
  CHECK(folder.names() == std::set<std::string>{"scene.toml"});
}

TEST_CASE("a failing pipeline cache does not prevent the picture") {
  const SceneFolder folder;
  for (const std::string call : {"vkCreatePipelineCache 1 -1", "vkGetPipelineCacheData 1 -3"}) {
    const ProcessResult result =
        run_eyeray({"render", folder.scene(), "-o", folder / "a.pfm"},
                   {{"EYERAY_VULKAN_LOADER", FAILING_VULKAN}, {"EYERAY_FAILING_CALL", call}});
    CAPTURE(result.err);
    CHECK(result.code == 0);
  }
}

TEST_CASE("checking a scene holds each image in memory only once") {
  const SceneFolder folder;
  std::filesystem::copy_file("tests/image/pictures/one_bit_4096.png", folder / "big.png");
  std::ofstream(folder / "big.toml") << "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\n"
                                        "[[light]]\ntype = \"point\"\nposition = [9, 9, 9]\n"
                                        "[[material]]\nname = \"m\"\ntype = \"phong\"\n"
                                        "diffuse = { image = \"big.png\" }\n"
                                        "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"m\"\n";
  // The image takes 64 MiB, the program 60.
  const ProcessResult result = run_line(folder, "ulimit -v 160000; $EYERAY check big.toml");
  CAPTURE(result.err);
  CHECK(result.code == 0);
  CHECK(result.out.find("6711") != std::string::npos);  // the image's bytes, as part of the scene's
}

TEST_CASE("exceeding a memory limit gives a message and exit code 3") {
  const SceneFolder folder;
  // Less memory than drivers need, and less than a picture's sums need.
  for (const std::string options : {"", "--backend twin -s 16000x8000 --band-memory 8192"}) {
    const ProcessResult result =
        run_line(folder, "ulimit -v 600000; $EYERAY render $SCENE -o a.pfm " + options);
    CAPTURE(result.err);
    CHECK(result.code == 3);
    CHECK(result.err.starts_with("eyeray: error: "));
    CHECK(result.err.find("(ulimit") != std::string::npos);
  }
  CHECK(run_line(folder, "ulimit -v 600000; $EYERAY render $SCENE -o a.pfm --backend twin").code == 0);
}
