// Pictures that many machines render: the parts make the picture of one, bit by bit.
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "parts.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// A picture whose sides are no multiples of a tile's.
Words picture_of(const std::string& scene, const Words& more = {}) {
  return Words{"render", scene, "-s", "70x45", "--quiet"} + more;
}

void render_parts(const SceneFolder& folder, const Words& picture, int count) {
  for (int i = 1; i <= count; ++i)
    render_part(folder, picture, i, count, {{"LP_NUM_THREADS", std::to_string(i % 3)}});
}

// An option -o for each of these endings.
Words outputs(const SceneFolder& folder, const std::string& name, const Words& endings) {
  Words words;
  for (const std::string& ending : endings) words = words + Words{"-o", folder / (name + ending)};
  return words;
}

std::map<std::string, std::string> files_of(const SceneFolder& folder, const std::string& name) {
  std::map<std::string, std::string> files;
  for (const std::string& file : folder.names())
    if (file.starts_with(name + ".")) files[file.substr(name.size())] = read_text(folder / file);
  return files;
}

// The parts of `count` shards make the files of one machine, all of them and no others.
void check_shards(const std::string& scene, const Words& more, const Words& endings, const Words& aovs,
                  int count) {
  CAPTURE(scene);
  CAPTURE(count);
  const SceneFolder folder;
  const Words picture = picture_of(scene.empty() ? folder.scene() : scene, more);
  const ProcessResult whole = run_eyeray(picture + aovs + outputs(folder, "whole", endings));
  CAPTURE(whole.err);
  REQUIRE(whole.code == 0);
  render_parts(folder, picture + aovs, count);
  const ProcessResult merged =
      run_eyeray(Words{"merge"} + all_parts(folder, count) + outputs(folder, "merged", endings));
  CAPTURE(merged.err);
  REQUIRE(merged.code == 0);
  const auto expected = files_of(folder, "whole"), found = files_of(folder, "merged");
  CHECK(expected.size() >= endings.size());
  for (const auto& file : expected) {
    CAPTURE(file.first);
    REQUIRE(found.contains(file.first));
    CHECK((found.at(file.first) == file.second));
  }
  CHECK(found.size() == expected.size());
}

const Words every_format{".pfm", ".png", ".exr", ".hdr"};
const Words all_aovs{"--aov", "all"};

}  // namespace

TEST_CASE("parts make the picture of one machine: whitted, every format, every AOV") {
  for (const int count : {1, 3}) check_shards("", {"--spp", "4"}, every_format, all_aovs, count);
  // More shards than tiles: some have nothing to do.
  check_shards("", {"--backend", "twin"}, {".exr", ".pfm"}, all_aovs, 23);
}

TEST_CASE("parts make the picture of one machine: paths, in bands and a crop") {
  const Words options{"--spp", "5", "-D", "image.pattern=random", "--clamp", "2", "--crop", "5,3,61,40"};
  check_shards("scenes/path/cornell_box.toml", options, {".pfm", ".png"}, all_aovs, 4);
  check_shards("scenes/path/fog.toml", {"--spp", "2", "--backend", "twin", "--band-memory", "1"}, {".pfm"},
               {}, 2);
}

TEST_CASE("parts make the picture of one machine: photons") {
  const Words options{"--spp", "3", "-D", "render.photons=2000"};
  check_shards("scenes/sppm/box.toml", options, {".pfm", ".hdr"}, {"--aov", "rays,noise,depth"}, 3);
}

TEST_CASE("the reference's parts make the same picture, and merge reports as one machine does") {
  const SceneFolder folder;
  const Words picture = Words{"render", folder.scene(), "--backend", "reference", "--spp", "4", "--json"};
  const ProcessResult whole = run_eyeray(picture + Words{"-o", folder / "whole.pfm", "--stats"});
  REQUIRE(whole.code == 0);
  render_parts(folder, picture + Words{"--stats"}, 2);
  const ProcessResult merged =
      run_eyeray(Words{"merge", "--json"} + all_parts(folder, 2) + Words{"-o", folder / "merged.pfm"});
  REQUIRE(merged.code == 0);
  const auto one = nlohmann::json::parse(whole.out), many = nlohmann::json::parse(merged.out);
  for (const char* key :
       {"width", "height", "samples", "samples_done", "rays", "ray_kinds", "flagged_pixels"})
    CHECK(one.at(key) == many.at(key));
  CHECK(many.at("parts") == 2);
  CHECK(merged.err.find("of 2 parts in ") != std::string::npos);
  CHECK((read_text(folder / "whole.pfm") == read_text(folder / "merged.pfm")));
}

