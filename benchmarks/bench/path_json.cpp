#include <nlohmann/json.hpp>

#include "benchmarks/bench/paths.hpp"
#include "benchmarks/bench/spread_json.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/error.hpp"
#include "host/core/json_depth.hpp"

namespace eyeray::engine::bench {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const PathSeries& series, double pixels) {
  Json levels = Json::array();
  for (const PathLevel& level : series.levels) {
    Json json{{"samples", level.samples},
              {"seconds", to_json(level.seconds)},
              {"cpu_seconds", to_json(level.processor)},
              {"cpu_seconds_of_process", to_json(level.whole_processor)},
              {"paths_per_second", pixels * level.samples / level.seconds.median}};
    if (level.rays > 0) {
      json["rays"] = level.rays;
      json["rays_per_second"] = double(level.rays) / level.seconds.median;
    }
    if (level.error > 0) {
      json["mse"] = level.error;
      json["relative_mse"] = level.relative_error;
      json["efficiency"] = level.efficiency();
    }
    levels.push_back(json);
  }
  Json json{{"name", series.name}, {"device", series.device}, {"levels", levels}};
  if (series.levels.back().error > 0) json["slope"] = series.slope();
  return json;
}

PathSeries path_series_from(const Json& json) {
  PathSeries series{json.at("name"), json.at("device"), {}};
  for (const Json& each : json.at("levels")) {
    PathLevel& level = series.levels.emplace_back();
    level.samples = each.at("samples");
    level.processor = spread_from(each.at("cpu_seconds"));
    level.error = each.value("mse", 0.0);
  }
  if (series.levels.empty()) series.levels.emplace_back();
  return series;
}

Json to_json(const Likeness& likeness) {
  Json json{{"name", likeness.name},
            {"regions", likeness.regions},
            {"mean", likeness.theirs},
            {"mean_of_gpu", likeness.ours},
            {"standard_error", likeness.standard_error},
            {"greatest_difference", likeness.greatest}};
  if (likeness.judged)
    json.update(
        {{"p", likeness.p}, {"threshold", likeness.threshold}, {"within_noise", likeness.within_noise()}});
  return json;
}

}  // namespace

Json to_json(const PathReport& report) {
  Json json{{"scene", report.scene}, {"width", report.width},   {"height", report.height},
            {"runs", report.runs},   {"series", Json::array()}, {"likeness", Json::array()}};
  for (const PathSeries& series : report.series)
    json["series"].push_back(to_json(series, double(report.width) * report.height));
  for (const Likeness& likeness : report.likeness) json["likeness"].push_back(to_json(likeness));
  if (!report.reference.empty()) {
    const EqualTime equal = at_equal_time(report.series.at(1), report.series.at(0));
    json["reference"] = report.reference;
    json["equal_time"] = {{"cpu_seconds", equal.processor}, {"rmse_of_path_over_sppm", equal.ratio}};
  }
  return json;
}

std::vector<PathReport> read_path_reports(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  try {
    std::vector<PathReport> reports;
    const Json answer = Json::parse(unless_too_deep(text));
    for (const Json& json : answer.value("paths", Json::array())) {
      PathReport& report = reports.emplace_back();
      report.scene = json.at("scene");
      report.width = json.at("width");
      report.height = json.at("height");
      for (const Json& series : json.at("series")) report.series.push_back(path_series_from(series));
    }
    return reports;
  } catch (const Json::exception&) {
    throw Error(ExitCode::bad_input, "{} is not what eyeray-bench --json answers", file.string());
  }
}

}  // namespace eyeray::engine::bench
