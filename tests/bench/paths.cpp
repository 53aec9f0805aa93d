#include "benchmarks/bench/paths.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "benchmarks/bench/welch.hpp"
#include "host/core/error.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::bench;
using eyeray::engine::test::TemporaryFolder;
using eyeray::engine::test::write_text;

namespace {

Spread fixed_spread(double value) {
  return {value, value, value};
}

// A renderer whose error is `noise` / samples^steepness, and that takes `cost` seconds a sample.
PathSeries series_named(const char* name, double noise, double steepness, double cost) {
  PathSeries result{name, "a device", {}};
  for (const int samples : {4, 16, 64})
    result.levels.push_back({samples, fixed_spread(cost * samples / 2), fixed_spread(cost * samples),
                             fixed_spread(cost * samples + 1), uint64_t(1000 * samples),
                             noise * std::pow(samples, -steepness), 0.0001});
  return result;
}

PathReport sample_path_report() {
  return {
      "a.toml",
      10,
      10,
      5,
      {series_named("gpu", 8, 1.5, 0.25), series_named("gpu, random", 8, 1, 0.25),
       series_named("Cycles", 8, 1, 0.5)},
      {{.name = "Cycles",
        .regions = 16,
        .ours = 0.5,
        .theirs = 0.501,
        .standard_error = 0.001,
        .greatest = 0.01,
        .t = 3,
        .p = 0.01,
        .threshold = 2e-5},
       {.name = "POV-Ray", .regions = 16, .ours = 0.5, .theirs = 0.6, .greatest = 0.25, .judged = false}}};
}

}  // namespace

TEST_CASE("a series has a slope, and a time to reach an equal error") {
  const PathReport report = sample_path_report();
  CHECK(report.series[0].slope() == doctest::Approx(-1.5));
  CHECK(report.series[1].slope() == doctest::Approx(-1));
  // Cycles' error at 64 samples is ours at 16, which cost 16 · 0.25 s.
  CHECK(report.series[2].levels[2].error == doctest::Approx(report.series[0].levels[1].error));
  CHECK(report.series[0].processor_until(report.series[2].levels[2].error) == doctest::Approx(4));
  // Sample counts between the levels, below the lowest and above the highest.
  for (const int samples : {1, 2, 8, 32, 256})
    CHECK(report.series[0].processor_until(8 * std::pow(samples, -1.5)) == doctest::Approx(0.25 * samples));
}

TEST_CASE("errors after a given time, and of two renderers at an equal time, are interpolated") {
  const PathReport report = sample_path_report();
  // The error is 8 / samples^1.5 at 0.25 s a sample: at and between the levels, below the lowest and above
  // the highest.
  for (const int samples : {1, 2, 4, 8, 32, 64, 256})
    CHECK(report.series[0].error_after(0.25 * samples) == doctest::Approx(8 * std::pow(samples, -1.5)));
  // Our series takes 16 s in all, the other 32 s. After 16 s the other has taken 32 samples, and its error is
  // 8 / 32.
  const EqualTime equal = at_equal_time(report.series[2], report.series[0]);
  CHECK(equal.processor == doctest::Approx(16));
  CHECK(equal.ratio == doctest::Approx(std::sqrt((8.0 / 32) / (8 * std::pow(64, -1.5)))));
}

TEST_CASE("a report of photons states its reference, and the error of paths at an equal time") {
  PathReport report = sample_path_report();
  CHECK(to_text(report).find("path : sppm") == std::string::npos);
  CHECK_FALSE(to_json(report).contains("equal_time"));
  report.series = {series_named("gpu, sppm", 8, 1.5, 0.25), series_named("gpu, path", 8, 1, 0.5)};
  report.likeness = {};
  report.reference = "two pictures";
  CHECK(to_text(report).find("errors are against two pictures\n"
                             "after 16 CPU seconds, RMSE, path : sppm = 4.00\n") != std::string::npos);
  const auto json = to_json(report);
  CHECK(json.at("reference") == "two pictures");
  CHECK(json.at("equal_time").at("rmse_of_path_over_sppm") == doctest::Approx(4));
}

