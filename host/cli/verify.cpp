// eyeray verify: gpu, twin and reference on one scene after the other (docs/verify.md).
#include "host/verify/verify.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/build/build_facts.hpp"
#include "host/cli/command.hpp"
#include "host/cli/merged_report.hpp"
#include "host/cli/verify_kernel.hpp"
#include "host/compute/job.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/content_hash.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/make_folder.hpp"
#include "host/core/option_text.hpp"
#include "host/core/standard_streams.hpp"
#include "host/loader/scene_edit.hpp"
#include "host/loader/suite.hpp"
#include "host/program/option_values.hpp"
#include "host/session/request.hpp"
#include "host/shards/part.hpp"
#include "host/verify/page.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::cli {
namespace {

constexpr double most_explained = 0.05;

struct VerifyCommand {
  SceneOptions scene_options;
  std::vector<std::string> more_scenes;
  verify::Options options;
  std::string keep;
  bool quiet = false;
  bool json = false;
  bool record = false;
  bool emulate = false;
  bool backends_given = false;  // by --backends
  bool keep_passed = false;
  std::string junit;
  std::string page_folder;
  verify::Page page;
  bool github = false;
  std::vector<std::string> may_stay_unverified;
  std::string against;
  std::string update;                       // failing, force, or never: ""
  std::optional<render::Shard> shard = {};  // the share of the scenes
  std::vector<std::string> files = {};      // the scenes to verify
  size_t suite_size = 0;                    // the number of all scenes, and …
  std::string suite = {};                   // … the text that names them and the options

