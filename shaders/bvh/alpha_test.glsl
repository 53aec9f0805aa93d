// Where a material's alpha is below its cutoff there is no surface: what is hit there was not hit, and the search goes on.
#ifndef ALPHA_TEST_GLSL
#define ALPHA_TEST_GLSL
#include "geometry/instance.glsl"
#include "geometry/ray.glsl"
#include "textures/texture.glsl"

SHADER_BEGIN

// `t` of a hit, or −1 where it is cut out. `ray`, as the primitive sees it. Only shapes that a ray hits once have cutouts: behind one there
// is nothing more of the shape.
float alpha_test(Primitive primitive, uint instance, Ray ray, float t, vec2 uv) {
#if HAS_ALPHA_TEST
  uint index = material_of(primitive);
#if HAS_INSTANCES
  if (instance != NONE) {
    Instance shown = load_instance(instance);
    if (!of_group(shown)) index = shown.material;
  }
#endif
  Material material = load_material(index);
  if (material.alpha_cutoff > 0.0f && t > 0.0f) {
    Hit hit;
    hit.t = t;
    hit.slot = 0u;
    hit.id = 0u;
    hit.instance = instance;
    hit.uv = uv;
    vec2 at = uv;
#define PLACE_ON(name, number) \
    if (kind_of(primitive) == number) at = name##_surface(primitive, ray, hit).uv;
    ALPHA_TESTED_SHAPES(PLACE_ON)
    float alpha = alpha_at(material, place_of_uv(at));
#if HAS_COLORS
    alpha = alpha * vertex_alpha(primitive, uv);
#endif
    if (alpha < material.alpha_cutoff) return -1.0f;
  }
#endif
  return t;
}

SHADER_END
#endif
