#include <nlohmann/json.hpp>

#include "benchmarks/bench/pictures.hpp"
#include "benchmarks/bench/spread_json.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/error.hpp"
#include "host/core/json_depth.hpp"

namespace eyeray::engine::bench {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const SeriesReport& series) {
  Json stages = Json::object();
  for (const auto& [stage, seconds] : series.stages) stages[stage] = to_json(seconds);
  Json json{{"name", series.name},
            {"device", series.device},
            {"seconds", stages},
            {"tracing", to_json(series.tracing)}};
  if (series.peak_memory) json["peak_memory"] = to_json(*series.peak_memory);
  if (series.rays > 0) {
    json["rays"] = series.rays;
    json["rays_per_second"] = double(series.rays) / series.tracing.median;
  }
  return json;
}

SeriesReport series_from(const Json& json) {
  const char* const whole = "whole process";
  SeriesReport series;
  series.name = json.at("name");
  series.stages = {{whole, spread_from(json.at("seconds").at(whole))}};
  series.tracing = spread_from(json.at("tracing"));
  if (json.contains("peak_memory")) series.peak_memory = spread_from(json.at("peak_memory"));
  return series;
}

}  // namespace

Json to_json(const PictureReport& report) {
  Json json{{"scene", report.scene},     {"width", report.width}, {"height", report.height},
            {"samples", report.samples}, {"runs", report.runs},   {"primitives", report.primitives},
            {"series", Json::array()}};
  for (const SeriesReport& series : report.series) json["series"].push_back(to_json(series));
  if (report.povray)
    json["times_faster_than_povray"] = {{"tracing", report.povray->tracing},
                                        {"whole process", report.povray->whole_process}};
  if (!report.kernels.empty()) json["kernels"] = Json::parse(report.kernels).at("kernels");
  return json;
}

std::vector<PictureReport> read_picture_reports(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  try {
    std::vector<PictureReport> pictures;
    const Json answer = Json::parse(unless_too_deep(text));
    for (const Json& json : answer.at("bench")) {
      PictureReport& picture = pictures.emplace_back();
      picture.scene = json.at("scene");
      picture.width = json.at("width");
      picture.height = json.at("height");
      picture.samples = json.at("samples");
      for (const Json& series : json.at("series")) picture.series.push_back(series_from(series));
    }
    return pictures;
  } catch (const Json::exception&) {
    throw Error(ExitCode::bad_input, "{} is not what eyeray-bench --json answers", file.string());
  }
}

}  // namespace eyeray::engine::bench
