// eyeray slurm: pictures as arrays of Slurm's jobs (docs/many-machines.md).
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "host/cli/build_facts.hpp"
#include "host/cli/frames.hpp"
#include "host/cli/picture.hpp"
#include "host/cli/within.hpp"
#include "host/core/content_hash.hpp"
#include "host/core/standard_streams.hpp"
#include "host/core/termination.hpp"
#include "host/slurm/array_render.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {
namespace {

struct SlurmCommand {
  PictureRequest request;
  std::vector<std::string> more_scenes;
  std::vector<std::string> sbatch_words;
  std::vector<std::string> render_words = {};
  int shards = 0;
  int retries = 2;
  std::string folder;
  std::string frames;  // FIRST:LAST[:STEP]; empty: the one that the scene shows
  std::string video;   // of them; empty: none
  double poll_seconds = 5;
  bool submit_only = false;
  bool quiet = false;
  bool json = false;

  ExitCode run();
  void check_options() const;
  slurm::ArrayRequest array_of(const std::string& scene) const;
  void add_outputs(slurm::ArrayRequest& array) const;
  void watch(std::vector<slurm::ArrayRender>& renders) const;
};

// The options that `render` has too, as they were given.
std::vector<std::string> words_of_render(const CLI::App& command, const std::vector<std::string>& own) {
  std::vector<std::string> words;
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || !name.starts_with('-') || std::ranges::find(own, name) != own.end()) continue;
    if (option->get_items_expected_max() == 0) {
      words.push_back(name);
      continue;
    }
    for (const std::string& value : option->results()) {
      words.push_back(name);
      words.push_back(value);
    }
  }
  return words;
}

void SlurmCommand::check_options() const {
  for (const std::string& word : sbatch_words)
    for (const char* own : {"--array", "-a", "--wrap", "--parsable", "--dependency", "-d"})
      if (word == own || word.starts_with(std::string(own) + "="))
        throw Error(ExitCode::bad_input, "{} is eyeray's to say: leave it out", own);
  if (!more_scenes.empty() && (!request.outputs.empty() || !folder.empty()))
    throw Error(ExitCode::bad_input,
                "several scenes have a picture and a folder each, named after them: leave out "
                "-o and --folder");
  if (!more_scenes.empty() && !video.empty()) throw Error(ExitCode::bad_input, "--video is of one scene");
  if (!video.empty() && frames.empty()) throw Error(ExitCode::bad_input, "--video is about --frames");
  if (!video.empty()) check_video_name(video);
}

// Adds the products of the array: pictures that a merge writes, or frames, each by a share of them.
void SlurmCommand::add_outputs(slurm::ArrayRequest& array) const {
  const fs::path name = fs::path(array.scene).filename();
  std::vector<std::string> outputs = request.outputs;
  if (outputs.empty())
    outputs.push_back(frames.empty() ? fs::path(name).replace_extension(".png").string()
                                     : name.stem().string() + ".%04d.png");
  std::vector<std::string>& words = frames.empty() ? array.merge_words : array.frame_words;
  if (!frames.empty()) words = {"--frames", frames};
  for (const std::string& output : outputs) words.insert(words.end(), {"-o", output});
  if (request.half) words.emplace_back("--half");

  if (frames.empty()) {
    array.files = outputs;
    return;
  }
  for (const int frame : parse_frames(frames))
    for (const std::string& output : outputs) array.files.push_back(frame_name(output, frame));
  array.video = video;
  if (!video.empty()) array.files.push_back(video);
}

slurm::ArrayRequest SlurmCommand::array_of(const std::string& scene) const {
  const SceneOptions options = request.scene.for_file(scene);
  // Faults of a scene are errors now, not on the nodes.
  const Scene loaded = options.load();
  check_crop(request.crop, loaded.image);

  slurm::ArrayRequest array;
  array.program = fs::read_symlink("/proc/self/exe").string();
  array.scene = scene;
  array.render_words = render_words;
  add_outputs(array);
  array.sbatch_words = sbatch_words;
  array.folder = folder.empty() ? fs::path(scene).stem().string() + ".slurm" : folder;
  array.shards = shards;
  array.retries = retries;
  ContentHash hash;
  hash.add(hash_of_files(loaded.files)).add(sum_of_sources()).add(std::to_string(shards));
  for (const std::string& word : render_words) hash.add(word);
  for (const std::string& word : array.frame_words) hash.add(word);
  array.identity = hash.hex();
  return array;
}

std::string text_of(const slurm::ArrayRender& render, const slurm::ArrayProgress& progress) {
  std::string text =
      fmt::format("{}: {} of {} parts", render.request().scene, progress.parts, render.request().shards);
  if (progress.done) return text + (render.request().frame_words.empty() ? ", merged" : ", done");
  if (!progress.trouble.empty()) return text + "; Slurm does not answer: " + progress.trouble;
  if (progress.merging) return text + ", being merged";
  return text + fmt::format(", {} running, {} waiting{}", progress.running, progress.waiting,
                            progress.reason.empty() ? "" : " (" + progress.reason + ")");
}

