// eyeray slurm: pictures as arrays of Slurm's jobs (docs/many-machines.md).
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/build/build_facts.hpp"
#include "host/cli/frames.hpp"
#include "host/cli/picture_options.hpp"
#include "host/core/content_hash.hpp"
#include "host/core/standard_streams.hpp"
#include "host/program/json.hpp"
#include "host/program/option_values.hpp"
#include "host/session/picture_files.hpp"
#include "host/slurm/array.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::cli {
namespace {

struct SlurmCommand {
  PictureOptions picture;
  std::vector<std::string> more_scenes;
  std::vector<std::string> sbatch_words;
  std::vector<std::string> render_words = {};
  int shards = 0;
  std::string folder;
  std::string frames;  // FIRST:LAST[:STEP]; empty: only the frame that the scene shows
  std::string video;   // video of the frames; empty: none
  bool no_submit = false;
  bool quiet = false;
  bool json = false;

  ExitCode run();
  void check_options() const;
  slurm::Array array_of(const std::string& scene) const;
  void add_outputs(slurm::Array& array, const fs::path& scene) const;
};

// The given options that `render` has too, as words of its command line.
std::vector<std::string> words_of_render(const CLI::App& command, const std::vector<std::string>& own) {
  std::vector<std::string> words;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || !name.starts_with('-') || std::ranges::find(own, name) != own.end()) continue;
    for (const std::string& value : option->results()) {
      words.push_back(name);
      if (option->get_items_expected_max() > 0) words.push_back(value);
    }
  }
  return words;
}

void SlurmCommand::check_options() const {
  for (const std::string& word : sbatch_words)
    for (const char* own : {"--array", "-a", "--dependency", "-d", "--job-name", "-J", "--wait", "-W"})
      if (word == own || word.starts_with(std::string(own) + "="))
        throw Error(ExitCode::bad_input, "{} is set by eyeray: leave it out", own);
  if (!more_scenes.empty() && !(picture.outputs.empty() && folder.empty() && video.empty()))
    throw Error(ExitCode::bad_input,
                "each of several scenes has its own picture and folder, named after it: leave out -o, "
                "--folder and --video");
  if (!video.empty() && frames.empty()) throw Error(ExitCode::bad_input, "--video needs --frames");
  if (!video.empty()) check_video_name(video);
}

// Adds the array's outputs: a picture, which its last job makes, or frames, of which each of N shares renders
// every N-th.
void SlurmCommand::add_outputs(slurm::Array& array, const fs::path& scene) const {
  std::vector<std::string> outputs = picture.outputs;
  if (outputs.empty())
    outputs.push_back(frames.empty() ? scene.filename().replace_extension(".png").string()
                                     : scene.stem().string() + ".%04d.png");
  std::vector<std::string>& words = frames.empty() ? array.last_words : array.render_words;
  if (!frames.empty()) words.insert(words.end(), {"--frames", frames});
  for (const std::string& output : outputs) words.insert(words.end(), {"-o", output});
  if (picture.half) words.emplace_back("--half");
  if (frames.empty()) {
    array.files = outputs;
    return;
  }
  array.frames_of_shares.resize(size_t(shards));
  for (size_t share = 0; const int frame : parse_frames(frames)) {
    std::vector<std::string> names;
    for (const std::string& output : outputs) names.push_back(frame_name(output, frame));
    array.files.insert(array.files.end(), names.begin(), names.end());
    std::ranges::copy(session::files_written(names, picture.request.channels),
                      std::back_inserter(array.frames_of_shares[share]));
    share = (share + 1) % size_t(shards);
  }
  if (video.empty()) return;
  array.files.push_back(video);
  array.last_words = {"--video", video};
}

slurm::Array SlurmCommand::array_of(const std::string& scene) const {
  // Load the scene, so that its faults are reported now and not on the nodes.
  const Scene loaded = picture.scene.for_file(scene).load();
  session::crop_within(picture.request.crop, loaded.image);

  slurm::Array array;
  array.program = fs::read_symlink("/proc/self/exe").string();
  array.render_words = render_words;
  array.render_words.insert(array.render_words.begin(), scene);
  array.sbatch_words = sbatch_words;
  array.folder = folder.empty() ? fs::path(scene).stem().string() + ".slurm" : folder;
  array.shards = shards;
  array.contents = ContentHash().add(hash_of_files(loaded.files)).add(build::sum_of_sources()).hex();
  add_outputs(array, scene);
  return array;
}

