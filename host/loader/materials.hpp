// The [[material]]s of a scene file, by their names.
#pragma once

#include <map>
#include <string>
#include <tuple>

#include "host/loader/sections.hpp"
#include "host/reading/table.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

class Materials {
 public:
  // They go into `scene`. All three must outlive it.
  Materials(Scene& scene, const reading::ValueSources& values, DiagnosticLog& log)
      : scene_(scene), values_(values), log_(log) {}

  // Errors are in the log, here and below.
  void add(const Section& section, const toml::table& table);
  // The index in Scene::materials of the table's `material`; after an error 0.
  int find(reading::TableReader& shape);
  // The index in Scene::materials of one that emits this radiance, in front or on both sides, and reflects
  // nothing.
  int emitter(const Vec3& radiance, bool in_front);
  // Reports too many materials that light passes through, and unused ones, in a scene that is otherwise
  // whole.
  void check() const;

 private:
  struct Named {
    int index;  // in Scene::materials; -1 after an error
    SourcePosition position;
    bool used = false;
  };

  Scene& scene_;
  const reading::ValueSources& values_;
  DiagnosticLog& log_;
  std::map<std::string, Named, std::less<>> by_name_;
  std::map<std::tuple<double, double, double, bool>, int> emitters_;  // by radiance and in_front
  size_t media_ = 0;
};

}  // namespace eyeray::engine::loader