TEST_CASE("a report of paths states rates, error, efficiency, slopes and comparisons with other renderers") {
  const std::string text = to_text(sample_path_report());
  const auto row = [](const char* name, const char* a, const char* b, const char* c) {
    return fmt::format("  {:<26}{:>12}{:>12}{:>12}\n", name, a, b, c);
  };
  const std::string ours =
      "\ngpu (a device)\n" + row("samples a pixel", "4", "16", "64") +
      row("Mpaths/s", "0.0008", "0.0008", "0.0008") + row("Mrays/s", "0.008", "0.008", "0.008") +
      row("Mpaths a CPU second", "0.0004", "0.0004", "0.0004") + row("CPU s", "1", "4", "16") +
      row("CPU s, whole process", "2", "5", "17") + row("MSE", "1", "0.125", "0.0156") +
      row("relative error, rms", "1.00 %", "1.00 %", "1.00 %") + row("1 / (MSE · CPU s)", "1", "2", "4") +
      "  MSE falls as samples to the -1.50\n";
  CAPTURE(text);
  CHECK(text.find(ours) != std::string::npos);
  CHECK(text.find(
            "Cycles beside gpu: mean 0.501, 0.5 ± 0.001; 16 regions differ by up to 1 %, within the noise "
            "(p = 0.01 of 2e-05)\n") != std::string::npos);
  CHECK(
      text.find("POV-Ray beside gpu: mean 0.6, 0.5 ± 0; 16 regions differ by up to 25 % (it is biased)\n") !=
      std::string::npos);
  CHECK(
      text.find(
          "Cycles : gpu = 2.00 for as many samples, 8.00 for an equal error, 6.60 with whole processes\n") !=
      std::string::npos);
}

TEST_CASE("paths are read back from JSON, and compared if the last level is the same") {
  const TemporaryFolder folder;
  const std::string file = folder / "old.json";
  const nlohmann::ordered_json answer{{"paths", {to_json(sample_path_report())}}};
  write_text(file, answer.dump());
  PathReport now = sample_path_report();
  now.series = {series_named("gpu", 8, 1.5, 0.125)};
  CHECK(path_changes(read_path_reports(file), {now}) ==
        fmt::format("{:<24} {:<12} {:<14} {:>8} -> {:<8} {:>7} %\n", "a.toml", "gpu", "CPU s", "16", "8",
                    "-50.0") +
            fmt::format("{:<24} {:<12} {:<14} {:>8} -> {:<8} {:>7} %\n", "a.toml", "gpu", "MSE", "0.01562",
                        "0.01562", "+0.0"));
  now.width = 11;
  CHECK(path_changes(read_path_reports(file), {now}) == "");
  write_text(file, R"({"paths": [{"scene": "a"}]})");
  CHECK_THROWS_AS(read_path_reports(file), Error);
  write_text(file, R"({"bench": [], "field": []})");  // a file of an older version
  CHECK(read_path_reports(file).empty());
}

TEST_CASE("Student's distribution agrees with tables, and Welch's test with its formula") {
  CHECK(student_tails(12.706, 1) == doctest::Approx(0.05).epsilon(1e-3));
  CHECK(student_tails(2.776, 4) == doctest::Approx(0.05).epsilon(1e-3));
  CHECK(student_tails(5.598, 31) == doctest::Approx(3.9e-6).epsilon(0.02));
  CHECK(student_tails(1.96, 1e7) == doctest::Approx(0.05).epsilon(1e-3));
  CHECK(student_tails(0, 7) == doctest::Approx(1));

  const std::vector<double> a{1, 2, 3}, b{2, 4, 6, 8};
  const Moments first = moments(a), second = moments(b);
  CHECK(first.mean == 2);
  CHECK(first.variance == 1);
  CHECK(second.variance == doctest::Approx(20.0 / 3));
  const WelchTest test = welch(first, second);
  CHECK(test.t == doctest::Approx(3 / std::sqrt(2.0)));
  CHECK(test.freedom == doctest::Approx(4 / (1.0 / 18 + (25.0 / 9) / 3)));
  // Without noise, only equal means count as the same.
  CHECK(welch({0.5, 0, 4}, {0.5, 0, 4}).p == 1);
  CHECK(welch({0.5, 0, 4}, {0.6, 0, 4}).p == 0);
}
