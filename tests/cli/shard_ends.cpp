// Shards that end before their time: killed, or with a folder that is full, gone or of another time.
#include <sched.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "parts.hpp"
#include "tests/support/random.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// The words of a render that takes a second or two on the CPU.
Words long_picture(const SceneFolder& folder, const std::string& samples = "64") {
  return {"render", folder.scene(),           "-s",        "300x200", "--spp",  samples,
          "-D",     "image.pattern=jittered", "--backend", "twin",    "--quiet"};
}

// Waits for the file, or the program's end.
void wait_for_file(Process& process, const std::string& file) {
  while (!std::filesystem::exists(file) && !process.wait(0.01)) continue;
}

// Words before a program's, which restrict it to one processor and so to one thread.
Words on_one_processor() {
  cpu_set_t set;
  REQUIRE(sched_getaffinity(0, sizeof set, &set) == 0);
  int first = 0;
  while (!CPU_ISSET(first, &set)) ++first;
  return {"taskset", "-c", std::to_string(first)};
}

// Kills shards at random times, `kills` times in all, and starts each again until it is done. Each run has
// all processors or one.
void kill_and_repeat(int kills) {
  const SceneFolder folder;
  Random random(20);
  const Words picture = long_picture(folder) + Words{"--aov", "rays,noise,depth"};
  const ProcessResult whole = run_eyeray(picture + Words{"--json", "--stats", "-o", folder / "whole.exr"});
  REQUIRE(whole.code == 0);
  constexpr int count = 4;
  int killed = 0, resumed = 0;
  for (int i = 1; killed < kills || i <= count; ++i) {
    const int index = (i - 1) % count + 1;
    const std::string part = part_of(folder, index, count), checkpoint = part + ".work";
    std::filesystem::remove(part);
    while (!std::filesystem::exists(part)) {
      const bool resumes = std::filesystem::exists(checkpoint);
      resumed += resumes;
      Process process(
          (random.below(2) ? on_one_processor() : Words()) + Words{eyeray_binary()} + picture +
          words_of_part(folder, index, count) +
          Words{"--stats", resumes ? "--resume" : "--checkpoint", checkpoint, "--checkpoint-every", "0.02"});
      const bool kill = killed < kills && random.below(4) > 0;
      // The kill comes at any time, or only after a checkpoint exists, however fast the machine is.
      if (kill && random.below(4) > 0) wait_for_file(process, checkpoint);
      if (!process.wait(kill ? random.below(300) * 0.001 : 3600) && kill) {
        process.send_signal(SIGKILL);
        process.wait(600);
        ++killed;
      }
      CAPTURE(process.err());
      REQUIRE((process.code() == 0 || process.code() == 128 + SIGKILL));
      // A file that has the part's name is complete.
      if (std::filesystem::exists(part)) {
        CHECK(process.code() == 0);
        CHECK_FALSE(std::filesystem::exists(checkpoint));
      }
    }
  }
  MESSAGE(fmt::format("{} killed, {} resumed", killed, resumed));
  CHECK(resumed > kills / 10);
  const ProcessResult merged =
      run_eyeray(Words{"merge", "--json"} + all_parts(folder, count) + Words{"-o", folder / "merged.exr"});
  REQUIRE(merged.code == 0);
  CHECK((read_text(folder / "whole.exr") == read_text(folder / "merged.exr")));
  // Nothing is lost, and nothing counted twice.
  const auto one = nlohmann::json::parse(whole.out), many = nlohmann::json::parse(merged.out);
  for (const char* key : {"rays", "samples_done", "flagged_pixels"}) CHECK(one.at(key) == many.at(key));
  // Kinds of rays are unknown for a share that was resumed.
  if (many.contains("ray_kinds")) CHECK(one.at("ray_kinds") == many.at("ray_kinds"));
}

// Runs eyeray with files limited to `blocks` blocks of 512 bytes: a write beyond them is refused as by a full
// disk.
ProcessResult run_on_a_full_disk(int blocks, const Words& words) {
  return run_process(Words{"/bin/sh", "-c", "ulimit -f \"$1\"; shift; exec \"$@\"", "sh",
                           std::to_string(blocks), eyeray_binary()} +
                         words,
                     {}, 3600);
}

}  // namespace

