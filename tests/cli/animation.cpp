// render --frames and --video.
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "host/image/image_file.hpp"
#include "scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

constexpr const char* moving = R"(
[animation]
frames_per_second = 25
[[track]]
target = "sphere.0.center"
keyframes = [[0, [-2, 1, 0]], [10, [2, 1, 0]]]
)";

// The small scene, whose ball goes from left to right in ten frames.
class MovingFolder : public SceneFolder {
 public:
  MovingFolder() { write_text(scene(), std::string(small_scene) + moving); }
};

}  // namespace

TEST_CASE("--frames renders each frame as -D animation.frame does, to files named by number") {
  const MovingFolder folder;
  const ProcessResult result = run_eyeray(
      {"render", folder.scene(), "--frames", "0:8:4", "-o", folder / "f%03d.pfm", "--json", "--quiet"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "f000.pfm", "f004.pfm", "f008.pfm"});
  const auto output = nlohmann::json::parse(result.out);
  REQUIRE(output.at("frames").size() == 3);
  CHECK(output.at("frames")[1].at("frame") == 4);
  CHECK(output.at("kept") == 0);

  CHECK(run_eyeray({"render", folder.scene(), "-D", "animation.frame=4", "-o", folder / "one.pfm", "--quiet"})
            .code == 0);
  CHECK(read_text(folder / "one.pfm") == read_text(folder / "f004.pfm"));
  CHECK(read_text(folder / "one.pfm") != read_text(folder / "f008.pfm"));
}

TEST_CASE("existing frames are kept, unless --overwrite is given") {
  const MovingFolder folder;
  write_text(folder / "f1.png", "mine");
  const std::vector<std::string> command = {"render", folder.scene(), "--frames",
                                            "0:1",    "-o",           folder / "f%d.png"};
  const ProcessResult first = run_eyeray(command);
  CHECK(first.code == 0);
  CHECK(first.err.find("1 of 2 frames existed and are kept") != std::string::npos);
  CHECK(read_text(folder / "f1.png") == "mine");
  std::vector<std::string> again = command;
  again.push_back("--overwrite");
  CHECK(run_eyeray(again).code == 0);
  CHECK(read_text(folder / "f1.png").substr(1, 3) == "PNG");
}

TEST_CASE("a shard of frames is every N-th frame, whole") {
  const MovingFolder folder;
  const auto render = [&](const char* shard) {
    return run_eyeray({"render", folder.scene(), "--frames", "1:5", "--shard", shard, "-o", folder / "%d.pfm",
                       "--quiet"})
        .code;
  };
  CHECK(render("2/3") == 0);
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "2.pfm", "5.pfm"});
  CHECK(render("1/3") == 0);
  CHECK(render("3/3") == 0);
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "1.pfm", "2.pfm", "3.pfm", "4.pfm", "5.pfm"});
}

TEST_CASE("--frames films a glTF file by itself, if the file is animated") {
  const TemporaryFolder folder;
  const auto film = [&](const char* file) {
    return run_eyeray(
        {"render", file, "--frames", "0:40:20", "-s", "48x48", "-o", folder / "%d.pfm", "--quiet"});
  };
  const ProcessResult still = film("scenes/meshes/mill.gltf");
  CHECK(still.code == 2);
  CHECK(still.err.find("shows no animation of a glTF file") != std::string::npos);
  CHECK(film("scenes/meshes/flower.gltf").code == 0);
  const auto picture = [&](const char* name) { return read_text(folder / name); };
  CHECK(picture("0.pfm") != picture("20.pfm"));
  CHECK(picture("20.pfm") != picture("40.pfm"));
}

TEST_CASE("errors in frames are reported before anything is rendered") {
  const MovingFolder folder;
  const auto error = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"render", folder.scene()});
    const ProcessResult result = run_eyeray(options);
    CHECK(result.code == 2);
    CHECK(folder.names() == std::set<std::string>{"scene.toml"});
    return result.err;
  };
  const auto says = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(says(error({"--frames", "5"}), "FIRST:LAST"));
  CHECK(says(error({"--frames", "5:1"}), "FIRST:LAST"));
  CHECK(says(error({"--frames", "0:9:0"}), "FIRST:LAST"));
  CHECK(says(error({"--frames", "0:x"}), "FIRST:LAST"));
  CHECK(says(error({"--frames", "0:9999999"}), "FIRST:LAST"));
  CHECK(says(error({"--frames", "0:1", "-o", folder / "a.png"}), "%04d"));
  CHECK(says(error({"--frames", "0:1", "-o", folder / "a%s.png"}), "%04d"));
  CHECK(says(error({"--frames", "0:1", "-o", folder / "%d%d.png"}), "%04d"));
  CHECK(says(error({"--frames", "0:1", "-o", folder / "%d.pfm", "--video", folder / "a.mp4"}), ".png"));
  CHECK(says(error({"--frames", "0:1", "--video", folder / "a.avi"}), ".mp4"));
  CHECK(says(error({"--video", folder / "a.mp4"}), "--frames"));
  CHECK(says(error({"--overwrite"}), "--frames"));
  write_text(folder.scene(), small_scene);
  CHECK(says(error({"--frames", "0:1"}), "no [[track]]"));
}

