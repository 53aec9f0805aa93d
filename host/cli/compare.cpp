// eyeray compare: two picture files, pixel by pixel.
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/cli/command.hpp"
#include "host/cli/json.hpp"
#include "host/cli/within.hpp"
#include "host/compare/report.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image_file.hpp"

namespace eyeray::cli {
namespace {

struct Command {
  std::string a, b;
  double tolerance = compare::Tolerances{}.color;
  int64_t max_different = 0;
  std::string layer;
  std::string diff;
  bool json = false;

  ExitCode run() const;
};

struct Comparison {
  std::vector<std::string> failures;
  std::optional<compare::Metrics> metrics;  // absent when the sizes differ
  int64_t pixels = 0;
  int64_t different = 0;
};

std::string describe_size(const Image& image) {
  return fmt::format("{}×{} in {} channel{}", image.width(), image.height(), image.channels(),
                     image.channels() == 1 ? "" : "s");
}

// Of data, unlike colours, any value may be right. What is not finite and the same in both counts as equal.
void take_as_data(Image& a, Image& b) {
  if (!a.same_size(b)) return;
  for (size_t i = 0; i < a.sample_count(); ++i) {
    float &x = a.samples()[i], &y = b.samples()[i];
    if (!std::isfinite(x) && (x == y || (std::isnan(x) && std::isnan(y)))) x = y = 0;
  }
}

Comparison compare(const Command& command, const Image& a, const Image& b) {
  Comparison result;
  for (const auto& [name, image] : {std::pair{&command.a, &a}, {&command.b, &b}}) {
    const compare::Soundness soundness = compare::inspect(*image);
    if (!soundness.ok() && command.layer.empty())
      result.failures.push_back(fmt::format("{}: {}", *name, describe(soundness)));
  }
  if (!a.same_size(b)) {
    result.failures.push_back(fmt::format("wrong size: {} against {}", describe_size(a), describe_size(b)));
    return result;
  }

  result.metrics = compare::measure(a, b);
  result.pixels = int64_t{a.width()} * a.height();
  result.different = compare::count_different(a, b, command.tolerance);
  if (result.different > command.max_different) {
    result.failures.push_back(fmt::format("{} of {} pixels differ by more than {} · max(1, |b|); {} may",
                                          result.different, result.pixels, command.tolerance,
                                          command.max_different));
  }
  return result;
}

Json to_json(const Comparison& result) {
  Json json{{"passed", result.failures.empty()}, {"failures", result.failures}};
  if (!result.metrics) return json;
  json["pixels"] = result.pixels;
  json["different"] = result.different;
  json["metrics"] = compare::metrics_json(*result.metrics);
  return json;
}

ExitCode Command::run() const {
  if (!diff.empty()) {
    image_format(diff);
    check_writable(diff);
    for (const std::string& read : {a, b}) {
      std::error_code absent;
      if (std::filesystem::equivalent(diff, read, absent))
        throw Error(ExitCode::bad_input, "{} is compared, and --diff would overwrite it", diff);
    }
  }
  // Of a layer and a file of its own, as --aov writes them, either may be the .exr.
  if (!layer.empty() && image_format(a) != ImageFormat::exr && image_format(b) != ImageFormat::exr)
    throw Error(ExitCode::bad_input, "--layer {}: neither {} nor {} is an .exr", layer, a, b);
  Image image_a = read_image(a, layer), image_b = read_image(b, layer);
  if (!layer.empty()) take_as_data(image_a, image_b);
  const Comparison result = compare(*this, image_a, image_b);
  if (!diff.empty() && result.metrics) {
    const Image difference = compare::log_difference(image_a, image_b);
    const ImageFormat format = image_format(diff);
    const bool as_data = format == ImageFormat::pfm || format == ImageFormat::exr;
    write_image(diff, as_data ? difference : false_color(difference, FalseColor::scalar));
  }

  if (json) {
    print_json(to_json(result));
  } else {
    fmt::print("{} {} {}\n", result.failures.empty() ? "PASSED" : "FAILED", a, b);
    for (const std::string& failure : result.failures) fmt::print("  {}\n", failure);
    if (result.metrics) {
      if (result.different <= max_different)
        fmt::print("  {} of {} pixels differ by more than {} · max(1, |b|)\n", result.different,
                   result.pixels, tolerance);
      fmt::print("{}", to_lines(*result.metrics, "  "));
    }
  }
  return result.failures.empty() ? ExitCode::ok : ExitCode::comparison_failed;
}

}  // namespace

void add_compare(CLI::App& app, Run& run) {
  CLI::App* const command = app.add_subcommand("compare", "Compare two picture files.");
  const auto options = std::make_shared<Command>();
  command->add_option("A", options->a, "A picture: .pfm, .png, .hdr or .exr.")->required()->option_text(" ");
  command->add_option("B", options->b, "The picture that it should be.")->required()->option_text(" ");
  command
      ->add_option("--tolerance", options->tolerance,
                   "Of each channel, relative to max(1, |b|); linear values.")
      ->option_text(fmt::format("T={}", options->tolerance))
      ->check(within(0, 1));
  command->add_option("--max-different", options->max_different, "How many pixels may differ by more.")
      ->option_text("N=0")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--layer", options->layer, "The layer of an .exr that is compared. Default: its picture.")
      ->option_text("NAME");
  command
      ->add_option("--diff", options->diff,
                   "Write the difference: a false-colour .png, or log10 as .pfm or .exr.")
      ->option_text("FILE");
  command->add_flag("--json", options->json, "Report as JSON.");
  command->footer(
      "Example: eyeray compare new.pfm old.pfm --diff difference.png\n"
      "Exit code 0 when they agree, 1 when not; a NaN, an infinity or a negative colour in either fails.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::cli
