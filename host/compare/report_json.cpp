#include <cmath>
#include <nlohmann/json.hpp>

#include "host/compare/report.hpp"
#include "host/core/escaped_text.hpp"

namespace eyeray::engine::compare {

using Json = nlohmann::ordered_json;

namespace {

Json json(const Pixel& pixel) {
  return Json::array({pixel.x, pixel.y});
}
Json json(const Vec3& v) {
  return Json::array({v.x, v.y, v.z});
}

Json json(const FirstHit& hit) {
  return {{"primitive", hit.primitive},
          {"material", hit.material},
          {"t", hit.t},
          {"normal", json(hit.normal)},
          {"geometric_normal", json(hit.normal_geometric)},
          {"front", hit.cosine > 0},
          {"position", json(hit.position)},
          {"uv", {hit.uv.x, hit.uv.y}}};
}

Json side(const Vec3& color, const Counts& counts, const FirstHit& hit) {
  return {{"color", json(color)}, {"hits", counts.x}, {"rays", counts.y}, {"first_hit", json(hit)}};
}

Json json(const WorstPixel& worst) {
  return {{"pixel", json(worst.pixel)},
          {"excess", worst.excess},
          {"seam", name(worst.seam)},
          {"sample", worst.sample},
          {"parting", worst.parting},
          {"value", side(worst.value, worst.value_counts, worst.value_hit)},
          {"reference", side(worst.reference, worst.reference_counts, worst.reference_hit)}};
}

Json json(const Tally& tally) {
  Json explained = Json::object();
  for (int i = 0; i < cause_count; ++i) explained[name(Cause(i))] = tally.explained[size_t(i)];
  return {{"passed", tally.passes()},
          {"pixels", tally.pixels},
          {"equal", tally.equal},
          {"matching", tally.matching},
          {"explained", explained},
          {"may_be_explained", tally.may_be_explained},
          {"unexplained", tally.unexplained},
          {"unexamined", tally.unexamined},
          {"worst", json(tally.worst)}};
}

Json json(const Participant& p) {
  const Soundness& s = p.soundness;
  return {{"name", p.name},
          {"passed", s.ok()},
          {"description", p.description},
          {"seconds", p.seconds},
          {"rays", p.rays},
          {"nan", s.nan},
          {"infinite", s.infinite},
          {"negative", s.negative},
          {"incomplete_pixels", s.flagged_pixels},
          {"flags", s.flags},
          {"gate_s", p.findings ? Json(*p.findings) : Json()}};
}

Json json(const ExactResult& result) {
  const ExactComparison& c = result.comparison;
  Json object = {{"value", result.value}, {"other", result.other}, {"passed", c.passes(result.ulp)}};
  if (!c.incomparable.empty()) {
    object["incomparable"] = c.incomparable;
    return object;
  }
  object["ulp_allowed"] = result.ulp;
  object["max_ulp"] = c.max_ulp;
  object["pixels"] = c.pixels;
  object["different_pixels"] = c.different_pixels;
  object["different_colors"] = c.different_colors;
  object["different_first_hits"] = c.different_first_hits;
  object["different_ids"] = c.different_ids;
  if (c.worst.seam != Seam::none) object["worst"] = json(c.worst);
  return object;
}

Json json(const ReferenceResult& result) {
  const ReferenceComparison& c = result.comparison;
  Json object = {{"value", result.value}, {"passed", c.passes()}};
  if (!c.incomparable.empty()) {
    object["incomparable"] = c.incomparable;
    return object;
  }
  const Tolerances& t = result.tolerances;
  object["tolerances"] = {
      {"color", t.color}, {"t", t.t}, {"normal", t.normal}, {"uv", t.uv}, {"max_explained", t.max_explained}};
  object["first_hits"] = json(c.first_hits);
  if (c.by_samples()) {
    object["paths"] = json(c.paths);
    const PairedSum& sum = c.paired_sum;
    object["paired_sum"] = {{"passed", sum.excess() <= 1},
                            {"tile", {sum.tile.x, sum.tile.y, sum.tile.width, sum.tile.height}},
                            {"channel", sum.channel},
                            {"share", sum.share},
                            {"allowed", sum.allowed}};
  } else {
    object["colors"] = json(c.colors);
    object["counts"] = json(c.counts);
  }
  if (result.metrics) object["metrics"] = metrics_json(*result.metrics);
  return object;
}

Json json(const DenoisedResult& result) {
  return {{"value", result.value},
          {"other", result.other.empty() ? Json() : Json(result.other)},
          {"passed", result.passes()},
          {"pixels", result.pixels},
          {"different_pixels", result.different},
          {"wrong_pixels", result.wrong},
          {"undecided_pixels", result.undecided},
          {"largest_in_tolerances", result.largest},
          {"worst", {result.worst.x, result.worst.y}}};
}

Json json(const RasterResult& result) {
  Json explained = Json::object(), not_drawn = Json::object();
  for (int i = 0; i < raster_cause_count; ++i) explained[name(RasterCause(i))] = result.explained[size_t(i)];
  for (const auto& [what, count] : result.not_drawn) not_drawn[what] = count;
  Json object = {{"value", result.value},   {"passed", result.passes()},
                 {"device", result.device}, {"triangles", result.triangles},
                 {"not_drawn", not_drawn},  {"pixels", result.pixels},
                 {"equal", result.equal},   {"hidden", result.hidden},
                 {"explained", explained},  {"unexplained", result.unexplained}};
  if (!result.difference.empty())
    object["first"] = {{"pixel", json(result.pixel)},
                       {"difference", result.difference},
                       {"traced", json(result.traced)},
                       {"drawn", {{"primitive", result.drawn}, {"t", result.drawn_t}}}};
  return object;
}

Json json(const GoldenResult& result) {
  Json object = {{"file", result.file},       {"value", result.value},     {"passed", result.passes()},
                 {"changed", result.changed}, {"updated", result.updated}, {"refused", result.refused}};
  if (!result.incomparable.empty()) {
    object["incomparable"] = result.incomparable;
    return object;
  }
  object["colors"] = json(result.colors);
  if (result.metrics) object["metrics"] = metrics_json(*result.metrics);
  return object;
}

Json json(const BufferResult& result) {
  Json object = {{"gate", std::string(1, result.gate)},
                 {"value", result.value},
                 {"other", result.other},
                 {"buffer", result.buffer},
                 {"passed", result.passes()}};
  if (!result.incomparable.empty()) {
    object["incomparable"] = result.incomparable;
    return object;
  }
  object.update({{"numbers", result.numbers},
                 {"different", result.different},
                 {"beyond", result.beyond},
                 {"max_ulp", result.largest},
                 {"ulp_allowed", result.ulp},
                 {"absolute_allowed", result.absolute},
                 {"first", result.first}});
  return object;
}

template <typename Item>
Json list(const std::vector<Item>& items) {
  Json array = Json::array();
  for (const Item& item : items) array.push_back(json(item));
  return array;
}

Json json(const std::map<int32_t, std::string>& words) {
  Json object = Json::object();
  for (const auto& [index, text] : words) object[std::to_string(index)] = text;
  return object;
}

Json json(const Report& report) {
  if (!report.not_verified.empty())
    return {{"scene", report.scene},
            {"verdict", report.verdict()},
            {"passed", report.passes()},
            {"failures", report.failures()},
            {"not_verified", report.not_verified}};
  if (report.is_kernel())
    return {{"scene", report.scene},
            {"verdict", report.verdict()},
            {"seconds", report.seconds},
            {"passed", report.passes()},
            {"failures", report.failures()},
            {"kernel", report.dispatch},
            {"executors", list(report.participants)},
            {"buffers", list(report.buffers)},
            {"kept", report.kept}};
  return {{"scene", report.scene},
          {"verdict", report.verdict()},
          {"seconds", report.seconds},
          {"passed", report.passes()},
          {"changed_shaders", report.changed_shaders},
          {"failures", report.failures()},
          {"diagnosis", report.diagnosis()},
          {"size", {report.width, report.height}},
          {"area", {report.area.x, report.area.y, report.area.width, report.area.height}},
          {"samples", report.samples},
          {"executors", list(report.participants)},
          {"gate_a", list(report.exact)},
          {"gates_b_c", list(report.against_reference)},
          {"denoised", list(report.denoised)},
          {"gate_r", list(report.raster)},
          {"photons", report.photons ? Json{{"sent", report.photons->sent},
                                            {"diverged", report.photons->diverged},
                                            {"may_diverge", report.photons->may_diverge()},
                                            {"displaced", report.photons->displaced},
                                            {"may_be_displaced", report.photons->may_be_displaced()},
                                            {"unexplained", report.photons->unexplained},
                                            {"passed", report.photons->passes()}}
                                     : Json()},
          {"gate_g", report.golden ? json(*report.golden) : Json()},
          {"primitives", json(report.primitives)},
          {"materials", json(report.materials)},
          {"look_closer", report.command_to_look()},
          {"probe", report.command_to_probe()},
          {"kept", report.kept}};
}

}  // namespace

Json metrics_json(const Metrics& m) {
  Json display = Json::object(), histogram = Json::array();
  for (size_t i = 0; i < display_steps.size(); ++i)
    display[std::to_string(display_steps[i])] = m.display_over[i];
  for (size_t i = 0; i < m.decades.size(); ++i)
    histogram.push_back(
        {{"from", i == 0 ? 0 : std::pow(10.0, first_decade + int(i) - 1)}, {"pixels", m.decades[i]}});
  const auto flip = [](const Flip& f) { return Json{{"mean", f.mean}, {"p95", f.p95}, {"p99", f.p99}}; };
  Json metrics{{"rmse", m.rmse},
               {"psnr", m.psnr},
               {"relative_mse", m.relative_mse},
               {"p95", m.p95},
               {"p99", m.p99},
               {"p99.9", m.p999},
               {"max", m.max},
               {"max_at", json(m.max_at)},
               {"max_values", {json(m.max_a), json(m.max_b)}},
               {"display_over", display},
               {"histogram", histogram},
               {"ssim", m.ssim},
               {"flip", flip(m.flip)}};
  if (m.hdr_flip) {
    const Exposures& exposures = m.hdr_flip->exposures;
    metrics["hdr_flip"] = flip(m.hdr_flip->flip);
    metrics["hdr_flip"]["exposures"] = {
        {"start", exposures.start}, {"stop", exposures.stop}, {"count", exposures.count}};
  }
  return metrics;
}

std::string to_json(std::span<const Report> reports) {
  Json scenes = Json::array();
  bool passed = !reports.empty();
  for (const Report& report : reports) {
    passed = passed && report.passes();
    scenes.push_back(json(report));
  }
  return json_text(Json{{"passed", passed}, {"scenes", scenes}}) + "\n";
}

}  // namespace eyeray::engine::compare
