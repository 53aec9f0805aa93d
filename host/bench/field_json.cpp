#include <nlohmann/json.hpp>

#include "bench/field.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace eyeray {
namespace {

using Json = nlohmann::ordered_json;

NLOHMANN_JSON_SERIALIZE_ENUM(Side, {{Side::ours, "ours"}, {Side::single, "single"}, {Side::packet, "packet"}})

Json to_json(const BatchReport& batch, const Lap& lap) {
  Json json{{"contender", lap.contender},
            {"side", lap.side},
            {"seconds", {{"median", lap.seconds.median}, {"min", lap.seconds.min}, {"max", lap.seconds.max}}},
            {"rays_per_second", rate(batch, lap)},
            {"differing", lap.differing}};
  if (lap.side != Side::ours) return json;
  for (const auto& [key, side] : {std::pair{"times_single", Side::single}, {"times_packet", Side::packet}}) {
    if (const double ratio = times_as_fast(batch, lap, side); ratio > 0) json[key] = ratio;
  }
  return json;
}

Lap lap_from(const Json& json) {
  const Json& seconds = json.at("seconds");
  return {json.at("contender"),
          json.at("side"),
          {seconds.at("median"), seconds.at("min"), seconds.at("max")},
          json.at("differing")};
}

}  // namespace

Json to_json(const FieldReport& report) {
  Json scenes = Json::array();
  for (const SceneReport& scene : report) {
    Json builds = Json::array(), batches = Json::array();
    for (const Build& build : scene.builds)
      builds.push_back({{"contender", build.contender}, {"seconds", build.seconds}, {"bytes", build.bytes}});
    for (const BatchReport& batch : scene.batches) {
      Json laps = Json::array();
      for (const Lap& lap : batch.laps) laps.push_back(to_json(batch, lap));
      batches.push_back({{"name", batch.name}, {"rays", batch.rays}, {"laps", laps}});
    }
    scenes.push_back({{"scene", scene.scene},
                      {"family", scene.family},
                      {"primitives", scene.primitives},
                      {"builds", builds},
                      {"batches", batches}});
  }
  return scenes;
}

FieldReport read_field_report(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  try {
    FieldReport report;
    const Json answer = Json::parse(text);
    for (const Json& scene : answer.at("field")) {
      SceneReport& entry = report.emplace_back(
          SceneReport{scene.at("scene"), scene.at("family"), scene.at("primitives"), {}, {}});
      for (const Json& build : scene.at("builds"))
        entry.builds.push_back({build.at("contender"), build.at("seconds"), build.at("bytes")});
      for (const Json& batch : scene.at("batches")) {
        BatchReport& rays = entry.batches.emplace_back(BatchReport{batch.at("name"), batch.at("rays"), {}});
        for (const Json& lap : batch.at("laps")) rays.laps.push_back(lap_from(lap));
      }
    }
    return report;
  } catch (const Json::exception&) {
    throw Error(ExitCode::bad_input, "{} is not what eyeray bench --json answers", file.string());
  }
}

}  // namespace eyeray