// Until all pictures are there.
void SlurmCommand::watch(std::vector<slurm::ArrayRender>& renders) const {
  std::vector<std::string> said(renders.size());
  std::vector<bool> done(renders.size());
  while (true) {
    for (size_t i = 0; i < renders.size(); ++i) {
      if (done[i]) continue;
      const slurm::ArrayProgress progress = renders[i].look();
      done[i] = progress.done;
      const std::string text = text_of(renders[i], progress);
      if (!quiet && text != said[i]) print_lines(stderr, "{}\n", text);
      said[i] = text;
    }
    if (submit_only || std::ranges::all_of(done, std::identity())) return;
    const Stopwatch watch;
    while (watch.seconds() < poll_seconds && !interrupted())
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (interrupted()) return;
  }
}

ExitCode SlurmCommand::run() {
  check_options();
  std::vector<std::string> scenes{request.scene.file()};
  scenes.insert(scenes.end(), more_scenes.begin(), more_scenes.end());
  std::vector<slurm::ArrayRender> renders;
  renders.reserve(scenes.size());
  for (const std::string& scene : scenes) renders.emplace_back(array_of(scene));
  {
    // Between a job's submission and the note of its number nothing is to end.
    const Saving saving;
    watch(renders);
  }

  std::vector<int> jobs;
  int retried = 0;
  Json files = Json::array();
  for (const slurm::ArrayRender& render : renders) {
    std::ranges::copy(render.jobs(), std::back_inserter(jobs));
    retried += render.retried();
    for (const std::string& file : render.request().files) files.push_back(file);
  }
  if (interrupted())
    throw Error(ExitCode::interrupted,
                "interrupted; the jobs go on: the same command shows them again, and scancel {} ends them",
                fmt::join(jobs, " "));
  if (json)
    print_json({{"files", files}, {"jobs", jobs}, {"retried", retried}, {"submitted_only", submit_only}});
  return ExitCode::ok;
}

}  // namespace

void add_slurm(CLI::App& app, Run& run, const std::vector<std::string>& sbatch_words) {
  CLI::App* const command = app.add_subcommand("slurm", "Render a scene on a Slurm cluster, a share a job.");
  const auto options = std::make_shared<SlurmCommand>();
  options->sbatch_words = sbatch_words;
  options->request.add_to(*command);
  const std::string group = "Slurm";
  command->add_option("MORE", options->more_scenes, "Further scenes, under the same options.")
      ->option_text(" ");
  command->add_option("--shards", options->shards, "How many shares, and so jobs, there are.")
      ->option_text("N")
      ->required()
      ->check(CLI::Range(1, render::most_shards))
      ->group(group);
  command
      ->add_option("--frames", options->frames,
                   "These frames of a scene that moves, every N-th of them a share; -o out.%04d.png.")
      ->option_text("FIRST:LAST[:STEP]")
      ->group(group);
  command->add_option("--video", options->video, "A video of them, too, by ffmpeg on the last job's node.")
      ->option_text("FILE")
      ->group(group);
  command
      ->add_option("--folder", options->folder,
                   "For parts, checkpoints and scripts, where all nodes see it. Default: SCENE.slurm here.")
      ->option_text("DIR")
      ->group(group);
  command->add_option("--retries", options->retries, "How often a share that failed is tried again.")
      ->option_text("N=2")
      ->check(CLI::Range(0, 1000))
      ->group(group);
  command->add_option("--poll", options->poll_seconds, "How often Slurm is asked.")
      ->option_text("SECONDS=5")
      ->check(within(0.05, 3600))
      ->group(group);
  command
      ->add_flag("--submit-only", options->submit_only,
                 "Submit what is missing and end; the same command looks again.")
      ->group(group);
  command->add_flag("-q,--quiet", options->quiet, "No progress; warnings and errors remain.");
  command->add_flag("--json", options->json, "Say what was done as JSON on standard output.");
  command->footer(
      "Examples:\n"
      "  eyeray slurm scenes/whitted.toml -s 3840x2160 --spp 256 --shards 64 -- --partition=render "
      "--time=1:00:00\n"
      "  eyeray slurm scenes/animation.toml --frames 0:47 --shards 12 --video animation.mp4 -- "
      "--time=1:00:00\n"
      "Words behind -- are sbatch's. Ctrl-C leaves the jobs running: the same command takes them up again.");
  command->callback([options, command, &run] {
    options->render_words =
        words_of_render(*command, {"--output", "--half", "--shards", "--frames", "--video", "--folder",
                                   "--retries", "--poll", "--submit-only", "--quiet", "--json", "--help"});
    run = [options] { return options->run(); };
  });
}

}  // namespace eyeray::cli