  ExitCode run();
  void find_files();
  void prepare_reports();
  void keep_share();
  std::string report_in_json(std::span<const compare::Report> reports) const;
  compare::Report report_on_one_of_many(const std::string& file);
  compare::Report report_of(const Error& error, const std::string& file, bool may_stay);
  void report_the_end(const Error& error, const std::string& file);
  void record_allowance(const compare::Report& report) const;
  void write_reports(std::span<const compare::Report> reports) const;
  compare::Report report_on(const SceneOptions& scene_file);
  compare::Report report_on_kernel(const SceneOptions& kernel_file);
  std::string name_in_folder(const std::string& scene) const;
  fs::path folder_for(const std::string& scene) const;
  std::optional<verify::Golden> golden_of(const std::string& scene) const;
  void check_options() const;
};

// The scene's path as one name: two folders may have scenes with the same file name.
std::string VerifyCommand::name_in_folder(const std::string& scene) const {
  const fs::path file = fs::path(scene).lexically_normal();
  std::string name = fs::path(file).replace_extension("").relative_path().string();
  std::ranges::replace(name, '/', '-');
  return name;
}

fs::path VerifyCommand::folder_for(const std::string& scene) const {
  if (suite_size == 1) return keep.empty() ? fs::path(scene).stem().string() + ".verify" : keep;
  const std::string name = name_in_folder(scene);
  return keep.empty() ? fs::path(name + ".verify") : fs::path(keep) / name;
}

// The picture of --against: the .pfm that it names, or one in the folder that it names,
// FOLDER/scenes-whitted.pfm.
std::optional<verify::Golden> VerifyCommand::golden_of(const std::string& scene) const {
  if (against.empty()) return std::nullopt;
  const bool is_picture = fs::path(against).extension() == ".pfm";
  return verify::Golden{is_picture ? fs::path(against) : fs::path(against) / (name_in_folder(scene) + ".pfm"),
                        update.empty()      ? verify::Update::never
                        : update == "force" ? verify::Update::all
                                            : verify::Update::failing,
                        EYERAY_VERSION};
}

// Collects every scene that was named or lies in a named folder.
void VerifyCommand::find_files() {
  std::vector<std::string> named{scene_options.file()};
  named.insert(named.end(), more_scenes.begin(), more_scenes.end());
  for (const std::string& name : named) {
    if (!fs::is_directory(name)) {
      files.push_back(name);
      continue;
    }
    try {
      for (const fs::path& scene : loader::scenes_below(name))
        files.push_back(scene.lexically_normal().string());
    } catch (const Error& error) {
      prepare_reports();
      report_the_end(error, name);
      throw;
    }
  }
  for (const std::string& name : may_stay_unverified)
    if (std::ranges::find(files, name) == files.end())
      throw Error(ExitCode::bad_input, "--allow-unverified {}: this is none of the scenes to verify", name);
}

// Keeps every shard.count-th scene: neighbours in a folder are alike.
void VerifyCommand::keep_share() {
  ContentHash hash;
  for (const std::string& file : files) hash.add(file);
  suite = hash.add(scene_options.as_written()).add(build::sum_of_sources()).hex();
  suite_size = files.size();
  if (!shard) return;
  std::vector<std::string> share;
  for (size_t i = size_t(shard->index); i < files.size(); i += size_t(shard->count))
    share.push_back(files[i]);
  files = std::move(share);
}

std::string VerifyCommand::report_in_json(std::span<const compare::Report> reports) const {
  std::string text = compare::to_json(reports);
  if (!shard) return text;
  Json report = Json::parse(text);
  // A share without scenes has passed.
  if (reports.empty()) report["passed"] = true;
  report["shard"] = shard_of_report(*shard, suite_size, suite);
  return json_text(report) + "\n";
}

compare::Report VerifyCommand::report_on_kernel(const SceneOptions& kernel_file) {
  if (suite_size == 1 && (record || !against.empty() || options.crop.pixels() > 0))
    throw Error(ExitCode::bad_input, "{} is a kernel; --against, --record and --crop are for scenes",
                kernel_file.file());
  const compare::Report report = verify_kernel({.file = kernel_file.file(),
                                                .defines = kernel_file.defines(),
                                                .backends_given = backends_given,
                                                .evidence = folder_for(kernel_file.file()),
                                                .keep_always = keep_passed},
                                               options);
  page.add(report);
  return report;
}

compare::Report VerifyCommand::report_on(const SceneOptions& scene_file) {
  if (compute::is_job(scene_file.file())) return report_on_kernel(scene_file);
  const Scene scene = scene_file.load();
  session::crop_within(options.crop, scene.image);
  const fs::path& folder = options.executor.shader_folder;
  std::string shaders = folder.empty() ? "" : " --shaders " + shell_word(folder.string());
  if (options.executor.twin.compile) shaders += " --compile-twin";
  return verify::verify_scene({scene, scene_file.file(), scene_file.as_written() + shaders,
                               folder_for(scene_file.file()), keep_passed, golden_of(scene_file.file())},
                              options);
}

// The report on a scene that was not verified. Rethrows an error that is none of the scene's.
compare::Report VerifyCommand::report_of(const Error& error, const std::string& file, bool may_stay) {
  if (error.code() == ExitCode::interrupted || error.code() == ExitCode::no_device) throw;
  compare::Report report;
  report.scene = file;
  report.not_verified = error.what();
  report.may_stay_unverified = may_stay;
  page.add(report);
  return report;
}

// Writes the reports of a run that ends with this error, which is being handled.
void VerifyCommand::report_the_end(const Error& error, const std::string& file) {
  const compare::Report report = report_of(error, file, false);
  write_reports({&report, 1});
}

// Reports on one of several scenes. An error goes into its report, so that the other scenes are still
// verified.
compare::Report VerifyCommand::report_on_one_of_many(const std::string& file) {
  try {
    return report_on(scene_options.for_file(file));
  } catch (const Error& error) {
    return report_of(error, file, std::ranges::find(may_stay_unverified, file) != may_stay_unverified.end());
  }
}

void VerifyCommand::record_allowance(const compare::Report& report) const {
  const std::optional<double> allowance = report.healthy_allowance();
  if (!allowance || report.is_kernel()) return;
  const std::string share = *allowance > 0 ? fmt::format("{:.5f}", *allowance) : "0";
  loader::set_value(report.scene, "verify", "max_explained", share);
  print_lines(stderr, "eyeray: recorded max_explained = {} in {}\n", share, report.scene);
}

// Writes the findings to files, in addition to the text or JSON on standard output.
void VerifyCommand::write_reports(std::span<const compare::Report> reports) const {
  if (!junit.empty()) write_file_atomically(junit, to_junit(reports));
  if (!page_folder.empty()) {
    std::string sum = summary(reports);
    sum.pop_back();
    write_file_atomically(fs::path(page_folder) / "index.html", page.html(sum));
  }
  if (!github) return;
  fmt::print("{}", to_annotations(reports));
  if (const char* summary = std::getenv("GITHUB_STEP_SUMMARY")) {
    std::ofstream file(summary, std::ios::app);
    file << to_markdown(reports);
    if (!file.flush()) throw Error(ExitCode::file_io, "cannot write {}", summary);
  }
}

// Checks that CLI11 cannot make.
void VerifyCommand::check_options() const {
  if (!update.empty() && against.empty())
    throw Error(ExitCode::bad_input, "--update needs --against, which names the picture to update");
  if (!update.empty() && options.crop.pixels() > 0)
    throw Error(ExitCode::bad_input, "--update stores whole pictures: leave out --crop");
  if (fs::path(against).extension() == ".pfm" && suite_size > 1)
    throw Error(ExitCode::bad_input, "--against {}: for {} scenes, it must be a folder of pictures", against,
                files.size());
}

ExitCode VerifyCommand::run() {
  const OptionBackends backends;
  if (emulate && std::ranges::find(options.backends, executors::Backend::emulator) == options.backends.end())
    options.backends.push_back(executors::Backend::emulator);
  if (record) {
    const std::string changed = scene_options.as_written();
    if (!changed.empty() || options.crop.pixels() > 0 || options.max_explained)
      throw Error(ExitCode::bad_input, "--record verifies scenes as their files define them: leave out{}",
                  changed.empty() ? " --crop and --max-explained" : changed);
    options.max_explained = most_explained;
  }
  options.progress = [this] {
    auto progress = progress_reporter(quiet);
    if (progress) progress({});
    return progress;
  };
  find_files();
  keep_share();
  check_options();
  prepare_reports();

  size_t width = 0;
  for (const std::string& file : files) width = std::max(width, file.size());
  std::vector<compare::Report> reports;
  for (const std::string& file : files) {
    // A suite goes on after an error. A share of it does too, even if it has a single scene.
    if (suite_size == 1 && fs::path(file) == fs::path(scene_options.file())) {
      try {
        reports.push_back(report_on(scene_options.for_file(file)));
      } catch (const Error& error) {
        report_the_end(error, file);
        throw;
      }
    } else {
      reports.push_back(report_on_one_of_many(file));
    }
    const compare::Report& report = reports.back();
    if (record) record_allowance(report);
    if (json) continue;
    if (files.size() > 1) print_lines(stdout, "{}", to_row(report, width));
    if (files.size() == 1 || !report.passes()) print_lines(stdout, "{}", to_text(report));
    std::fflush(stdout);
  }
  if (json)
    fmt::print("{}", report_in_json(reports));
  else if (reports.size() > 1)
    print_lines(stdout, "{}", summary(reports));
  write_reports(reports);
  return std::ranges::all_of(reports, &compare::Report::passes) ? ExitCode::ok : ExitCode::comparison_failed;
}

// Makes the folders of the reports, and checks that the reports can be written.
void VerifyCommand::prepare_reports() {
  if (!page_folder.empty()) {
    make_folder(page_folder);
    check_writable(fs::path(page_folder) / "index.html");
    if (keep.empty()) keep = (fs::path(page_folder) / "kept").string();
    options.witness = [this](const auto&... seen) { page.add(seen...); };
  }
  if (!junit.empty()) {
    if (const fs::path parent = fs::path(junit).parent_path(); !parent.empty()) make_folder(parent);
    check_writable(junit);
  }
}

}  // namespace

