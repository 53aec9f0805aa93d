#include "host/program/json.hpp"

#include <nlohmann/json.hpp>

#include "host/core/escaped_text.hpp"
#include "host/core/termination.hpp"

namespace eyeray::engine::program {

Json to_json(const Diagnostic& diagnostic) {
  Json json{{"severity", diagnostic.severity == Severity::error ? "error" : "warning"},
            {"file", diagnostic.position.file}};
  if (diagnostic.position.line > 0) json["line"] = diagnostic.position.line;
  if (diagnostic.position.column > 0) json["column"] = diagnostic.position.column;
  json["message"] = diagnostic.message;
  return json;
}

Json to_json(const Error& error) {
  Json json{{"code", exit_status(error.code())}, {"message", error.what()}};
  if (const auto* input = dynamic_cast<const InputError*>(&error)) {
    json["diagnostics"] = Json::array();
    for (const Diagnostic& diagnostic : input->diagnostics())
      json["diagnostics"].push_back(to_json(diagnostic));
  }
  return json;
}

Json to_json(const StageTimes& times) {
  Json json = Json::object();
  for (const auto& [stage, seconds] : times.stages()) json[stage] = seconds;
  return json;
}

void print_json(const Json& json) {
  fmt::print("{}\n", json_text(json));
}

}  // namespace eyeray::engine::program
