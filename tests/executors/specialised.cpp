// A scene pays for the shapes and textures it has: its kernels hold no code of any other.
#include <cctype>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include "host/loader/scene_file.hpp"
#include "host/pack/pack.hpp"
#include "host/scene/shape.hpp"
#include "host/scene/texture_rows.hpp"
#include "host/shapes/registry.hpp"
#include "tests/support/entries.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::records;

namespace {

// True if the SPIR-V has a function of this name, by the names that glslang leaves in it.
bool has_function(const std::vector<uint32_t>& spirv, const std::string& name) {
  const std::string_view bytes(reinterpret_cast<const char*>(spirv.data()), spirv.size() * sizeof(uint32_t));
  for (size_t at = bytes.find(name + "("); at != bytes.npos; at = bytes.find(name + "(", at + 1))
    if (at > 0 && std::isalnum(uint8_t(bytes[at - 1])) == 0 && bytes[at - 1] != '_') return true;
  return false;
}

}  // namespace

TEST_CASE("a kernel has the shapes and textures of its scene, and no other's") {
  for (const shapes::ShapeType* type : shapes::types()) {
    const std::string file = "scenes/shapes/" + std::string(type->name) + ".toml";
    CAPTURE(file);
    const PackedScene packed = pack::pack(load_scene(file));
    std::set<uint32_t> used, textures;
    for (const shader::Primitive& primitive : packed.primitives) used.insert(kind_of(primitive));
    for (const auto& [kind, material] : packed.leaf_uses) used.insert(kind);
    for (const shader::Texture& texture : packed.textures) textures.insert(texture.kind);
    for (const bool constants : {true, false}) {
      const std::vector<uint32_t> kernel =
          test::compile_entry("kernels/render.comp.glsl", packed, {.constants = constants});
      for (uint32_t kind = 0; kind < shapes::types().size(); ++kind) {
        CAPTURE(shapes::types()[kind]->name);
        const std::string function = std::string(shapes::types()[kind]->name) + "_intersect";
        // Points are spheres, and call the sphere's functions.
        const bool called = kind == shader::KIND_sphere && used.contains(shader::KIND_points);
        CHECK(has_function(kernel, function) == (used.contains(kind) || called));
      }
      for (const TextureRow& row : texture_rows) {
        CAPTURE(row.name);
        CHECK(has_function(kernel, std::string(row.name) + "_color") == textures.contains(row.number));
      }
    }
  }
}

TEST_CASE("another seed needs no other kernel") {
  const auto kernel = [](uint32_t seed) {
    PackedScene packed = pack::pack(load_scene("scenes/path/cornell_box.toml"));
    packed.frame.seed = seed;
    return test::compile_entry("kernels/render.comp.glsl", packed, {.constants = true});
  };
  CHECK(kernel(1) == kernel(2));
}
