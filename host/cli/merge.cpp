// eyeray merge: makes a picture of its parts, and one report of the reports on parts of a suite.
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "host/build/build_facts.hpp"
#include "host/cli/merged_report.hpp"
#include "host/cli/picture_text.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/standard_streams.hpp"
#include "host/core/termination.hpp"
#include "host/image/image_file.hpp"
#include "host/session/picture_files.hpp"
#include "host/shards/part_set.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::cli {
namespace {

struct MergeCommand {
  std::vector<std::string> parts;
  std::vector<std::string> outputs;
  bool half = false;
  bool check = false;
  bool quiet = false;
  bool json = false;

  ExitCode run();
  ExitCode merge_reports() const;
  ExitCode report_faults(const shards::PartSet& set) const;
  session::Result merge(shards::PartSet& set) const;
  void check_outputs(const shards::PartHeader& header);
};

bool is_report(const std::string& file) {
  return fs::path(file).extension() == ".json";
}

// The faults as JSON, for programs that start missing parts again.
Json to_json(const shards::PartFaults& faults, const shards::PartSet& set) {
  Json json{{"complete", !faults.any()}, {"shards", faults.count}, {"parts", set.parts().size()}};
  if (const shards::PartHeader* header = set.header()) {
    json["scene"] = header->scene;
    json["width"] = header->area.width;
    json["height"] = header->area.height;
  }
  json["damaged"] = faults.damaged;
  json["foreign"] = faults.foreign;
  json["doubled"] = faults.doubled;
  json["missing"] = Json::array();
  for (const int index : faults.missing) json["missing"].push_back(index + 1);
  return json;
}

void MergeCommand::check_outputs(const shards::PartHeader& header) {
  if (outputs.empty())
    outputs.push_back(fs::path(header.scene).filename().replace_extension(".png").string());
  for (const std::string& output : outputs) {
    image::image_format(output);
    if (header.transparent) image::check_has_alpha(output);
    check_writable(output);
  }
}

session::Result MergeCommand::merge(shards::PartSet& set) const {
  const Stopwatch watch;
  const shards::PartHeader& header = *set.header();
  session::PictureFiles files(outputs, header.aovs, half);
  files.begin(header.area.width, header.area.height, header.tone, header.channels(0));
  double luminances = 0;
  set.merge([&](size_t plane, const image::Image& rows) {
    files.write(plane, rows);
    if (plane == 0) luminances += render::sum_of_luminances(rows);
  });
  const shards::PartTotals totals = set.totals();
  {
    const Saving saving;
    files.finish_color();
    files.finish_aovs(
        [&](size_t aov, const fs::path& file) { return film::write_legend(totals.legends[aov], file); });
  }

  session::Result picture;
  picture.files = files.written();
  picture.device = header.device;
  picture.crop = header.area;
  picture.pixels = header.area.pixels();
  picture.samples = picture.totals.samples_done = picture.totals.most_samples = header.samples;
  picture.totals.rays = totals.rays;
  picture.totals.seconds = totals.seconds;
  picture.totals.processor_seconds = totals.processor_seconds;
  picture.totals.flagged_pixels = totals.flagged_pixels;
  picture.flagged_hits = totals.flagged_hits;
  picture.ray_kinds = totals.ray_kinds;
  session::PictureQuality& quality = picture.quality;
  quality.flags = totals.flags;
  quality.flagged = std::max(totals.flagged_pixels, totals.flagged_hits);
  quality.clamp = header.clamp;
  quality.clamped = totals.clamped;
  if (header.random_paths) quality.fireflies = totals.brightness.fireflies(luminances, picture.pixels);
  picture.warnings = session::warnings_of(quality);
  picture.seconds = watch.seconds();
  return picture;
}

// Reports all faults, for callers that only check the parts, before they want the picture.
ExitCode MergeCommand::report_faults(const shards::PartSet& set) const {
  const shards::PartFaults& faults = set.faults();
  if (json) print_json(to_json(faults, set));
  if (faults.any()) {
    if (!json) faults.refuse();
    return faults.damaged.empty() ? ExitCode::bad_input : ExitCode::file_io;
  }
  if (!quiet && !json)
    print_lines(stdout, "{} parts make the whole of {}, {}×{}, and are sound\n", set.parts().size(),
                set.header()->scene, set.header()->area.width, set.header()->area.height);
  return ExitCode::ok;
}

ExitCode MergeCommand::merge_reports() const {
  if (outputs.size() > 1) throw Error(ExitCode::bad_input, "reports are merged into one file");
  const Json merged = merged_report(parts);
  const std::string text = json_text(merged) + "\n";
  if (outputs.empty())
    fmt::print("{}", text);
  else
    write_file_atomically(outputs[0], text);
  return merged.at("passed").get<bool>() ? ExitCode::ok : ExitCode::comparison_failed;
}

ExitCode MergeCommand::run() {
  if (std::ranges::all_of(parts, is_report)) return merge_reports();
  shards::PartSet set({parts.begin(), parts.end()});
  if (check) return report_faults(set);
  set.faults().refuse();
  const shards::PartHeader& header = *set.header();
  check_outputs(header);
  if (header.build != build::sum_of_sources())
    print_lines(stderr, "eyeray: warning: the parts were rendered by another build of eyeray than this\n");
  const session::Result picture = merge(set);
  print_warnings(picture);
  if (!quiet) print_lines(stderr, "{}\n", summary(picture, set.parts().size()));
  if (json) print_json(json_of(picture, set.parts().size()));
  return ExitCode::ok;
}

}  // namespace

void add_merge(CLI::App& app, Run& run) {
  CLI::App* const command =
      app.add_subcommand("merge", "Make a picture of the parts that render --shard wrote.");
  const auto options = std::make_shared<MergeCommand>();
  command
      ->add_option("PARTS", options->parts,
                   "All parts of the picture in any order, or reports of verify (.json).")
      ->required();
  command
      ->add_option(
          "-o,--output", options->outputs,
          "The picture file to write: .png, .pfm, .hdr or .exr. May be repeated. Default: SCENE.png here.")
      ->option_text("FILE")
      ->allow_extra_args(false)
      ->take_all();
  command->add_flag("--half", options->half, "Write the colours of an .exr in 16 bits a channel, not 32.");
  command->add_flag("--check", options->check,
                    "Only report whether the parts are sound and make a whole picture.");
  command->add_flag("-q,--quiet", options->quiet, "No summary; warnings and errors remain.");
  command->add_flag("--json", options->json, "Report as JSON on standard output.");
  command->footer(
      "Examples:\n"
      "  eyeray merge whitted.*-of-64.eyeray -o whitted.png\n"
      "  eyeray merge whitted.*-of-64.eyeray --check --json      list missing, damaged, doubled or foreign "
      "parts\n"
      "  eyeray merge report.*.json -o report.json               join reports of verify --shard I/N --json\n"
      "The picture equals one that a single machine renders, bit by bit.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::engine::cli
