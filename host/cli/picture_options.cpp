#include "host/cli/picture_options.hpp"

#include <CLI/CLI.hpp>

#include "host/core/atomic_file.hpp"
#include "host/image/image_file.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::cli {
namespace {

// All channels of samples, or all of first hits.
film::Channels channels_of(bool samples) {
  film::Channels channels;
  for (const film::ChannelType& type : film::channel_types())
    if ((type.of_samples() != nullptr) == samples) channels.push_back(&type);
  return channels;
}

}  // namespace

void PictureOptions::add_to(CLI::App& command) {
  scene.add_to(command);
  command
      .add_option(
          "-o,--output", outputs,
          "The picture file to write: .png, .pfm, .hdr or .exr. May be repeated. Default: SCENE.png here.")
      ->option_text("FILE")
      ->allow_extra_args(false)
      ->take_all();
  const auto parse = [this](const std::string& list) { request.channels = film::parse_channels(list); };
  command
      .add_option_function<std::string>(
          "--aov", parse,
          fmt::format("Also write AOVs, by name, or all. Samples have {}. First hits have {}. Each is "
                      "written as data (FILE.NAME.pfm) and in false colour (FILE.NAME.png), or as a layer of "
                      "FILE.exr. Ids get a legend (FILE.NAME.json).",
                      film::channel_names(channels_of(true)), film::channel_names(channels_of(false))))
      ->option_text("LIST");
  command.add_flag("--half", half, "Write the colours of an .exr in 16 bits a channel, not 32.");
  add_crop_option(command, request.crop);
  add_backend_option(command, request.backend);
  add_executor_options(command, executor);
}

void PictureOptions::check_outputs() {
  if (request.shard) check_shard();
  if (fs::is_directory(scene.file()))
    throw Error(ExitCode::file_io, "cannot read the scene {}: it is a folder; name a scene or a mesh in it",
                scene.file());
  if (outputs.empty())
    outputs.push_back(fs::path(scene.file()).filename().replace_extension(".png").string());
  for (const std::string& output : outputs) {
    if (!request.shard) image::image_format(output);
    check_writable(output);
    // The two must differ: the checkpoint is removed when the picture is done.
    for (const std::string& file : {request.checkpoint.begin, request.checkpoint.resume}) {
      if (!file.empty() && fs::weakly_canonical(file) == fs::weakly_canonical(output))
        throw Error(ExitCode::bad_input, "{} cannot be both the picture and its checkpoint", file);
    }
  }
}

// Checks and completes the options of a share: a part is a separate file of whole pixels of the picture.
void PictureOptions::check_shard() {
  if (classic)
    throw Error(
        ExitCode::bad_input,
        "--classic computes pixels from their corners, which neighbouring shards share: leave out --shard");
  if (half)
    throw Error(ExitCode::bad_input, "--half applies to the picture, not to a part: give it to eyeray merge");
  if (outputs.size() > 1 || (!outputs.empty() && fs::path(outputs[0]).extension() != ".eyeray"))
    throw Error(ExitCode::bad_input,
                "--shard writes one part, -o NAME.eyeray; eyeray merge makes pictures of all parts");
  if (outputs.empty())
    outputs.push_back(fmt::format("{}.{}-of-{}.eyeray", fs::path(scene.file()).stem().string(),
                                  request.shard->index + 1, request.shard->count));
}

Scene PictureOptions::load() {
  Scene loaded = scene.load();
  // The scene's number of samples is chosen for pictures in which all pixels have the same number.
  if (request.noise > 0 && !scene.gives_samples()) loaded.image.samples = most_samples_by_default;
  if (classic) make_classic(loaded, request);
  return loaded;
}

}  // namespace eyeray::engine::cli
