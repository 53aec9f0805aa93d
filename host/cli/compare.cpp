// eyeray compare: two picture files, pixel by pixel.
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "host/cli/command.hpp"
#include "host/compare/report.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/free_memory.hpp"
#include "host/core/github_text.hpp"
#include "host/core/standard_streams.hpp"
#include "host/image/exr_file.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image_file.hpp"
#include "host/program/json.hpp"
#include "host/program/option_values.hpp"

namespace eyeray::engine::cli {
namespace {

struct CompareCommand {
  std::string a, b;
  double tolerance = compare::Tolerances{}.color;
  int64_t max_different = 0;
  std::string layer;
  std::string diff, flip, exposures;
  bool hdr = false;
  bool json = false;

  ExitCode run() const;

 private:
  void write_maps(const image::Image& image_a, const image::Image& image_b,
                  const compare::Metrics& metrics) const;
};

struct Comparison {
  std::vector<std::string> failures;
  std::optional<compare::Metrics> metrics;  // absent when the sizes differ
  std::set<std::string> not_compared = {};  // channels of the files
  int64_t pixels = 0;
  int64_t different = 0;
};

std::string describe_size(const image::Image& image) {
  return fmt::format("{}×{} in {} channel{}", image.width(), image.height(), image.channels(),
                     image.channels() == 1 ? "" : "s");
}

// Data may hold any value, unlike colours. Values that are not finite count as equal if both images have the
// same: they are set to 0.
void take_as_data(image::Image& a, image::Image& b) {
  if (!a.same_size(b)) return;
  for (size_t i = 0; i < a.sample_count(); ++i) {
    float &x = a.samples()[i], &y = b.samples()[i];
    if (!std::isfinite(x) && (x == y || (std::isnan(x) && std::isnan(y)))) x = y = 0;
  }
}

Comparison compare(const CompareCommand& command, const image::Image& a, const image::Image& b) {
  Comparison result;
  for (const auto& [name, image] : {std::pair{&command.a, &a}, {&command.b, &b}}) {
    const compare::Soundness soundness = compare::inspect(*image);
    if (!soundness.ok() && command.layer.empty())
      result.failures.push_back(fmt::format("{}: {}", *name, describe(soundness)));
  }
  if (!a.same_size(b)) {
    result.failures.push_back(
        fmt::format("the sizes differ: {} against {}", describe_size(a), describe_size(b)));
    return result;
  }

  const auto beyond_display = [](const image::Image& image) {
    return std::ranges::any_of(image.samples(), [](float value) { return value > 1; });
  };
  const bool hdr = command.layer.empty() && (beyond_display(a) || beyond_display(b));
  result.metrics = compare::measure(a, b, hdr || command.hdr);
  result.pixels = int64_t{a.width()} * a.height();
  result.different = compare::count_different(a, b, command.tolerance);
  if (result.different > command.max_different) {
    result.failures.push_back(
        fmt::format("{} of {} pixels differ by more than {} · max(1, |b|); at most {} may", result.different,
                    result.pixels, command.tolerance, command.max_different));
  }
  return result;
}

// Compares the alpha of the two files; a file without alpha counts as opaque.
void compare_alpha(const CompareCommand& command, Comparison& result) {
  std::optional<image::Image> a = image::read_alpha(command.a), b = image::read_alpha(command.b);
  if (!a && !b) return;
  for (auto [alpha, other] : {std::pair{&a, &b}, {&b, &a}}) {
    if (*alpha) continue;
    *alpha = image::Image((*other)->width(), (*other)->height(), 1);
    std::ranges::fill((*alpha)->samples(), 1.0f);
  }
  const int64_t different = compare::count_different(*a, *b, command.tolerance);
  if (different > command.max_different)
    result.failures.push_back(
        fmt::format("the alpha of {} of {} pixels differs by more than {}; that of at most {} may", different,
                    result.pixels, command.tolerance, command.max_different));
}

// The channels of the files that are not compared unless --layer names them.
std::set<std::string> channels_left_out(const CompareCommand& command) {
  std::set<std::string> names;
  for (const std::string& file : {command.a, command.b})
    if (image::image_format(file) == image::ImageFormat::exr)
      for (std::string& name : image::exr_channels_left_out(read_file(file), file))
        names.insert(std::move(name));
  return names;
}

// Writes `map` as data, or in false colour for people: over the least to the greatest number of `range`, or
// without `range` over the map's own values.
void write_map(const std::string& file, const image::Image& map, std::span<const float> range = {}) {
  const image::ImageFormat format = image::image_format(file);
  if (format == image::ImageFormat::pfm || format == image::ImageFormat::exr)
    return image::write_image(file, map);
  image::FalseColorPainter painter(image::FalseColor::scalar, 1);
  image::Image seen(int(range.size()), 1, 1);
  std::ranges::copy(range, seen.samples().begin());
  painter.see(range.empty() ? map : seen);
  image::write_image(file, painter.paint(map));
}

image::Image map_of(const image::Image& like, std::vector<float> values) {
  image::Image map(like.width(), like.height(), 1);
  map.samples() = std::move(values);
  return map;
}

Json json_of(const Comparison& result) {
  Json json{{"passed", result.failures.empty()}, {"failures", result.failures}};
  if (!result.not_compared.empty()) json["not_compared"] = result.not_compared;
  if (!result.metrics) return json;
  json["pixels"] = result.pixels;
  json["different"] = result.different;
  json["metrics"] = compare::metrics_json(*result.metrics);
  return json;
}

void CompareCommand::write_maps(const image::Image& image_a, const image::Image& image_b,
                                const compare::Metrics& metrics) const {
  if (!diff.empty()) write_map(diff, compare::log_difference(image_a, image_b));
  const std::optional<compare::HdrFlip>& hdr_flip = metrics.hdr_flip;
  if (!flip.empty()) {
    const std::vector<double> ldr = hdr_flip ? std::vector<double>() : compare::flip_map(image_a, image_b);
    write_map(flip, map_of(image_a, hdr_flip ? hdr_flip->map : std::vector<float>(ldr.begin(), ldr.end())),
              std::array{0.0f, 1.0f});
  }
  if (exposures.empty()) return;
  if (!hdr_flip)
    throw Error(ExitCode::bad_input, "--exposures {}: HDR-FLIP was not measured; --hdr asks for it",
                exposures);
  write_map(exposures, map_of(image_a, hdr_flip->exposure),
            std::array{float(hdr_flip->exposures.start), float(hdr_flip->exposures.stop)});
}

ExitCode CompareCommand::run() const {
  keep_freed_memory();  // metrics allocate dozens of planes as large as the pictures
  for (const auto& [option, file] :
       {std::pair{"--diff", diff}, {"--flip", flip}, {"--exposures", exposures}}) {
    if (file.empty()) continue;
    image::image_format(file);
    check_writable(file);
    for (const std::string& read : {a, b}) {
      std::error_code absent;
      if (std::filesystem::equivalent(file, read, absent))
        throw Error(ExitCode::bad_input, "{} is compared, but {} would overwrite it: name another file", file,
                    option);
    }
  }
  // --aov writes a layer of an .exr, or a file for each AOV: so one of the two files may be no .exr.
  if (!layer.empty() && image::image_format(a) != image::ImageFormat::exr &&
      image::image_format(b) != image::ImageFormat::exr)
    throw Error(ExitCode::bad_input, "--layer {} needs an .exr: neither {} nor {} is one", layer, a, b);
  std::vector<std::string> warnings;
  image::Image image_a = image::read_image(a, layer, warnings),
               image_b = image::read_image(b, layer, warnings);
  for (const std::string& warning : warnings) print_lines(stderr, "eyeray: warning: {}\n", warning);
  if (!layer.empty()) take_as_data(image_a, image_b);
  if (image_a.channels() != image_b.channels())  // grey is equal red, green and blue
    for (image::Image* grey : {&image_a, &image_b}) *grey = image::in_color(std::move(*grey));
  Comparison result = compare(*this, image_a, image_b);
  if (layer.empty() && result.metrics) compare_alpha(*this, result);
  if (layer.empty()) result.not_compared = channels_left_out(*this);
  if (result.metrics) write_maps(image_a, image_b, *result.metrics);

  if (json) {
    print_json(json_of(result));
  } else {
    print_lines(stdout, "{} {} {}\n", result.failures.empty() ? "PASSED" : "FAILED", log_line(a),
                log_line(b));
    for (const std::string& failure : result.failures) print_lines(stdout, "  {}\n", failure);
    if (result.metrics) {
      if (result.different <= max_different)
        print_lines(stdout, "  {} of {} pixels differ by more than {} · max(1, |b|)\n", result.different,
                    result.pixels, tolerance);
      fmt::print("{}", to_lines(*result.metrics, "  "));
    }
    if (!result.not_compared.empty())
      print_lines(stdout, "  not compared: {}; --layer compares a layer\n",
                  log_line(fmt::format("{}", fmt::join(result.not_compared, ", "))));
  }
  return result.failures.empty() ? ExitCode::ok : ExitCode::comparison_failed;
}

}  // namespace

void add_compare(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand("compare", "Compare two picture files.");
  const auto options = std::make_shared<CompareCommand>();
  command->add_option("A", options->a, "A picture: .pfm, .png, .hdr or .exr.")->required();
  command->add_option("B", options->b, "The picture to compare it with.")->required();
  command
      ->add_option("--tolerance", options->tolerance,
                   "The tolerance of each channel's linear value, relative to max(1, |b|).")
      ->option_text(fmt::format("T={}", options->tolerance))
      ->check(within(0, 1));
  command
      ->add_option("--max-different", options->max_different, "The number of pixels that may differ by more.")
      ->option_text("N=0")
      ->check(whole_within(0, 1 << 28));
  command->add_option("--layer", options->layer, "The layer of an .exr to compare. Default: its picture.")
      ->option_text("NAME");
  command
      ->add_option("--diff", options->diff,
                   "Write the difference: a false-colour .png, or log10 as .pfm or .exr.")
      ->option_text("FILE");
  command->add_flag("--hdr", options->hdr, "Measure HDR-FLIP too. Default: if a picture has values above 1.");
  command
      ->add_option("--flip", options->flip,
                   "Write the errors of FLIP, or of HDR-FLIP if it is measured: in false colour from 0 to 1, "
                   "or as data.")
      ->option_text("FILE");
  command
      ->add_option("--exposures", options->exposures,
                   "Write the exposure, in stops, at which HDR-FLIP finds each error.")
      ->option_text("FILE");
  command->add_flag("--json", options->json, "Report as JSON.");
  command->footer(
      "Example: eyeray compare new.pfm old.pfm --diff difference.png\n"
      "Exit code 0 when they agree, 1 when not. A NaN, an infinity or a negative colour\nin either picture "
      "fails.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::engine::cli
