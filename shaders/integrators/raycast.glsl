// Eye rays only: the base colour, shaded by light and normal, without shadows.
#ifndef RAYCAST_GLSL
#define RAYCAST_GLSL
#include "lights/light.glsl"
#include "geometry/surface.glsl"
#include "materials/texture.glsl"
#include "bvh/traverse.glsl"

SHADER_BEGIN

vec3 raycast_radiance(Frame frame, Ray ray, INOUT(uvec4) counts) {
  counts.x += 1u;
#if STORED_HITS
  Hit hit = hit_of_packet(load_packet_hit(), counts);
#else
  Hit hit = trace(ray, counts.z);
#endif
  if (hit.slot == NONE) return vec3(frame.background);
  counts.y += 1u;

  // Find the surface, as the viewer sees it.
  Primitive primitive = primitive_at(hit);
  Surface surface = surface_at(primitive, ray, hit);
  Surface seen = face_viewer(surface, dot3(ray.d, surface.normal_geometric) < 0.0f);

  // Add up the lights; without any, the viewer holds one.
  vec3 light = vec3(frame.ambient);
  for (uint i = 0u; i < LIGHT_COUNT; i++) {
    LightSample s = sample_light(load_light(i), seen.p);
    float cosine = dot3(seen.normal, s.direction);
    light = cosine > 0.0f ? light + s.color * cosine : light;
  }
  float headlight = abs(dot3(seen.normal, ray.d));
  if (LIGHT_COUNT == 0u) light = vec3(headlight, headlight, headlight);
  Material material = load_material(material_of(primitive));
  vec3 base = texture_color(material.textures.x, surface.uv);
#if HAS_EMISSION
  base = base + texture_color(material.head.y >> MATERIAL_EMISSION_SHIFT, surface.uv);
#endif
#if HAS_COLORS
  base = base * vertex_color(primitive, hit);
#endif
  return base * light;
}

SHADER_END
#endif