void add_verify(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand(
      "verify", "Check the GPU's pixels against the CPU, bit by bit and against the reference.");
  const auto options = std::make_shared<VerifyCommand>();
  verify::Options& how = options->options;
  options->scene_options.add_to(*command);
  command->add_option("MORE", options->more_scenes,
                      "Further scenes, or folders of them, with the same options.");
  add_crop_option(*command, how.crop);
  add_executor_options(*command, how.executor);
  const auto parse = [options, &how](const std::string& list) {
    options->backends_given = true;
    how.backends = parse_backends(list);
    if (std::ranges::find(how.backends, executors::Backend::reference) != how.backends.end())
      throw Error(
          ExitCode::bad_input,
          "--backends must be some of gpu, twin and emulator: the executors to compare with the reference");
  };
  command
      ->add_option_function<std::string>("--backends", parse,
                                         "The executors to compare with the reference: gpu, twin, emulator.")
      ->option_text("LIST=gpu,twin")
      ->group("Device");
  command
      ->add_flag("--emulate", options->emulate,
                 "Run the kernels' SPIR-V by the emulator, too. Gate S fails if it finds a fault in them.")
      ->group("Device");
  command
      ->add_option("--max-explained", how.max_explained,
                   "The share of pixels that may differ at discontinuities of the picture, for each gate. "
                   "Default: from the scene's [verify].")
      ->option_text("SHARE")
      ->check(within(0, most_explained));
  command
      ->add_option("--against", options->against,
                   "A golden picture (.pfm) that the scene's picture must equal too, or a folder of them.")
      ->option_text("FILE");
  command
      ->add_flag("--update{failing}", options->update,
                 "If nothing else fails, store the scene's picture as the golden picture where that differs "
                 "or is missing; with =force, always.")
      ->check(one_of({"failing", "force"}))
      ->disable_flag_override(false)
      ->option_text("[=force]");
  command->add_flag("--record", options->record,
                    "If nothing else fails, write twice the explained share into the scene's [verify].");
  command
      ->add_option("--ulp", how.ulp,
                   "The largest distance between GPU and twin, in units in the last place: for devices whose "
                   "square root or division is not exact.")
      ->option_text("N=0")
      ->check(whole_within(0, 64));
  command->add_flag("--denoise", how.denoise,
                    "Also compare the pictures without their noise, as for scenes with denoise = true.");
  command->add_flag("--raster", how.raster,
                    "Also compare the hits of camera rays with the device's rasteriser.");
  command
      ->add_option("--keep", options->keep,
                   "The folder for the pictures of a failed gate. Default: SCENE.verify here.")
      ->option_text("DIR");
  command->add_flag("--keep-passed", options->keep_passed, "Write these pictures even if no gate fails.");
  command
      ->add_option_function<std::string>(
          "--shard", [options](const std::string& text) { options->shard = shards::parse_shard(text); },
          "Verify every N-th scene, from the I-th on, such as 3/64; eyeray merge joins the reports of "
          "--json.")
      ->option_text("I/N");
  command->add_flag("-q,--quiet", options->quiet, "Print no progress.");
  command->add_flag("--json", options->json, "Report as JSON.");
  command
      ->add_option(
          "--report", options->page_folder,
          "Write a page with all pictures, DIR/index.html, and the pictures of failed scenes below DIR.")
      ->option_text("DIR");
  command->add_option("--junit", options->junit, "Write the report as JUnit XML, too. Its folder is made.")
      ->option_text("FILE");
  command
      ->add_flag("--github", options->github,
                 "Print failures as annotations for GitHub Actions, and add a table to the step's summary.")
      ->excludes("--json");
  command
      ->add_option("--allow-unverified", options->may_stay_unverified,
                   "One of several scenes that may fail to render. May be repeated.")
      ->option_text("SCENE")
      ->allow_extra_args(false)
      ->take_all();
  command->footer(
      "Examples:\n"
      "  eyeray verify scenes/whitted.toml\n"
      "  eyeray verify scenes/ -s 96x72 --junit report.xml\n"
      "  eyeray verify scenes/whitted.toml --record     after an intended change\n"
      "Exit code 0 when every gate passes, 1 when one fails.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::engine::cli
