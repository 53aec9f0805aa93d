// There is no surface where a material's alpha is below its cutoff, or on the back of a one-sided surface: the search goes on. A ray hits
// a surface of alpha_mode "blend" with a probability of its alpha (Enderton et al., "Stochastic Transparency", I3D 2010).
#ifndef ALPHA_TEST_GLSL
#define ALPHA_TEST_GLSL
#include "geometry/corners.glsl"
#include "geometry/instance.glsl"
#include "geometry/own_color.glsl"
#include "geometry/ray.glsl"
#include "math/rng.glsl"
#include "textures/texture.glsl"

SHADER_BEGIN

// The least alpha at which the ray hits that primitive.
float least_alpha(Material material, Ray ray, uint id) {
#if HAS_BLEND
  if ((material.flags & MATERIAL_BLENDS) != 0u) return unit_float(pcg_hash(ray.alpha_key + pcg_hash(id))) + EPSILON;
#endif
  return material.alpha_cutoff;
}

// `t` of a hit, or −1 where it is cut out or culled. `id`: the scene's primitive index; `ray`, as the primitive sees it. Only shapes that a ray
// hits once have an alpha: behind a hit that does not count there is nothing more of the shape.
float alpha_test(Primitive primitive, uint id, uint instance, Ray ray, float t, vec2 uv) {
#if HAS_ALPHA_TEST || HAS_FRONT_ONLY
  uint index = material_of(primitive);
#if HAS_INSTANCES
  if (instance != NONE) {
    Instance shown = load_instance(instance);
    if (!of_group(shown)) index = shown.material;
  }
#endif
  Material material = load_material(index);
#endif
#if HAS_FRONT_ONLY
  if ((material.flags & MATERIAL_FRONT_ONLY) != 0u && kind_of(primitive) == KIND_triangle && dot3(corner_normal(primitive), ray.d) >= 0.0f) return -1.0f;
#endif
#if HAS_ALPHA_TEST
  if (material.alpha_cutoff > 0.0f && t > 0.0f) {
    Hit hit;
    hit.t = t;
    hit.slot = 0u;
    hit.id = 0u;
    hit.instance = instance;
    hit.uv = uv;
    vec2 at = uv;
#define UV_AT(name, number) \
    if (kind_of(primitive) == number) at = name##_surface(primitive, ray, hit).uv;
    ALPHA_TESTED_SHAPES(UV_AT)
    float alpha = alpha_at(material, context_of_uv(at));
#if HAS_COLORS
    alpha = alpha * vertex_alpha(primitive, uv);
#endif
    if (alpha < least_alpha(material, ray, id)) return -1.0f;
  }
#endif
  return t;
}

SHADER_END
#endif