TEST_CASE("--video gives ffmpeg the frames in order, and the video appears only when complete") {
  const MovingFolder folder;
  // A stand-in for ffmpeg: copies the list of frames to `list`, and writes the file that its last argument
  // names. It fails if BROKEN is set.
  const std::string bin = folder / "bin";
  mkdir(bin.c_str(), 0755);
  write_text(bin + "/ffmpeg", R"(#!/bin/sh
[ "$1" = -version ] && exit 0
while [ "$1" != -i ]; do shift; done
cat "$2" > ")" + folder.path().string() +
                                  R"(/list"
for last; do :; done
echo half > "$last"
[ -z "$BROKEN" ] || { echo "no such codec" >&2; exit 1; }
echo video > "$last"
)");
  chmod((bin + "/ffmpeg").c_str(), 0755);
  const Environment environment = {{"PATH", bin + ":/usr/bin:/bin"}};
  const std::vector<std::string> command = {
      eyeray_binary(),          "render",  folder.scene(), "--frames",      "2:4", "-o",
      folder / "it's %02d.png", "--quiet", "--video",      folder / "a.mp4"};
  Environment broken = environment;
  broken.emplace_back("BROKEN", "1");
  const ProcessResult failed = run_process(command, broken);
  CHECK(failed.code == 4);
  CHECK(failed.err.find("no such codec") != std::string::npos);
  CHECK_FALSE(folder.names().contains("a.mp4"));

  CHECK(run_process(command, environment).code == 0);
  CHECK(read_text(folder / "a.mp4") == "video\n");
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "bin", "list", "a.mp4", "it's 02.png",
                                                "it's 03.png", "it's 04.png"});
  const std::string list = read_text(folder / "list");
  CHECK(list.find("it'\\''s 02.png'\nduration 0.04\nfile '") != std::string::npos);

  std::vector<std::string> transparent = command;
  transparent.emplace_back("--transparent");
  const ProcessResult refused = run_process(transparent, environment);
  CHECK(refused.code == 2);
  CHECK(refused.err == "eyeray: error: a video has no alpha: leave out --video, or the transparency\n");

  const ProcessResult none = run_process(command, {{"PATH", "/nowhere"}});
  CHECK(none.code == 4);
  CHECK(none.err.find("Debian: ffmpeg") != std::string::npos);
}

TEST_CASE("an open shutter blurs the picture, in shards as in one piece") {
  const MovingFolder folder;
  const auto render = [&](const std::string& output, std::vector<std::string> more) {
    more.insert(more.begin(), {"render", folder.scene(), "-D", "animation.frame=5", "-D",
                               "image.pattern=sobol", "--spp", "16", "-o", folder / output, "--quiet"});
    const ProcessResult result = run_eyeray(more);
    CAPTURE(result.err);
    CHECK(result.code == 0);
  };
  const std::vector<std::string> open = {"-D", "animation.shutter=2"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), open.begin(), open.end());
    return more;
  };
  render("sharp.pfm", {});
  render("blurred.pfm", open);
  CHECK(read_text(folder / "sharp.pfm") != read_text(folder / "blurred.pfm"));
  render("twin.pfm", with({"--backend", "twin"}));
  CHECK(read_text(folder / "twin.pfm") == read_text(folder / "blurred.pfm"));
  render("1.eyeray", with({"--shard", "1/2"}));
  render("2.eyeray", with({"--shard", "2/2"}));
  CHECK(
      run_eyeray({"merge", folder / "1.eyeray", folder / "2.eyeray", "-o", folder / "merged.pfm", "--quiet"})
          .code == 0);
  CHECK(read_text(folder / "merged.pfm") == read_text(folder / "blurred.pfm"));
  CHECK(run_eyeray({"check", folder.scene(), "-D", "animation.shutter=-1"}).code == 2);
}

