#include "host/importers/gltf_instancing.hpp"

#include <optional>

#include "host/importers/gltf_nodes.hpp"

namespace eyeray::engine::importers {

std::vector<Mat4> instance_transforms(const GltfObject& extension, const GltfObject& document,
                                      GltfBuffers& buffers, GltfBreaches& breaches) {
  const auto attributes = extension.object("attributes");
  if (!attributes) extension.fail("has no attributes");
  std::optional<size_t> count;
  const auto read = [&](const char* key, std::string_view rule, auto elements_of) {
    const auto accessor = attributes->index(key, document.size("accessors"));
    decltype(elements_of(size_t{})) elements;
    if (!accessor) return elements;
    breaches.check_attribute(rule, *accessor);
    elements = elements_of(*accessor);
    if (count.value_or(elements.size()) != elements.size())
      attributes->fail("do not all have as many elements");
    count = elements.size();
    return elements;
  };
  const auto vec3 = [&](size_t accessor) { return buffers.vec3(accessor); };
  const auto vec4 = [&](size_t accessor) { return buffers.vec4(accessor); };
  const std::vector<Vec3> translations = read("TRANSLATION", "translation", vec3);
  const std::vector<Vec4> rotations = read("ROTATION", "rotation", vec4);
  const std::vector<Vec3> scales = read("SCALE", "scale", vec3);
  if (!count) attributes->fail("have none of TRANSLATION, ROTATION and SCALE");

  std::vector<Mat4> transforms;
  transforms.reserve(*count);
  for (size_t i = 0; i < *count; ++i) {
    transforms.push_back(gltf_transform(
        *attributes, "ROTATION", translations.empty() ? Vec3(0) : translations[i],
        rotations.empty() ? Vec4(0, 0, 0, 1) : rotations[i], scales.empty() ? Vec3(1) : scales[i], breaches));
  }
  return transforms;
}

}  // namespace eyeray::engine::importers
