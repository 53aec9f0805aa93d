#include <nlohmann/json.hpp>

#include "benchmarks/bench/field.hpp"
#include "host/core/atomic_file.hpp"
#include "host/core/error.hpp"
#include "host/core/json_depth.hpp"

namespace eyeray::engine::bench {

// In the namespace of the type, where the JSON library finds it.
NLOHMANN_JSON_SERIALIZE_ENUM(ContenderKind, {{ContenderKind::ours, "ours"},
                                             {ContenderKind::single, "single"},
                                             {ContenderKind::packet, "packet"}})

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const BatchReport& batch, const Timing& timing) {
  Json json{{"contender", timing.contender},
            {"kind", timing.kind},
            {"seconds",
             {{"median", timing.seconds.median}, {"min", timing.seconds.min}, {"max", timing.seconds.max}}},
            {"rays_per_second", rate(batch, timing)},
            {"differing", timing.differing}};
  if (timing.kind != ContenderKind::ours) return json;
  for (const auto& [key, kind] :
       {std::pair{"times_single", ContenderKind::single}, {"times_packet", ContenderKind::packet}}) {
    if (const double ratio = times_as_fast(batch, timing, kind); ratio > 0) json[key] = ratio;
  }
  return json;
}

Timing timing_from(const Json& json) {
  const Json& seconds = json.at("seconds");
  return {json.at("contender"),
          json.at("kind"),
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
      Json timings = Json::array();
      for (const Timing& timing : batch.timings) timings.push_back(to_json(batch, timing));
      batches.push_back({{"name", batch.name}, {"rays", batch.rays}, {"timings", timings}});
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
    const Json answer = Json::parse(unless_too_deep(text));
    for (const Json& scene : answer.at("field")) {
      SceneReport& entry = report.emplace_back(
          SceneReport{scene.at("scene"), scene.at("family"), scene.at("primitives"), {}, {}});
      for (const Json& build : scene.at("builds"))
        entry.builds.push_back({build.at("contender"), build.at("seconds"), build.at("bytes")});
      for (const Json& batch : scene.at("batches")) {
        BatchReport& rays = entry.batches.emplace_back(BatchReport{batch.at("name"), batch.at("rays"), {}});
        for (const Json& timing : batch.at("timings")) rays.timings.push_back(timing_from(timing));
      }
    }
    return report;
  } catch (const Json::exception&) {
    throw Error(ExitCode::bad_input, "{} is not what eyeray-bench --json answers", file.string());
  }
}

}  // namespace eyeray::engine::bench
