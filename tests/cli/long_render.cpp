// Renders that are interrupted, killed and taken up again, and pictures in bands.
#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>

#include "host/image/image_file.hpp"
#include "scene.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

using Arguments = std::vector<std::string>;

// The words that render the small scene on the CPU, for a second or two. `bands`: the --band-memory in MiB;
// "1" makes several bands of rows.
Arguments long_render(const SceneFolder& folder, const std::string& name, const std::string& bands = "256") {
  return {"render",
          folder.scene(),
          "-s",
          "300x200",
          "--spp",
          "100",
          "-D",
          "image.pattern=jittered",
          "--backend",
          "twin",
          "--aov",
          "all",
          "--band-memory",
          bands,
          "-o",
          folder / (name + ".pfm"),
          "-o",
          folder / (name + ".png")};
}

Arguments with(Arguments arguments, const Arguments& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// The contents of every file of the picture `name`, by the rest of the file's name.
std::map<std::string, std::string> files_of(const SceneFolder& folder, const std::string& name) {
  std::map<std::string, std::string> files;
  for (const std::string& file : folder.names()) {
    if (file.starts_with(name + ".")) files[file.substr(name.size())] = read_text(folder / file);
  }
  return files;
}

}  // namespace

TEST_CASE("interrupted at any time and resumed, all files are those of an uninterrupted render" *
          doctest::test_suite("long")) {
  const SceneFolder folder;
  Random random(11);
  REQUIRE(run_eyeray(long_render(folder, "whole")).code == 0);
  const auto whole = files_of(folder, "whole");
  const auto aovs = size_t(std::ranges::count_if(
      whole, [](const auto& file) { return file.first != ".pfm" && file.first.ends_with(".pfm"); }));
  CHECK(aovs > 15);
  REQUIRE(whole.size() == 2 + 2 * aovs + 3);  // pictures, AOVs as data and painted, legends of three

  for (const std::string bands : {"256", "1"}) {
    const Arguments command = long_render(folder, "parts", bands);
    const std::string checkpoint = folder / "work";
    int runs = 0;
    ProcessResult result;
    do {
      const bool first = !std::filesystem::exists(checkpoint);
      const int stop = runs < 12 ? 60 + random.below(400) : -1;
      result = run_eyeray(with(command, {first ? "--checkpoint" : "--resume", checkpoint}), {}, 120, stop);
      CAPTURE(result.err);
      REQUIRE((result.code == 0 || result.code == 130));
      // Before the first pixels there is nothing to keep.
      if (result.code == 130 && result.err != "eyeray: error: interrupted\n") {
        REQUIRE(result.err.find(" of the work: to continue, give the same options and --resume " +
                                checkpoint + "\n") != std::string::npos);
      }
      ++runs;
    } while (result.code == 130);
    MESSAGE(fmt::format("band memory {}: {} runs", bands, runs));
    CHECK(runs > 2);
    CHECK(files_of(folder, "parts") == whole);
    // The checkpoint is gone, and only the pictures are left.
    CHECK(folder.names().size() == 1 + 2 * whole.size());
    for (const std::string& name : folder.names()) {
      if (name.starts_with("parts.")) std::filesystem::remove(folder / name);
    }
  }
}

TEST_CASE("the GPU resumes too, and JSON states the resumed samples and rays") {
  const SceneFolder folder;
  const Arguments whole{"render", folder.scene(), "-s", "300x200", "--spp", "16", "-o", folder / "whole.pfm"};
  REQUIRE(run_eyeray(whole).code == 0);
  const Arguments command{"render",
                          folder.scene(),
                          "-s",
                          "300x200",
                          "--spp",
                          "16",
                          "--json",
                          "--quiet",
                          "-o",
                          folder / "parts.pfm",
                          "--band-memory",
                          "1"};
  // Killed, it leaves its last checkpoint. The first band's end is the soonest that rows are finished.
  Process process(with(with({eyeray_binary()}, command),
                       {"--checkpoint", folder / "work", "--checkpoint-every", "0.01"}));
  const Stopwatch watch;
  while (!std::filesystem::exists(folder / "work") && watch.seconds() < 600 && !process.wait(0.001)) {
  }
  process.send_signal(SIGKILL);
  process.wait(600);
  REQUIRE(process.code() == 128 + SIGKILL);

  const ProcessResult rest = run_eyeray(with(command, {"--resume", folder / "work"}));
  CAPTURE(rest.err);
  REQUIRE(rest.code == 0);
  const auto report = nlohmann::json::parse(rest.out);
  CHECK(report.at("bands") == 3);
  CHECK(report.at("resumed").at("samples") > 0);
  CHECK(report.at("rays") > report.at("resumed").at("rays"));
  CHECK_FALSE(report.contains("checkpoint"));
  CHECK(read_text(folder / "parts.pfm") == read_text(folder / "whole.pfm"));
}

