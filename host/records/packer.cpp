#include "records/packer.hpp"

#include <cstring>

#include "core/error.hpp"

namespace eyeray {

uint32_t Packer::add_vertices(std::initializer_list<shader::uvec4> data) {
  const auto first = uint32_t(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), data);
  return first;
}

uint32_t Packer::add_medium(double ior, const Vec3& absorption) {
  CHECK_LT(scene.media.size(), size_t{256});
  scene.media.push_back({to_vec4(absorption, ior)});
  return uint32_t(scene.media.size() - 1);
}

uint32_t Packer::add_texture(const Texture& texture) {
  shader::Texture record{};
  if (texture.checker) {
    record.even = to_vec4(texture.checker->even, double(TEXTURE_CHECKER));
    record.odd = to_vec4(texture.checker->odd);
    record.frequency = to_vec4(Vec3(1.0 / texture.checker->size.x, 1.0 / texture.checker->size.y, 0));
  } else {
    record.even = to_vec4(texture.value, double(TEXTURE_CONSTANT));
  }
  for (size_t i = 0; i < scene.textures.size(); ++i)
    if (std::memcmp(&scene.textures[i], &record, sizeof record) == 0) return uint32_t(i);
  scene.textures.push_back(record);
  return uint32_t(scene.textures.size() - 1);
}

}  // namespace eyeray
