#include "benchmarks/bench/processes.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "benchmarks/bench/programs.hpp"
#include "host/core/readable.hpp"
#include "host/core/scratch_folder.hpp"
#include "host/core/termination.hpp"

namespace eyeray::engine::bench {
namespace {

using Words = std::vector<std::string>;

// eyeray render SCENE WORDS… -D DEFINES… MORE…
class Renders {
 public:
  Renders(const std::filesystem::path& scene, Words words, const Words& defines) : words_(std::move(words)) {
    words_.insert(words_.begin(), {"render", scene.string(), "--quiet"});
    for (const std::string& define : defines) words_.insert(words_.end(), {"-D", define});
  }

  void run(const Words& more, ProcessCost& cost) const {
    Words words = words_;
    words.insert(words.end(), more.begin(), more.end());
    run_words(words, cost);
  }
  static void run_words(const Words& words, ProcessCost& cost) {
    stop_if_interrupted();
    const ProcessResult result = run_eyeray(words);
    cost.wall += result.seconds;
    cost.processor += result.processor_seconds;
  }

 private:
  Words words_;
};

ProcessCost ratio_of(const ProcessCost& a, const ProcessCost& b) {
  return {a.wall / b.wall, a.processor / b.processor};
}

nlohmann::ordered_json cost_json(const ProcessCost& cost) {
  return {{"wall", cost.wall}, {"processor", cost.processor}};
}

}  // namespace

ProcessReport measure_frames(const std::filesystem::path& scene, int frames,
                             const std::vector<std::string>& defines) {
  const ScratchFolder folder;
  const Renders renders(scene, {}, defines);
  const std::string picture = folder.path() / "picture.png";
  ProcessCost warming, together, apart;
  renders.run({"-o", picture}, warming);
  renders.run({"--frames", fmt::format("0:{}", frames - 1), "-o", folder.path() / "together.%d.png"},
              together);
  for (int frame = 0; frame < frames; ++frame)
    renders.run({"-D", fmt::format("animation.frame={}", frame), "-o", picture}, apart);
  return {scene.string(),
          "frames",
          frames,
          {{"together", "in one process", together}, {"apart", "each in its own", apart}},
          ratio_of(together, apart)};
}

ProcessReport measure_shards(const std::filesystem::path& scene, int shards, int width, int height,
                             int samples, const std::vector<std::string>& defines) {
  const ScratchFolder folder;
  const Renders renders(scene, {"-s", fmt::format("{}x{}", width, height), "--spp", std::to_string(samples)},
                        defines);
  const std::string picture = folder.path() / "picture.png";
  ProcessCost warming, whole, parts, merge;
  renders.run({"--shard", fmt::format("1/{}", shards), "-o", folder.path() / "warming.eyeray"}, warming);
  Words merging{"merge", "-o", picture, "--quiet"};
  for (int i = 0; i < shards; ++i) {
    // Render the whole picture in the middle of the shards: machines become slower the longer they work.
    if (i == shards / 2) renders.run({"-o", picture}, whole);
    merging.push_back(folder.path() / fmt::format("{}.eyeray", i));
    renders.run({"--shard", fmt::format("{}/{}", i + 1, shards), "-o", merging.back()}, parts);
  }
  Renders::run_words(merging, merge);
  const ProcessCost sharded{parts.wall + merge.wall, parts.processor + merge.processor};
  return {
      scene.string(),
      "shards",
      shards,
      {{"whole", "in one process", whole}, {"parts", "each in its own", parts}, {"merge", "merge", merge}},
      ratio_of(sharded, whole)};
}

std::string to_text(const ProcessReport& report) {
  std::string text = fmt::format("{}\n{:<24}{:>14}{:>14}\n", report.scene,
                                 fmt::format("{} {}", report.count, report.kind), "wall", "processor");
  for (const ProcessReport::Way& way : report.ways)
    text += fmt::format("{:<24}{:>14}{:>14}\n", way.words, format_seconds(way.cost.wall),
                        format_seconds(way.cost.processor));
  return text + fmt::format("{:<24}{:>14.2f}{:>14.2f}\n", "ratio", report.ratio.wall, report.ratio.processor);
}

nlohmann::ordered_json to_json(const ProcessReport& report) {
  nlohmann::ordered_json json{{"scene", report.scene}, {report.kind, report.count}};
  for (const ProcessReport::Way& way : report.ways) json[way.key] = cost_json(way.cost);
  json["ratio"] = cost_json(report.ratio);
  return json;
}

}  // namespace eyeray::engine::bench