// Prints the progress of a picture, the states of its jobs, and the jobs `submitted` now.
void print(const slurm::Array& array, const slurm::ArrayState& state,
           const std::vector<std::string>& submitted) {
  const size_t there = size_t(array.shards) - state.missing.size();
  print_lines(stderr, "{}: {} of {} shares are done{}\n", array.render_words[0], there, array.shards,
              state.done ? ", and the whole task is done" : "");
  if (!state.queue.empty()) print_lines(stderr, "in the queue, as {}:\n", array.job_name);
  for (const std::string& line : state.queue) print_lines(stderr, "  {}\n", line);
  if (!state.output.empty()) print_lines(stderr, "output of the failed jobs: {}\n", state.output.string());
  for (const std::string& line : state.failures) print_lines(stderr, "  {}\n", line);
  if (!submitted.empty())
    print_lines(stderr, "submitted {}; squeue, sacct and scancel know them by --name={}\n",
                fmt::join(submitted, ", "), array.job_name);
}

ExitCode SlurmCommand::run() {
  check_options();
  std::vector<slurm::Array> arrays{array_of(picture.scene.file())};
  for (const std::string& scene : more_scenes) arrays.push_back(array_of(scene));
  for (slurm::Array& array : arrays) prepare(array);

  Json pictures = Json::array();
  for (const slurm::Array& array : arrays) {
    const slurm::ArrayState state = state_of(array);
    for (const std::string& fault : state.faults) print_lines(stderr, "eyeray: warning: {}\n", fault);
    std::vector<std::string> jobs;
    if (!no_submit && !state.done && state.queue.empty()) jobs = submit(array, state);
    if (!quiet) print(array, state, jobs);
    pictures.push_back({{"scene", array.render_words[0]},
                        {"files", array.files},
                        {"done", state.done},
                        {"missing", state.missing},
                        {"job_name", array.job_name},
                        {"queue", state.queue},
                        {"failures", state.failures},
                        {"submitted", jobs}});
  }
  if (json) print_json({{"pictures", pictures}});
  return ExitCode::ok;
}

}  // namespace

void add_slurm(CLI::App& app, Run& run, const std::vector<std::string>& sbatch_words) {
  CLI::App* const command =
      app.add_subcommand("slurm", "Render a scene on a Slurm cluster, one share in each job.");
  const auto options = std::make_shared<SlurmCommand>();
  options->sbatch_words = sbatch_words;
  options->picture.add_to(*command);
  command->add_option("MORE", options->more_scenes, "Further scenes, with the same options.");
  const auto add = [&](const char* name, auto& value, const char* text, const char* description) {
    return command->add_option(name, value, description)->option_text(text)->group("Slurm");
  };
  add("--shards", options->shards, "N", "The number of shares, and so of jobs.")
      ->required()
      ->check(whole_within(1, render::most_shards));
  add("--frames", options->frames, "FIRST:LAST[:STEP]",
      "Render these frames of an animated scene; a share is every N-th of them. Use it with -o "
      "out.%04d.png.");
  add("--video", options->video, "FILE", "Make a video of the frames with ffmpeg, on the last job's node.");
  add("--folder", options->folder, "DIR",
      "The folder for parts, checkpoints and scripts, visible to all nodes. Default: SCENE.slurm here.");
  command
      ->add_flag("--no-submit", options->no_submit,
                 "Write the scripts and report the picture's progress, but submit nothing.")
      ->group("Slurm");
  command->add_flag("-q,--quiet", options->quiet, "Print only warnings and errors.");
  command->add_flag("--json", options->json, "Report as JSON on standard output.");
  command->footer(
      "Examples:\n"
      "  eyeray slurm scenes/whitted.toml -s 3840x2160 --spp 256 --shards 64 -- --partition=render "
      "--time=1:00:00\n"
      "  eyeray slurm scenes/animation.toml --frames 0:47 --shards 12 --video animation.mp4 -- "
      "--time=1:00:00\n"
      "Words after -- are passed to sbatch. The same command again reports the progress\n"
      "of the jobs, and submits missing shares once the jobs have ended.");
  command->callback([options, command, &run] {
    options->render_words =
        words_of_render(*command, {"--output", "--half", "--shards", "--frames", "--video", "--folder",
                                   "--no-submit", "--quiet", "--json", "--help"});
    run = [options] { return options->run(); };
  });
}

}  // namespace eyeray::engine::cli