TEST_CASE("another scene, size, sampling or backend does not resume, and gets the reason") {
  const SceneFolder folder;
  const std::string checkpoint = folder / "work";
  const Arguments command = long_render(folder, "a");
  Process first(
      with(with({eyeray_binary()}, command), {"--checkpoint", checkpoint, "--checkpoint-every", "0.01"}));
  const Stopwatch watch;
  while (!std::filesystem::exists(checkpoint) && watch.seconds() < 600 && !first.wait(0.005)) {
  }
  first.send_signal(SIGINT);
  REQUIRE(first.wait(600));
  REQUIRE(first.code() == 130);
  const std::string kept = read_text(checkpoint);

  const auto refusal = [&](Arguments arguments) {
    const ProcessResult result = run_eyeray(with(std::move(arguments), {"--resume", checkpoint}));
    CHECK(result.code == 6);
    CHECK(read_text(checkpoint) == kept);
    const std::string start = "eyeray: error: cannot resume from " + checkpoint +
                              ": it was made with other options or files; these differ: ";
    CAPTURE(result.err);
    REQUIRE(result.err.starts_with(start));
    return result.err.substr(start.size());
  };
  const auto changed = [&](const std::string& before, const std::string& after) {
    Arguments arguments = command;
    *std::find(arguments.begin(), arguments.end(), before) = after;
    return refusal(arguments);
  };
  CHECK(changed("300x200", "300x201") ==
        "the size (300x200, now 300x201), the options laid over the scene\n");
  CHECK(changed("100", "64") == "the samples a pixel (100, now 64), the options laid over the scene\n");
  CHECK(changed("image.pattern=jittered", "image.pattern=regular") == "the options laid over the scene\n");
  CHECK(changed("twin", "reference") == "the backend (twin, now reference)\n");
  CHECK(refusal(with(command, {"--clamp", "2"})) == "the --clamp (0, now 2)\n");
  CHECK(refusal(with(command, {"--crop", "0,0,9,9"})) == "the crop (none, now 0,0,9,9)\n");
  replace_in_file(folder.scene(), "radius = 1", "radius = 1.5");
  CHECK(refusal(command) == "the scene\n");
  replace_in_file(folder.scene(), "radius = 1.5", "radius = 1");

  // A new render does not overwrite the checkpoint.
  const ProcessResult again = run_eyeray(with(command, {"--checkpoint", checkpoint}));
  CHECK(again.code == 2);
  CHECK(again.err == "eyeray: error: the checkpoint " + checkpoint +
                         " exists already: continue from it with --resume " + checkpoint +
                         ", or remove it\n");
  CHECK(read_text(checkpoint) == kept);
  CHECK(run_eyeray(with(command, {"--resume", checkpoint})).code == 0);
}

TEST_CASE("a file that is not a checkpoint is reported as an error of that file") {
  const SceneFolder folder;
  const auto refusal = [&](const std::string& file) {
    const ProcessResult result =
        run_eyeray({"render", folder.scene(), "-o", folder / "a.png", "--resume", file});
    CHECK(result.code == 6);
    CHECK(result.err.starts_with("eyeray: error: cannot resume from " + file + ": "));
  };
  refusal(folder / "none");
  refusal(folder.path());
  refusal("/dev/null");
  refusal(folder.scene());
  write_text(folder / "empty", "");
  refusal(folder / "empty");
  const ProcessResult nowhere =
      run_eyeray({"render", folder.scene(), "-o", folder / "a.png", "--checkpoint", folder / "no/work"});
  CHECK(nowhere.code == 4);
  const ProcessResult itself = run_eyeray({"render", folder.scene(), "-o", folder / "a.png", "--checkpoint",
                                           folder / "../" + folder.path().filename().string() + "/a.png"});
  CHECK(itself.code == 2);
  CHECK(itself.err.find(" cannot be both the picture and its checkpoint\n") != std::string::npos);
  CHECK(folder.names() == std::set<std::string>{"scene.toml", "empty"});
}

TEST_CASE("Ctrl-C in a picture of several bands keeps nothing, and names the option that would have") {
  const SceneFolder folder;
  Arguments command = long_render(folder, "a", "1");
  command.emplace_back("--quiet");
  const ProcessResult result = run_eyeray(command, {}, 120, 300);
  CHECK(result.code == 130);
  // The interrupt came before the first pixels, or after some that are lost.
  CHECK((result.err == "eyeray: error: interrupted\n" ||
         result.err == "eyeray: error: interrupted; a picture of 3 bands is complete only at its end, so "
                       "nothing was kept (--checkpoint FILE would keep the work)\n"));
  CHECK(folder.names() == std::set<std::string>{"scene.toml"});
}