TEST_CASE("--point-size changes the picture of a scan; other files have no use for it") {
  const TemporaryFolder folder;
  const auto render = [&](const char* size, const std::string& picture) {
    return run_eyeray({"render", "scenes/meshes/vase.xyz", "--point-size", size, "--look", "plain", "-s",
                       "32x24", "-o", folder / picture, "--quiet"});
  };
  CHECK(render("0.03", "small.pfm").code == 0);
  CHECK(render("0.3", "large.pfm").code == 0);
  CHECK(read_text(folder / "small.pfm") != read_text(folder / "large.pfm"));
  const ProcessResult none = render("0", "none.pfm");
  CHECK(none.code == 2);
  CHECK(none.err.find("--point-size 0: a point size is a number above 0") != std::string::npos);
  CHECK(run_eyeray({"check", "scenes/meshes/ring.ply", "--point-size", "1"})
            .err.find("has no points, so --point-size changes nothing") != std::string::npos);
  CHECK(run_eyeray({"check", "scenes/whitted.toml", "--point-size", "1"}).code == 2);
}

TEST_CASE("--up, --line-width, --gltf-scene and --variant change how a file alone is shown") {
  const TemporaryFolder folder;
  size_t pictures = 0;
  const auto shown = [&](const std::string& file, const std::vector<std::string>& options) {
    const std::string picture = folder / fmt::format("{}.pfm", pictures++);
    std::vector<std::string> all{"render", file, "--look", "plain", "-s", "32x24", "-o", picture};
    all.insert(all.end(), options.begin(), options.end());
    const ProcessResult result = run_eyeray(all);
    CHECK(result.code == 0);
    CHECK(result.err.find("left out") == std::string::npos);
    return read_text(picture);
  };
  const std::string wires = "scenes/meshes/wires.obj", dots = "scenes/meshes/dots.gltf";
  const std::string thin = shown(wires, {"--line-width", "0.05"});
  CHECK(thin != shown(wires, {"--line-width", "0.2"}));
  CHECK(thin != shown(wires, {"--line-width", "0.05", "--up", "z"}));
  CHECK(shown(wires, {"--line-width", "0.05", "--up", "y"}) == thin);
  const std::string bright = shown(dots, {});
  CHECK(shown(dots, {"--variant", "bright"}) == bright);
  CHECK(shown(dots, {"--variant", "dark"}) != bright);
  CHECK(shown(dots, {"--gltf-scene", "large"}) == bright);
  CHECK(shown(dots, {"--gltf-scene", "small", "--point-size", "0.2"}) !=
        shown(dots, {"--point-size", "0.2"}));

  const auto complaint = [](std::initializer_list<std::string> options) {
    std::vector<std::string> all{"check"};
    all.insert(all.end(), options);
    return run_eyeray(all);
  };
  const ProcessResult variant = complaint({dots, "--variant", "blue"});
  CHECK(variant.code == 2);
  CHECK(variant.err.find("the file has no variant \"blue\"; it has \"bright\", \"dark\"") !=
        std::string::npos);
  CHECK(complaint({dots, "--up", "z"}).err.find("+y is up in glTF") != std::string::npos);
  CHECK(complaint({dots, "--line-width", "1"}).err.find("has no lines, so --line-width changes nothing") !=
        std::string::npos);
  CHECK(complaint({"scenes/whitted.toml", "--up", "z"}).code == 2);
}

TEST_CASE("--turntable turns a mesh alone once; a scene has none") {
  const TemporaryFolder folder;
  const auto turn = [&](const std::string& scene, const char* frames) {
    return run_eyeray({"render", scene, "--turntable", frames, "--look", "plain", "-s", "32x24", "-o",
                       folder / "%d.pfm", "--quiet"});
  };
  CHECK(turn("scenes/meshes/ring.ply", "3").code == 0);
  CHECK(folder.names() == std::set<std::string>{"0.pfm", "1.pfm", "2.pfm"});
  CHECK(read_text(folder / "0.pfm") != read_text(folder / "1.pfm"));
  CHECK(run_eyeray({"render", "scenes/meshes/ring.ply", "-D", "turntable=3", "-D", "animation.frame=2",
                    "--look", "plain", "-s", "32x24", "-o", folder / "two.pfm", "--quiet"})
            .code == 0);
  CHECK(read_text(folder / "2.pfm") == read_text(folder / "two.pfm"));

  const ProcessResult scene = turn("scenes/whitted.toml", "3");
  CHECK(scene.code == 2);
  CHECK(scene.err.find("--look plain: a look is for a mesh alone, and scenes/whitted.toml is a scene") !=
        std::string::npos);
  const ProcessResult once = turn("scenes/meshes/ring.ply", "1");
  CHECK(once.code == 2);
  CHECK(once.err.find("--turntable") != std::string::npos);
}
