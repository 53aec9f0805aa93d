#include "host/bench/frames.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/bench/scratch_folder.hpp"
#include "host/core/error.hpp"
#include "host/core/process.hpp"
#include "host/core/readable.hpp"
#include "host/core/termination.hpp"

namespace eyeray::bench {
namespace {

constexpr double patience = 3600;  // seconds, for one process

void add_render(const std::vector<std::string>& arguments, FramesReport::Cost& cost) {
  stop_if_interrupted();
  std::vector<std::string> argv{std::filesystem::read_symlink("/proc/self/exe").string(), "render"};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  argv.emplace_back("--quiet");
  const ProcessResult result = run_process(argv, {}, patience);
  if (result.code != 0) throw Error(ExitCode(result.code), "{}", result.err);
  cost.wall += result.seconds;
  cost.processor += result.processor_seconds;
}

nlohmann::ordered_json cost_json(const FramesReport::Cost& cost) {
  return {{"wall", cost.wall}, {"processor", cost.processor}};
}

}  // namespace

FramesReport measure_frames(const std::filesystem::path& scene, int frames,
                            const std::vector<std::string>& defines) {
  FramesReport report{scene.string(), frames, {}, {}};
  const ScratchFolder folder;
  std::vector<std::string> arguments{scene.string()};
  for (const std::string& define : defines) arguments.insert(arguments.end(), {"-D", define});
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), arguments.begin(), arguments.end());
    return more;
  };
  const std::string picture = folder.path() / "picture.png";

  FramesReport::Cost warming;
  add_render(with({"-o", picture}), warming);
  add_render(with({"--frames", fmt::format("0:{}", frames - 1), "-o", folder.path() / "together.%d.png"}),
             report.together);
  for (int frame = 0; frame < frames; ++frame)
    add_render(with({"-D", fmt::format("animation.frame={}", frame), "-o", picture}), report.apart);
  return report;
}

std::string to_text(const FramesReport& report) {
  std::string text = fmt::format("{}\n{:<24}{:>14}{:>14}\n", report.scene,
                                 fmt::format("{} frames", report.frames), "wall", "processor");
  for (const auto& [name, cost] :
       {std::pair("in one process", &report.together), {"each in its own", &report.apart}})
    text += fmt::format("{:<24}{:>14}{:>14}\n", name, format_seconds(cost->wall),
                        format_seconds(cost->processor));
  return text + fmt::format("{:<24}{:>14.2f}{:>14.2f}\n", "ratio", report.together.wall / report.apart.wall,
                            report.together.processor / report.apart.processor);
}

nlohmann::ordered_json to_json(const FramesReport& report) {
  return {{"scene", report.scene},
          {"frames", report.frames},
          {"together", cost_json(report.together)},
          {"apart", cost_json(report.apart)}};
}

}  // namespace eyeray::bench
