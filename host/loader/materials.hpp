// The [[material]]s of a scene file, by their names.
#pragma once

#include <map>
#include <span>
#include <string>
#include <tuple>

#include "host/loader/sections.hpp"
#include "host/reading/table.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

// The keys of [[material]] that all kinds have.
std::span<const reading::Key> material_keys();

class Materials {
 public:
  // The materials go into `scene`. The three arguments must outlive this object.
  Materials(Scene& scene, const reading::ValueSources& values, DiagnosticLog& log)
      : scene_(scene), values_(values), log_(log) {}

  // Reads a material. This function and those below report errors to the log.
  void add(const Section& section, const toml::table& table);
  // The index in Scene::materials of a shape's `material`; 0 after an error.
  int find(reading::TableReader& shape);
  // Reports a material that light passes, for a shape whose parts overlap. `index`: that in Scene::materials.
  void check_opaque(reading::TableReader& shape, int index) const;
  // The index in Scene::materials of a material that emits this radiance, in front or on both sides, and
  // reflects nothing.
  int emitter(const Vec3& radiance, bool in_front);
  // Reports unused materials, and too many materials that light passes through. To be called at the end, for
  // a scene that is otherwise complete.
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
