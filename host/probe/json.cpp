// The ray tree as JSON, for programs.
#include <nlohmann/json.hpp>

#include "host/core/escaped_text.hpp"
#include "host/probe/judge.hpp"
#include "host/probe/probe.hpp"

namespace eyeray::engine::probe {
namespace {

using Json = nlohmann::ordered_json;
using executors::backend_name;

const char* name(Verdict verdict) {
  return verdict == Verdict::agrees ? "agrees" : verdict == Verdict::explained ? "explained" : "differs";
}

const char* name(RayKind kind) {
  constexpr const char* names[] = {"pixel", "eye", "reflected", "refracted", "shadow"};
  return names[size_t(kind)];
}

// NaN and infinities are null.
Json number(ProbedValue::Type type, double x) {
  if (type == ProbedValue::Type::boolean) return x != 0;
  return type == ProbedValue::Type::integer ? Json(int64_t(x)) : Json(x);
}

Json to_json(const ProbedValue& value, const Vec3& origin) {
  if (value.size == 1) return number(value.type, value.numbers[0]);
  Json array = Json::array();
  for (int c = 0; c < value.size; ++c)
    array.push_back(number(value.type, value.numbers[size_t(c)] + (c < 3 ? origin[c] : 0)));
  return array;
}

void add_verdict(Json& json, Verdict verdict, const std::string& difference) {
  if (verdict == Verdict::agrees) return;
  json["verdict"] = name(verdict);
  json["difference"] = difference;
}

Json line_json(const Findings& findings, const Line& line) {
  Json json{{"name", line.name}};
  const Vec3 origin = meaning_of(line.name) == Meaning::point ? findings.eye : Vec3(0.0);
  for (size_t e = 0; e < line.values.size(); ++e) {
    const std::optional<ProbedValue>& value = line.values[e];
    if (!value) continue;
    json[std::string(backend_name(findings.participants[e].backend))] = to_json(*value, origin);
    if (!value->file.empty() && !json.contains("file")) {
      json["file"] = value->file;
      json["line"] = value->line;
    }
  }
  add_verdict(json, line.verdict, line.difference);
  return json;
}

}  // namespace

std::string to_json(const Findings& findings) {
  const std::vector<Ray>& rays = findings.overlay.rays();
  Json json{{"scene", findings.scene},     {"pixel", {findings.x, findings.y}}, {"width", findings.width},
            {"height", findings.height},   {"sample", findings.sample},         {"samples", findings.samples},
            {"executors", Json::object()}, {"notes", findings.notes},           {"first_difference", nullptr},
            {"rays", Json::array()}};
  for (const Participant& p : findings.participants)
    json["executors"][std::string(backend_name(p.backend))] = p.description;
  const auto first = findings.first_difference();

  // The order of the overlay decides which line comes before which ray.
  std::vector<size_t> json_indices(rays.size());
  findings.overlay.in_order(
      [&](size_t i) {
        const Ray& ray = rays[i];
        Json each{{"ray", name(ray.kind)}};
        if (ray.kind == RayKind::shadow) each["light"] = ray.number;
        if (ray.kind != RayKind::pixel) each["parent"] = json_indices[ray.parent];
        each["way"] = findings.way_to(i);
        if (!findings.hits[i].empty()) each["hits"] = findings.hits[i];
        Json traced = Json::array();
        for (size_t e = 0; e < ray.traced.size(); ++e)
          if (ray.traced[e]) traced.push_back(backend_name(findings.participants[e].backend));
        each["traced_by"] = traced;
        add_verdict(each, ray.verdict, ray.difference);
        each["values"] = Json::array();
        json_indices[i] = json["rays"].size();
        json["rays"].push_back(std::move(each));
      },
      [&](size_t i, size_t k) {
        json["rays"][json_indices[i]]["values"].push_back(line_json(findings, rays[i].lines[k]));
      });
  if (first) {
    Json difference{{"ray", json_indices[first->ray]}, {"way", findings.way_to(first->ray)}};
    if (first->line) {
      difference.update(line_json(findings, rays[first->ray].lines[*first->line]));
    } else {
      add_verdict(difference, rays[first->ray].verdict, rays[first->ray].difference);
    }
    json["first_difference"] = difference;
  }
  return json_text(json) + "\n";
}

}  // namespace eyeray::engine::probe
