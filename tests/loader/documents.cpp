// The schema and the reference in docs/ are those of this program.
#include <fstream>
#include <iterator>

#include "host/cameras/registry.hpp"
#include "host/lights/registry.hpp"
#include "host/loader/scene_file.hpp"
#include "host/loader/sections.hpp"
#include "host/materials/registry.hpp"
#include "host/reading/table.hpp"
#include "host/textures/registry.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;

namespace {

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("docs/scene.schema.json is what `eyeray check --schema` prints") {
  CHECK_MESSAGE(read("docs/scene.schema.json") == scene_schema(),
                "run: eyeray check --schema > docs/scene.schema.json");
}

TEST_CASE("docs/scene-reference.md is what `eyeray check --manual` prints") {
  CHECK_MESSAGE(read("docs/scene-reference.md") == scene_manual(),
                "run: eyeray check --manual > docs/scene-reference.md");
}

TEST_CASE("every default is a valid value of its key") {
  int defaults = 0;
  const auto check = [&](std::span<const reading::Key> keys) {
    for (const reading::Key& key : keys) {
      CAPTURE(key.name);
      CHECK_FALSE(key.doc.empty());
      if (key.fallback.empty()) continue;
      DiagnosticLog log;
      CHECK(read_value(key, fallback_of(key), log, {.textures = textures::types()}).has_value());
      ++defaults;
    }
  };
  for (const Section& section : sections()) {
    check(section.keys);
    if (section.shape) check(section.shape->keys);
  }
  for (const materials::MaterialType* type : materials::types()) check(type->keys);
  for (const lights::LightType* type : lights::types()) check(type->keys);
  for (const cameras::CameraType* type : cameras::types()) check(type->keys);
  CHECK(defaults > 20);
}

TEST_CASE("the examples in the manual are scenes") {
  // Loads each ```toml block of both documents. Materials that a block names but does not contain are made
  // up.
  int examples = 0;
  for (const std::string& document : {scene_manual(), read("docs/scene-file.md")}) {
    for (size_t at = document.find("```toml\n"); at != std::string::npos;
         at = document.find("```toml\n", at)) {
      at += 8;
      std::string text = document.substr(at, document.find("```", at) - at);
      for (const char* name : {"glass", "floor", "wall"}) {
        if (text.find(fmt::format("name = \"{}\"", name)) != std::string::npos) continue;
        text += fmt::format("\n[[material]]\nname = \"{}\"\ntype = \"phong\"\n", name);
      }
      CAPTURE(text);
      CHECK_NOTHROW(parse_scene(text, "example"));
      ++examples;
    }
  }
  CHECK(examples >= 6);
}
