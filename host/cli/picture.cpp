#include "cli/picture.hpp"

#include <nlohmann/json.hpp>

#include "core/image_file.hpp"

namespace fs = std::filesystem;

namespace eyeray::cli {
namespace {

struct FlagText {
  SampleFlag flag;
  std::string_view name;
  std::string_view text;
};

constexpr FlagText flag_texts[] = {
    {media_overflow, "media_overflow", "more than four media are nested: let fewer glass shapes overlap"},
    {stack_overflow, "stack_overflow",
     "more rays were pending than the shader keeps: lower render.max_depth or raise render.min_weight"},
    {loop_budget, "loop_budget",
     "the driver's limit on loop iterations was near: try fewer shapes, --backend twin or a newer driver"},
};

void write_aovs(const PictureRequest& request, const Rendering& rendering, Picture& picture) {
  for (const Aov aov : request.aovs) {
    const Image image = aov_image(aov, rendering);
    fs::path name = request.outputs[0];
    name.replace_extension(fmt::format("{}.pfm", aov_name(aov)));
    write_image(name, image);
    picture.files.push_back(name);
    name.replace_extension("png");
    write_image(name, aov_picture(aov, image));
    picture.files.push_back(name);
  }
}

}  // namespace

void PictureRequest::add_to(CLI::App& command) {
  scene.add_to(command);
  command
      .add_option("-o,--output", outputs,
                  "Where the picture goes: .png, .pfm or .hdr. May be repeated. Default: SCENE.png here.")
      ->option_text("FILE")
      ->allow_extra_args(false)
      ->take_all();
  const auto parse = [this](const std::string& list) { aovs = parse_aovs(list); };
  command
      .add_option_function<std::string>(
          "--aov", parse,
          "Also write depth, position, normal, uv, primitive, material, hits, or all of them: each as data "
          "(FILE.NAME.pfm) and in false colour (FILE.NAME.png).")
      ->option_text("LIST");
  add_crop_option(command, crop);
  add_backend_option(command, backend);
  add_executor_options(command, executor);
}

void PictureRequest::check_outputs() {
  if (outputs.empty())
    outputs.push_back(fs::path(scene.file()).filename().replace_extension(".png").string());
  for (const std::string& output : outputs) {
    image_format(output);
    check_writable(output);
  }
}

Picture make_picture(const PictureRequest& request, const std::function<void(const Progress&)>& progress) {
  const Stopwatch watch;
  Picture picture;
  const Scene scene = picture.times.measure("load", [&] { return request.scene.load(); });
  check_crop(request.crop, scene.image);
  const std::unique_ptr<Executor> executor = make_executor(request.backend, scene, request.executor);
  const Rendering rendering =
      render(scene, *executor, {request.crop, need_first_hits(request.aovs), progress});

  picture.sources = scene.files;
  for (const fs::path& file : executor->source_files()) picture.sources.push_back(file);
  picture.device = executor->description();
  picture.crop = request.crop == Rect{} ? Rect{0, 0, scene.image.width, scene.image.height} : request.crop;
  picture.samples = scene.image.samples;
  picture.samples_done = rendering.samples_done;
  picture.rays = rendering.rays;
  picture.sampling_seconds = rendering.seconds;
  picture.flagged_pixels = rendering.flagged_pixels;
  picture.flags = rendering.flags;
  picture.interrupted = rendering.interrupted;
  for (const auto& [stage, seconds] : executor->times().stages()) picture.times.add(stage, seconds);

  // A picture in which every pixel has a sample is worth keeping; a part of one is not.
  if (rendering.samples_done > 0) {
    picture.times.measure("encode", [&] {
      for (const std::string& output : request.outputs) {
        write_image(output, rendering.color);
        picture.files.emplace_back(output);
      }
      if (!rendering.interrupted) write_aovs(request, rendering, picture);
    });
  }
  picture.seconds = watch.seconds();
  return picture;
}

std::string flag_warning(const Picture& picture) {
  if (picture.flags == 0) return "";
  std::vector<std::string_view> reasons;
  for (const FlagText& each : flag_texts) {
    if (picture.flags & each.flag) reasons.push_back(each.text);
  }
  return fmt::format("{} pixel{} may be wrong: {}", picture.flagged_pixels,
                     picture.flagged_pixels == 1 ? "" : "s", fmt::join(reasons, "; "));
}

std::string summary(const Picture& picture) {
  std::vector<std::string> names;
  for (const fs::path& file : picture.files) names.push_back(file.string());
  return fmt::format("{}: {}×{}, {} sample{} a pixel, {} rays in {} ({}) on {}", fmt::join(names, ", "),
                     picture.crop.width, picture.crop.height, picture.samples_done,
                     picture.samples_done == 1 ? "" : "s", picture.rays, format_seconds(picture.seconds),
                     format_rate(double(picture.rays) / picture.sampling_seconds), picture.device);
}

std::string stages(const StageTimes& times) {
  std::vector<std::string> parts;
  for (const auto& [stage, seconds] : times.stages())
    parts.push_back(fmt::format("{} {}", stage, format_seconds(seconds)));
  return fmt::format("{}", fmt::join(parts, ", "));
}

Json to_json(const Picture& picture) {
  Json json{{"files", Json::array()},
            {"device", picture.device},
            {"width", picture.crop.width},
            {"height", picture.crop.height},
            {"samples", picture.samples},
            {"samples_done", picture.samples_done},
            {"rays", picture.rays},
            {"seconds", picture.seconds},
            {"sampling_seconds", picture.sampling_seconds},
            {"rays_per_second", double(picture.rays) / picture.sampling_seconds},
            {"stages", to_json(picture.times)},
            {"flagged_pixels", picture.flagged_pixels},
            {"flags", Json::array()},
            {"interrupted", picture.interrupted}};
  for (const fs::path& file : picture.files) json["files"].push_back(file.string());
  for (const FlagText& each : flag_texts) {
    if (picture.flags & each.flag) json["flags"].push_back(each.name);
  }
  return json;
}

}  // namespace eyeray::cli
