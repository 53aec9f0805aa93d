#include "host/executors/scene_facts.hpp"

#include <algorithm>

#include "host/executors/registry_text.hpp"
#include "host/scene/integrator.hpp"
#include "host/scene/texture.hpp"
#include "host/scene/texture_rows.hpp"

namespace eyeray::engine::executors {
namespace {

bool texture_varies(const shader::Texture& texture) {
  return std::ranges::find(texture_rows, texture.kind, &TextureRow::number)->varies;
}

bool bends(const shader::Material& material) {
  return material.normal_map != NONE || material.bump != NONE || material.coat_normal != NONE;
}

bool is_black(const shader::Texture& texture) {
  return !texture_varies(texture) && texture.color == shader::vec3(0);
}

bool any_flag(const records::PackedScene& scene, uint32_t flag) {
  return std::ranges::any_of(scene.materials,
                             [&](const shader::Material& material) { return (material.flags & flag) != 0; });
}

// True if any material may reflect or transmit rays.
bool any_reflects(const records::PackedScene& scene) {
  return transmits(scene) || std::ranges::any_of(scene.materials, [&](const shader::Material& material) {
           return !is_black(scene.textures[material.reflected]);
         });
}

}  // namespace

bool varies(const records::PackedScene& scene, const shader::Material& material) {
  // Materials that bend normals, or have a direction along uv, need at least the gradients of uv.
  return bends(material) || (material.flags & MATERIAL_ANISOTROPIC) != 0 ||
         std::ranges::any_of(rows::material_textures, [&](const rows::MaterialTexture& one) {
           const uint32_t index = material.*one.texture;
           return index != NONE && texture_varies(scene.textures[index]);
         });
}

bool any_emits(const records::PackedScene& scene) {
  return std::ranges::any_of(scene.materials, [&](const shader::Material& material) {
    return !is_black(scene.textures[material.emission]);
  });
}

bool any_emission_texture(const records::PackedScene& scene) {
  return std::ranges::any_of(scene.emitters,
                             [](const shader::Emitter& emitter) { return emitter.texture != NONE; });
}

bool any_smooth(const records::PackedScene& scene) {
  return std::ranges::any_of(scene.primitives, [&](const shader::Primitive& primitive) {
    return kind_of(primitive) == shader::KIND_triangle && primitive.extra != NONE &&
           (scene.vertices[primitive.extra].w & CORNERS_NORMALS) != 0;
  });
}

bool any_emits_in_front(const records::PackedScene& scene) {
  return any_flag(scene, MATERIAL_EMITS_IN_FRONT);
}

bool any_blends(const records::PackedScene& scene) {
  return any_flag(scene, MATERIAL_BLENDS);
}

bool any_front_only(const records::PackedScene& scene) {
  return any_flag(scene, MATERIAL_FRONT_ONLY);
}

bool any_bent_coat(const records::PackedScene& scene) {
  return std::ranges::any_of(scene.materials, [&](const shader::Material& material) {
    return !is_black(scene.textures[material.coat]) && bends(material);
  });
}

bool any_anisotropic(const records::PackedScene& scene) {
  return walks_at_random(scene) && any_flag(scene, MATERIAL_ANISOTROPIC);
}

bool any_rough_diffuse(const records::PackedScene& scene) {
  return std::ranges::any_of(scene.materials, [&](const shader::Material& material) {
    return material.kind == shader::MATERIAL_diffuse && !is_black(scene.textures[material.roughness]);
  });
}

bool any_specular_varies(const records::PackedScene& scene) {
  return std::ranges::any_of(scene.materials, [&](const shader::Material& material) {
    return texture_varies(scene.textures[material.specular_level]) ||
           texture_varies(scene.textures[material.specular_color]);
  });
}

bool any_principled_transmits(const records::PackedScene& scene) {
  return std::ranges::any_of(scene.materials, [&](const shader::Material& material) {
    return !is_black(scene.textures[material.transmission]);
  });
}

bool transmits(const records::PackedScene& scene) {
  return scene.media.size() > 1 || std::ranges::any_of(scene.materials, [](const shader::Material& material) {
           return (material.flags & MATERIAL_PANE) != 0;
         });
}

bool any_scatters(const records::PackedScene& scene) {
  return std::ranges::any_of(
      scene.media, [](const shader::Medium& medium) { return medium.scattering != shader::vec3(0); });
}

bool any_disperses(const records::PackedScene& scene) {
  return std::ranges::any_of(scene.media, [](const shader::Medium& medium) { return medium.spread != 0; });
}

bool any_dims(const records::PackedScene& scene) {
  return any_scatters(scene) || std::ranges::any_of(scene.media, [](const shader::Medium& medium) {
           return medium.absorption != shader::vec3(0);
         });
}

bool any_light_disk(const records::PackedScene& scene) {
  return std::ranges::any_of(scene.lights, [](const shader::Light& light) {
    return light.kind == shader::LIGHT_directional && light.a.w > 0;
  });
}

uint32_t most_bounces(const records::PackedScene& scene) {
  switch (traits_of(IntegratorType(scene.frame.integrator)).ways) {
    case 0:
      return 0;
    case 1:
      // The last vertex is followed only for the light that it sees (integrators/path.glsl).
      return scene.frame.max_depth + 1;
    default:
      return any_reflects(scene) ? scene.frame.max_depth : 0;
  }
}

bool splits(const records::PackedScene& scene) {
  return traits_of(IntegratorType(scene.frame.integrator)).ways > 1 && transmits(scene);
}

uint32_t shadow_rays(const records::PackedScene& scene) {
  switch (traits_of(IntegratorType(scene.frame.integrator)).shadow_rays) {
    case ShadowRays::no_light:
      return 0;
    case ShadowRays::each_light:
      return uint32_t(scene.lights.size());
    case ShadowRays::one_light:
      return scene.emitters.empty() && scene.frame.environment_numbers == 0 ? 0 : 1;
  }
  return 0;
}

bool walks_at_random(const records::PackedScene& scene) {
  return eyeray::engine::walks_at_random(IntegratorType(scene.frame.integrator));
}

}  // namespace eyeray::engine::executors