TEST_CASE("parts that do not make a picture are refused, and the message names the fault") {
  const SceneFolder folder;
  const Words twin{"--backend", "twin"};
  const Words picture = picture_of(folder.scene(), twin);
  render_parts(folder, picture, 4);
  Words parts = all_parts(folder, 4);
  const auto refusal = [&](const Words& files, int code) {
    const ProcessResult result = run_eyeray(Words{"merge"} + files + Words{"-o", folder / "merged.pfm"});
    CHECK(result.code == code);
    CHECK_FALSE(std::filesystem::exists(folder / "merged.pfm"));
    return result.err;
  };
  const std::string begin = "eyeray: error: these parts do not make a whole picture: ";

  CHECK(refusal(Words(parts.begin() + 1, parts.end()), 2) == begin + "missing: 4/4\n");
  CHECK(refusal(parts + Words{parts[1]}, 2) == begin + parts[1] + " and " + parts[1] + " are both 3/4\n");
  CHECK(refusal(parts + Words{folder / "none.eyeray"}, 4) ==
        begin + folder / "none.eyeray" + ": it cannot be read: No such file or directory\n");

  // Half a file, as from a folder that was full.
  const std::string sound = read_text(parts[2]);
  write_text(parts[2], sound.substr(0, sound.size() / 2));
  CHECK(refusal(parts, 4) == begin + parts[2] + ": it is damaged: it ends too early; missing: 2/4\n");
  const ProcessResult check = run_eyeray(Words{"merge", "--check", "--json"} + parts);
  CHECK(check.code == 4);
  const auto report = nlohmann::json::parse(check.out);
  CHECK(report.at("complete") == false);
  CHECK(report.at("missing") == nlohmann::json{2});
  CHECK(report.at("damaged").size() == 1);
  write_text(parts[2], sound);
  CHECK(run_eyeray(Words{"merge", "--check"} + parts).code == 0);

  // Parts of another scene, with other samples or other arithmetic, are refused.
  const std::string text = read_text(folder.scene());
  write_text(folder.scene(), text + "\n# another\n");
  render_part(folder, picture, 2, 4);
  CHECK(refusal(parts, 2) ==
        begin + parts[2] + " is of another picture; these differ: the scene; missing: 2/4\n");
  write_text(folder.scene(), text);
  render_part(folder, picture + Words{"--spp", "4"}, 2, 4);
  CHECK(refusal(parts, 2).find("these differ: the samples a pixel (4, of most 1), the options laid over") !=
        std::string::npos);
  render_part(folder, picture_of(folder.scene()), 2, 4);
  const std::string other = refusal(parts, 2);
  CHECK(other.find("the backend (gpu, of most twin)") != std::string::npos);
  CHECK(other.find("the arithmetic of the device (exact, ") != std::string::npos);
}

TEST_CASE("a picture that cannot be sharded is refused before it is rendered") {
  const SceneFolder folder;
  const auto refusal = [&](const Words& more) {
    const ProcessResult result = run_eyeray(Words{"render", folder.scene(), "--shard", "1/2"} + more);
    CHECK(result.code == 2);
    CHECK(folder.names() == std::set<std::string>{"scene.toml"});
    return result.err;
  };
  CHECK(refusal({"--noise", "0.1"}).find("noise is measured from a pixel's neighbours") != std::string::npos);
  CHECK(refusal({"--classic"}).find("--classic computes pixels from their corners") != std::string::npos);
  CHECK(refusal({"--half"}).find("eyeray merge") != std::string::npos);
  CHECK(refusal({"-o", folder / "a.png"}).find("--shard writes one part") != std::string::npos);
  for (const char* shard : {"0/2", "3/2", "1", "1/0"}) {
    const ProcessResult result = run_eyeray({"render", folder.scene(), "--shard", shard});
    CHECK(result.code == 2);
    CHECK(result.err.find("--shard must be I/N, such as 3/64") != std::string::npos);
  }
}

TEST_CASE("a suite's shards report as the whole suite does") {
  const SceneFolder folder;
  Words scenes;
  for (const int i : {1, 2, 3, 4, 5}) {
    scenes.push_back(folder / fmt::format("{}.toml", i));
    write_text(scenes.back(), replaced(small_scene, "radius = 1", fmt::format("radius = 0.{}", i + 4)));
  }
  // One fails, and one cannot be read.
  write_text(scenes[3], "nonsense");
  const Words verify = Words{"verify", "--json", "--quiet", "--backends", "twin", "-s", "24x18"};
  const auto without_times = [](nlohmann::json json) {
    for (nlohmann::json& scene : json.at("scenes")) {
      scene.erase("seconds");
      for (nlohmann::json& executor : scene["executors"]) executor.erase("seconds");
    }
    return json;
  };
  const ProcessResult whole = run_eyeray(verify + scenes);
  REQUIRE(whole.code == 1);
  for (const int count : {1, 3, 7}) {
    Words reports;
    for (int i = 1; i <= count; ++i) {
      const ProcessResult share =
          run_eyeray(verify + scenes + Words{"--shard", fmt::format("{}/{}", i, count)});
      CHECK(share.code == (i == (3 % count) + 1 ? 1 : 0));
      reports.push_back(folder / fmt::format("report.{}.json", i));
      write_text(reports.back(), share.out);
    }
    const ProcessResult merged = run_eyeray(Words{"merge"} + reports);
    CHECK(merged.code == 1);
    CHECK(without_times(nlohmann::json::parse(merged.out)) ==
          without_times(nlohmann::json::parse(whole.out)));
    if (count == 1) continue;
    const ProcessResult fewer = run_eyeray(Words{"merge"} + Words(reports.begin() + 1, reports.end()));
    CHECK(fewer.code == 2);
    CHECK(fewer.err == fmt::format("eyeray: error: these reports cannot be merged: missing: 1/{}\n", count));
  }
}
