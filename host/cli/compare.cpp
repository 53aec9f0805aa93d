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

Comparison compare(const Command& command, const Image& a, const Image& b) {
  Comparison result;
  for (const auto& [name, image] : {std::pair{&command.a, &a}, {&command.b, &b}}) {
    const compare::Soundness soundness = compare::inspect(*image);
    if (!soundness.ok()) result.failures.push_back(fmt::format("{}: {}", *name, describe(soundness)));
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
  const Image image_a = read_image(a), image_b = read_image(b);
  const Comparison result = compare(*this, image_a, image_b);
  if (!diff.empty() && result.metrics) {
    const Image difference = compare::log_difference(image_a, image_b);
    const bool as_data = image_format(diff) == ImageFormat::pfm;
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
  command->add_option("A", options->a, "A picture: .pfm, .png or .hdr.")->required()->option_text(" ");
  command->add_option("B", options->b, "The picture that it should be.")->required()->option_text(" ");
  command
      ->add_option("--tolerance", options->tolerance,
                   "Of each channel, relative to max(1, |b|); linear values.")
      ->option_text(fmt::format("T={}", options->tolerance))
      ->check(within(0, 1));
  command->add_option("--max-different", options->max_different, "How many pixels may differ by more.")
      ->option_text("N=0")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--diff", options->diff, "Write the difference: a false-colour .png, or log10 as .pfm.")
      ->option_text("FILE");
  command->add_flag("--json", options->json, "Report as JSON.");
  command->footer(
      "Example: eyeray compare new.pfm old.pfm --diff difference.png\n"
      "Exit code 0 when they agree, 1 when not; a NaN, an infinity or a negative colour in either fails.");
  command->callback([options, &run] { run = [options] { return options->run(); }; });
}

}  // namespace eyeray::cli
