// Compares the table of glTF's extensions in docs/mesh-files.md with the importer.
#include <fstream>
#include <map>
#include <regex>

#include "gltf_files.hpp"
#include "host/importers/gltf_properties.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::importers;
using namespace eyeray::engine::test;

namespace {

// The treatment of each extension, by the manual.
std::map<std::string, std::string> extensions_of_manual() {
  const std::regex row(R"(\| `([A-Z]+_\w+)` \| ([a-z ]+) \|.*)");
  std::map<std::string, std::string> all;
  std::ifstream manual("docs/mesh-files.md");
  std::smatch found;
  for (std::string line; std::getline(manual, line);)
    if (std::regex_match(line, found, row)) CHECK(all.emplace(found[1], found[2]).second);
  return all;
}

}  // namespace

TEST_CASE("the manual's table of extensions is what the importer does") {
  const std::map<std::string, std::string> manual = extensions_of_manual();
  CHECK(manual.size() > 40);
  for (const auto& row : manual) {
    const std::string &name = row.first, &treatment = row.second;
    CAPTURE(name);
    CAPTURE(treatment);
    GltfFile file;
    file.add_positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    file.json["extensionsUsed"] = {name};
    const ImportedScene scene = import_sound(file.gltf(), "a.gltf");
    const bool known = treatment == "read" || treatment == "read in part" || treatment == "nothing to show";
    CHECK((known || treatment == "left out"));
    CHECK(is_known_extension(name) == known);
    CHECK(warns(scene, "the extension " + name + " (1)") == !known);
    CHECK(scene.warnings.empty() == known);
  }
}

TEST_CASE("every extension that the importer names is in the manual's table") {
  const std::map<std::string, std::string> manual = extensions_of_manual();
  const std::regex quoted("\"((KHR|EXT|MSFT|ADOBE|FB|CESIUM)_[A-Za-z_]+)\"");
  size_t names = 0;
  for (const auto& entry : std::filesystem::directory_iterator("host/importers")) {
    std::ifstream source(entry.path());
    const std::string text{std::istreambuf_iterator<char>(source), {}};
    for (std::sregex_iterator at(text.begin(), text.end(), quoted), end; at != end; ++at, ++names) {
      const std::string name = (*at)[1];
      CAPTURE(entry.path().string());
      CAPTURE(name);
      CHECK(manual.contains(name));
    }
  }
  CHECK(names > 40);
}
