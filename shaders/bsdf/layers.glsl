// The layers over other lobes: a coat, and under it sheen. A layer takes from all that is below it as much light as it scatters to the
// viewer, as in KHR_materials_clearcoat and KHR_materials_sheen, whatever the light's direction. So a white surface stays white. f(o, i) is
// not f(i, o) then. A photon (`adjoint`) goes towards the viewer, whose direction is i.
#ifndef LAYERS_GLSL
#define LAYERS_GLSL
#include "bsdf/bsdf_record.glsl"
#include "math/sampling.glsl"

SHADER_BEGIN

#define COAT_F0 0.04f

Fresnel coat_fresnel() { return schlick(vec3(COAT_F0, COAT_F0, COAT_F0), vec3(1.0f, 1.0f, 1.0f)); }

#if HAS_COAT
// A direction in the coat's own frame.
vec3 into_coat(Bsdf bsdf, vec3 v) {
#if HAS_BENT_COAT
  if (bsdf.coat_normal.z != 1.0f) v = into_frame(frame_turned_to(bsdf.coat_normal), v);
#endif
  return v;
}

#endif

// The share of light that each layer leaves.
struct Layers {
  float coat;
  float sheen;
};

Layers layers_towards_viewer(Bsdf bsdf) {
  Layers left;
  left.coat = 1.0f;
  left.sheen = 1.0f;
#if HAS_COAT
  left.coat = 1.0f - mirrored_once(coat_fresnel(), bsdf.coat_albedo).x * bsdf.coat;
#endif
#if HAS_SHEEN
  left.sheen = 1.0f - max_component(bsdf.sheen) * bsdf.sheen_albedo.y;
#endif
  return left;
}

// The layers for choosing lobes. A photon's viewer is not known then.
Layers layers_for_choice(Bsdf bsdf) {
  Layers left = layers_towards_viewer(bsdf);
#if HAS_COAT || HAS_SHEEN
  if (bsdf.adjoint) {
    left.coat = 1.0f;
    left.sheen = 1.0f;
  }
#endif
  return left;
}

// The layers for light from i, or for a photon that leaves by i; behind the surface, layers lie on that side.
Layers layers_between(Bsdf bsdf, vec3 i) {
#if HAS_COAT || HAS_SHEEN
  if (bsdf.adjoint) {
    vec3 w = i.z < 0.0f ? -i : i;
#if HAS_COAT
    bsdf.coat_albedo = ggx_albedo(maximum(into_coat(bsdf, w).z, 0.0f), bsdf.coat_roughness);
#endif
#if HAS_SHEEN
    bsdf.sheen_albedo = sheen_table(w.z, bsdf.sheen_roughness);
#endif
  }
#endif
  return layers_towards_viewer(bsdf);
}

// The share of light left for a lobe with so many layers above it.
float under_layers(Layers left, uint layers) { return (layers > 0u ? left.coat : 1.0f) * (layers > 1u ? left.sheen : 1.0f); }

SHADER_END
#endif
