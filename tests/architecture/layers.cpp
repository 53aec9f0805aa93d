// Checks which layers may include which: a folder under host/ is a layer (docs/architecture.md).
#include <filesystem>
#include <map>
#include <set>

#include "layering.hpp"
#include "sources.hpp"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine::test;

namespace {

const std::map<std::string, Links> all_layers = read_layers();

// The shader files that a layer may include. `records` includes the ABI, layers with a registry include its
// rows, and the twin includes everything.
const std::map<std::string, std::regex> visible_shaders = {
    {"records", std::regex(R"(shaders/(records\.h|[a-z]+/rows\.h))")},
    {"shapes", std::regex(R"(shaders/shapes/rows\.h)")},
    {"scene", std::regex(R"(shaders/(integrators|samplers|textures)/rows\.h)")},
    {"textures", std::regex(R"(shaders/textures/rows\.h)")},
    {"materials", std::regex(R"(shaders/materials/rows\.h)")},
    {"lights", std::regex(R"(shaders/lights/rows\.h)")},
    {"cameras", std::regex(R"(shaders/cameras/rows\.h)")},
    {"twin", std::regex(".*")},
    {"denoise", std::regex(R"(shaders/(records\.h|denoise/\w+\.glsl))")},
    {"denoise_kernels", std::regex(R"(shaders/denoise/step\.h)")},
    {"formula", std::regex(R"(shaders/(language\.h|math/formula\.glsl))")},
};

// Libraries that a few layers use and the others do not know of.
struct Library {
  std::regex headers;
  std::set<std::string> layers;
  std::set<std::string>
      public_in;  // the layers whose headers may include it: layers that include those headers see it too
};
const Library libraries[] = {
    {std::regex(R"((volk|vulkan|glslang|spirv-tools|spirv)([/.].*))"),
     {"spirv", "emulator", "gpu", "formula", "compute"},
     {"spirv", "emulator", "gpu", "formula"}},
    {std::regex(R"(toml\+\+/.*)"), {"reading", "loader", "compute"}, {"reading", "loader", "compute"}},
    {std::regex(R"(nlohmann/json\.hpp)"),
     {"shards", "film", "bench", "bench_cli", "cli", "compare", "dev", "importers", "loader", "program",
      "verify", "probe"},
     {"importers", "dev"}},
    {std::regex(R"(microhttpd\.h)"), {"dev"}, {}},
    {std::regex(R"(tiny_.*)"), {"importers"}, {}},
    {std::regex(R"(CLI/.*)"), {"bench_cli", "cli", "program"}, {"program"}},
    {std::regex(R"(tbb/.*)"), {"core"}, {"core"}},
    {std::regex(R"(embree[34]/.*)"), {"bvh", "contenders"}, {"bvh"}},
    {std::regex(R"(stb.*)"), {"image"}, {}},
    {std::regex(R"((png|zlib)\.h)"), {"core", "image"}, {}},
    {std::regex(R"(ft2build\.h|freetype/.*)"), {"shapes"}, {}},
};

bool is_shader(const std::string& include) {
  return include.starts_with("shaders/") || include.ends_with("/all.glsl") ||
         std::filesystem::exists("shaders/" + include);
}

// The layer of "host/scene/mesh.hpp": "scene".
std::string layer_of(const std::string& include) {
  const std::string in_host = include.substr(include.find('/') + 1);
  return in_host.substr(0, in_host.find('/'));
}

// True if the layer `from` may include "include".
bool allowed(const std::string& from, const std::string& include) {
  if (is_shader(include)) {
    const auto shaders = visible_shaders.find(from);
    return shaders != visible_shaders.end() && std::regex_match(include, shaders->second);
  }
  const std::string to = layer_of(include);
  return to == from || all_layers.at(from).contains(to);
}

}  // namespace

TEST_CASE("every folder under host/ is a layer, and includes only what it may see") {
  size_t seen = 0;
  for (const SourceFile& file : layer_files()) {
    CAPTURE(file.path);
    REQUIRE(all_layers.contains(file.layer()));
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

TEST_CASE("only permitted layers include a library, and only permitted ones in a header") {
  size_t seen = 0;
  for (const SourceFile& file : layer_files()) {
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
  // A header is tainted if it includes such a library or another tainted header.
  const std::vector<SourceFile> files = layer_files();
  std::map<std::string, std::string> tainted;
  for (const char* library : {R"((volk|vulkan|glslang)[/.].*)", R"(toml\+\+/.*)"}) {
    const std::regex pattern(library);
    for (size_t known = size_t(-1); known != tainted.size();) {
      known = tainted.size();
      for (const SourceFile& file : files) {
        for (const Include& include : includes(file)) {
          if (file.header() && (std::regex_match(include.name, pattern) || tainted.contains(include.name)))
            tainted.emplace(file.path, include.name);
        }
      }
    }
  }
  CHECK(tainted.size() > 3);

  for (const SourceFile& file : files) {
    for (const Include& include : includes(file)) {
      if (!tainted.contains(include.name)) continue;
      const std::string owner = layer_of(include.name);
      INFO(file.at(include.line), ": ", include.name, " includes ", tainted[include.name]);
      const bool reads_files = file.layer() == "loader" || file.layer() == "compute";
      CHECK((file.layer() == owner || (owner == "reading" && reads_files)));
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