TEST_CASE("killed at random and repeated, parts make the same picture") {
  kill_and_repeat(8);
}

TEST_CASE("killed at random a hundred times, too" * doctest::test_suite("long")) {
  kill_and_repeat(100);
}

TEST_CASE("a full disk is reported, and leaves no file that looks like a part or a picture") {
  const SceneFolder folder;
  const Words picture{"render", folder.scene(), "-s", "160x90", "--quiet", "--backend", "twin"};
  const std::set<std::string> before{"scene.toml"};
  // The write fails in the header, in a plane (57 600 bytes each) or at the totals; the last limit leaves
  // room for all.
  for (const int blocks : {0, 1, 60, 110, 120, 400}) {
    CAPTURE(blocks);
    const ProcessResult result = run_on_a_full_disk(blocks, picture + words_of_part(folder, 2, 3));
    CAPTURE(result.err);
    if (blocks == 400) {
      CHECK(result.code == 0);
      continue;
    }
    CHECK(result.code == 4);
    CHECK(result.err == "eyeray: error: cannot write " + part_of(folder, 2, 3) + ": File too large\n");
    CHECK(folder.names() == before);
  }
  for (const int index : {1, 3}) render_part(folder, picture, index, 3);
  const std::set<std::string> parts = folder.names();
  for (const std::string ending : {"png", "pfm", "hdr", "exr"})
    for (const int blocks : {0, 2}) {
      CAPTURE(ending);
      const ProcessResult result = run_on_a_full_disk(
          blocks, Words{"merge"} + all_parts(folder, 3) + Words{"-o", folder / ("merged." + ending)});
      CHECK(result.code == 4);
      CHECK(result.err.starts_with("eyeray: error: cannot write " + folder / ("merged." + ending)));
      CHECK(folder.names() == parts);
    }
}

TEST_CASE("a folder that disappears during the render is reported") {
  const SceneFolder folder;
  const std::string shared = folder / "shared";
  std::filesystem::create_directory(shared);
  Process process(on_one_processor() + Words{eyeray_binary()} + long_picture(folder, "100") +
                  Words{"--shard", "1/2", "-o", shared + "/1.eyeray", "--checkpoint", shared + "/1.work",
                        "--checkpoint-every", "0.02"});
  wait_for_file(process, shared + "/1.work");
  std::filesystem::rename(shared, folder / "elsewhere");
  REQUIRE(process.wait(3600));
  CHECK(process.code() == 4);
  CAPTURE(process.err());
  CHECK(process.err().find("eyeray: warning: no more checkpoints are written: ") != std::string::npos);
  CHECK(process.err().find("eyeray: error: cannot replace " + shared + "/1.eyeray: No such file") !=
        std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "elsewhere/1.eyeray"));
}

TEST_CASE("clocks that differ do not affect parts and checkpoints") {
  const SceneFolder folder;
  const Words picture = long_picture(folder);
  REQUIRE(run_eyeray(picture + Words{"-o", folder / "whole.pfm"}).code == 0);
  const auto set_time = [](const std::string& file, int hours) {
    std::filesystem::last_write_time(
        file, std::filesystem::file_time_type::clock::now() + std::chrono::hours(hours));
  };
  const std::string checkpoint = folder / "work";
  {
    Process process(on_one_processor() + Words{eyeray_binary()} + picture + words_of_part(folder, 1, 2) +
                    Words{"--checkpoint", checkpoint, "--checkpoint-every", "0.02"});
    wait_for_file(process, checkpoint);
    process.send_signal(SIGKILL);
    process.wait(600);
  }
  set_time(checkpoint, 1000);
  set_time(folder.scene(), 2000);
  render_part(folder, picture + Words{"--resume", checkpoint}, 1, 2);
  set_time(folder.scene(), -2000);
  render_part(folder, picture, 2, 2);
  set_time(part_of(folder, 1, 2), 5000);
  set_time(part_of(folder, 2, 2), -5000);
  CHECK(run_eyeray(Words{"merge"} + all_parts(folder, 2) + Words{"-o", folder / "merged.pfm"}).code == 0);
  CHECK((read_text(folder / "whole.pfm") == read_text(folder / "merged.pfm")));
}
