// Who may include whom: a folder under host/ is a layer (docs/architecture.md).
#include <map>
#include <set>

#include "sources.hpp"
#include "support/doctest.hpp"

using namespace eyeray::test;

namespace {

const std::set<std::string> everything = {"accel",     "bench",  "calculus",  "cli",      "compare",
                                          "core",      "dev",    "formula",   "generate", "gpu",
                                          "importers", "loader", "materials", "records",  "reference",
                                          "render",    "rivals", "scene",     "shapes",   "twin"};

// What each layer sees beside itself. That the reference sees neither records nor shaders is the point of
// having one: an error of packing could hide in it.
const std::map<std::string, std::set<std::string>> visible = {
    {"core", {}},
    {"formula", {"core", "calculus", "gpu"}},
    {"scene", {"core", "formula"}},
    {"records", {"core", "formula", "scene", "calculus"}},
    {"shapes", {"core", "formula", "scene", "records"}},
    {"materials", {"core", "scene", "records"}},
    {"importers", {"core", "scene", "materials"}},
    {"loader", {"core", "formula", "scene", "importers"}},
    {"reference", {"core", "scene"}},
    {"twin", {"core", "formula", "records", "calculus"}},
    {"gpu", {"core"}},
    {"calculus", {"core"}},
    {"accel", {"core"}},
    {"render", {"core", "formula", "scene", "records", "reference", "twin", "gpu", "accel", "calculus"}},
    {"compare", {"core"}},
    {"generate", {"core", "scene"}},
    {"rivals", {"core", "scene"}},
    {"bench", {"core", "scene", "rivals", "reference", "loader", "generate"}},
    {"dev", {"core"}},
    {"cli", everything},
};

// Which shader files a layer may include: the records have the ABI, the registries' rows are the host's too,
// and the twin has everything.
const std::map<std::string, std::regex> visible_shaders = {
    {"records", std::regex(R"(records\.h|[a-z]+/registry\.h)")},
    {"shapes", std::regex(R"(shapes/registry\.h)")},
    {"materials", std::regex(R"(materials/registry\.h)")},
    {"twin", std::regex(".*")},
    {"formula", std::regex(R"(language\.h|formula\.glsl)")},
};

// Libraries that a few layers use and the others do not know of.
struct Library {
  std::regex headers;
  std::set<std::string> layers;
  std::set<std::string>
      public_in;  // of them, those whose headers may include it: what sees these sees it too
};
const Library libraries[] = {
    {std::regex(R"((volk|vulkan|glslang|spirv-tools|spirv)([/.].*))"),
     {"gpu", "formula"},
     {"gpu", "formula"}},
    {std::regex(R"(toml\+\+/.*)"), {"scene", "loader"}, {"scene", "loader"}},
    {std::regex(R"(nlohmann/json\.hpp)"), {"bench", "cli", "compare", "importers", "loader"}, {"importers"}},
    {std::regex(R"(tiny_.*)"), {"importers"}, {}},
    {std::regex(R"(CLI/.*)"), {"cli"}, {"cli"}},
    {std::regex(R"(tbb/.*)"), {"core"}, {"core"}},
    {std::regex(R"(embree3/.*)"), {"accel", "rivals"}, {}},
    {std::regex(R"(stb.*)"), {"core"}, {}},
    {std::regex(R"((png|zlib)\.h)"), {"core"}, {}},
};

bool is_shader(const std::string& include) {
  return include.ends_with(".glsl") || include == "language.h" || include == "records.h" ||
         include.ends_with("/registry.h");
}

// Whether the layer `from` may include "include".
bool allowed(const std::string& from, const std::string& include) {
  if (is_shader(include)) {
    const auto shaders = visible_shaders.find(from);
    return shaders != visible_shaders.end() && std::regex_match(include, shaders->second);
  }
  const std::string to = include.substr(0, include.find('/'));
  return to == from || visible.at(from).contains(to);
}

}  // namespace

TEST_CASE("every folder under host/ is a layer, and includes only what it may see") {
  size_t seen = 0;
  for (const SourceFile& file : source_files("host")) {
    CAPTURE(file.path);
    REQUIRE(visible.contains(file.layer()));
    for (const Include& include : includes(file)) {
      if (include.system) continue;
      INFO(file.at(include.line), ": the layer ", file.layer(), " must not include ", include.name);
      CHECK(allowed(file.layer(), include.name));
      CHECK(include.name.find("..") == std::string::npos);
      ++seen;
    }
  }
  CHECK(seen > 300);
}

TEST_CASE("libraries stay in their layers, and out of headers that others see") {
  size_t seen = 0;
  for (const SourceFile& file : source_files("host")) {
    for (const Include& include : includes(file)) {
      if (!include.system) continue;
      for (const Library& library : libraries) {
        if (!std::regex_match(include.name, library.headers)) continue;
        INFO(file.at(include.line), " must not include ", include.name);
        CHECK(library.layers.contains(file.layer()));
        if (file.header()) CHECK(library.public_in.contains(file.layer()));
        ++seen;
      }
    }
  }
  CHECK(seen > 20);
}

TEST_CASE("the layers' headers with TOML or Vulkan in them are private") {
  // A header is tainted by such a library, or by another tainted header.
  const std::vector<SourceFile> files = source_files("host");
  std::map<std::string, std::string> tainted;
  for (const char* library : {R"((volk|vulkan|glslang)[/.].*)", R"(toml\+\+/.*)"}) {
    const std::regex pattern(library);
    for (size_t known = size_t(-1); known != tainted.size();) {
      known = tainted.size();
      for (const SourceFile& file : files) {
        for (const Include& include : includes(file)) {
          if (file.header() && (std::regex_match(include.name, pattern) || tainted.contains(include.name)))
            tainted.emplace(file.path.substr(5), include.name);
        }
      }
    }
  }
  CHECK(tainted.size() > 3);

  for (const SourceFile& file : files) {
    for (const Include& include : includes(file)) {
      if (!tainted.contains(include.name)) continue;
      const std::string owner = include.name.substr(0, include.name.find('/'));
      INFO(file.at(include.line), ": ", include.name, " includes ", tainted[include.name]);
      CHECK((file.layer() == owner || (owner == "scene" && file.layer() == "loader")));
    }
  }
}

TEST_CASE("no file has more than 400 lines") {
  for (const char* folder : {"host", "shaders", "tests"}) {
    for (const SourceFile& file : source_files(folder)) {
      INFO(file.path, " has ", file.lines.size(), " lines");
      CHECK(file.lines.size() <= 400);
    }
  }
}
