#include "benchmarks/bench/pictures.hpp"

#include <nlohmann/json.hpp>

#include "host/core/error.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::bench;
using eyeray::engine::test::TemporaryFolder;
using eyeray::engine::test::write_text;

namespace {

PictureReport sample_picture(double seconds) {
  const auto spread = [](double median) { return Spread{median, 0.9 * median, 1.1 * median}; };
  PictureReport report{"scenes/a.toml", 640, 480, 4, 3, 1000, {}, {}, {}};
  report.series = {{"gpu",
                    "gpu: a device",
                    {{"whole process", spread(2 * seconds)}, {"load", spread(0.001)}},
                    spread(seconds),
                    spread(64 << 20),
                    1'000'000},
                   {"warm start", "gpu: a device", {{"whole process", spread(0.25)}}, spread(0.125), {}, 0}};
  report.povray = {{1.5, 3}};
  return report;
}

}  // namespace

TEST_CASE("a report of pictures states stages, memory, rays a second and the ratio to POV-Ray") {
  CHECK(to_text(sample_picture(0.5)) ==
        "scenes/a.toml: 640×480, 4 samples a pixel; median, least … greatest of 3 runs\n"
        "\n"
        "gpu: a device\n"
        "  whole process           1 s   900 ms … 1.1 s\n"
        "  load                   1 ms   900 µs … 1.1 ms\n"
        "  peak memory          64 MiB   67109 bytes a primitive\n"
        "  rays                1000000   2 Mrays/s\n"
        "\n"
        "warm start (gpu: a device)\n"
        "  whole process        250 ms   225 ms … 275 ms\n"
        "\n"
        "POV-Ray : gpu = 1.50 (tracing alone), 3.00 (whole process)\n"
        "\n"
        "time to first pixel: warm start 250 ms\n"
        "\n");
}

TEST_CASE("pictures are read back from JSON, and compared if size and samples are the same") {
  const TemporaryFolder folder;
  const std::string file = folder / "old.json";
  const nlohmann::ordered_json answer{{"bench", {to_json(sample_picture(0.5))}}};
  write_text(file, answer.dump());
  const std::vector<PictureReport> old = read_picture_reports(file);
  const auto one_line = [](const char* series, const char* what, double before, double after,
                           const char* unit, const char* change) {
    return fmt::format("{:<24} {:<12} {:<14} {:>8.4g} -> {:<8.4g} {} {:>7} %{}\n", "scenes/a.toml", series,
                       what, before, after, unit, change, before == after ? "  within the spread" : "");
  };
  CHECK(picture_changes(old, {sample_picture(0.25)}) ==
        one_line("gpu", "whole process", 1, 0.5, "s", "-50.0") +
            one_line("gpu", "tracing", 0.5, 0.25, "s", "-50.0") +
            one_line("gpu", "memory", 64, 64, "MiB", "+0.0") +
            one_line("warm start", "whole process", 0.25, 0.25, "s", "+0.0") +
            one_line("warm start", "tracing", 0.125, 0.125, "s", "+0.0"));
  PictureReport other = sample_picture(0.25);
  other.samples = 1;
  CHECK(picture_changes(old, {other}) == "");

  write_text(file, R"({"bench": [{"scene": "a"}]})");
  CHECK_THROWS_AS(read_picture_reports(file), Error);
}
