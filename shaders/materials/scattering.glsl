// The interface of materials: the light that a point scatters towards the viewer, after Whitted, "An Improved Illumination Model for Shaded
// Display" (CACM 1980).
#ifndef SCATTERING_GLSL
#define SCATTERING_GLSL
#if RANDOM_WALK
#include "bsdf/bsdf_record.glsl"
#endif
#include "math/sampling.glsl"
#include "records.h"
#include "textures/texture.glsl"

SHADER_BEGIN

struct ScatteringContext {
  TextureContext point;
  vec3 color;      // color of a mesh's vertices, white where they have none
  float cos_view;  // in [0, 1]
  float ior_from;
  float ior_to;
#if HAS_BENT_COAT
  vec3 coat_normal;  // in the surface's own frame; (0, 0, 1) where it is the surface's
  float cos_coat;    // as cos_view, of that
#endif
};

// The viewer's cosine, by which lobes look up their albedo.
float viewed_cosine(ScatteringContext context) { return maximum(context.cos_view, LEAST_COSINE); }
float coat_cosine(ScatteringContext context) {
#if HAS_BENT_COAT
  if (context.coat_normal.z != 1.0f) return maximum(context.cos_coat, LEAST_COSINE);
#endif
  return viewed_cosine(context);
}

struct Scattering {
  vec3 ambient;      // × the scene's ambient light
  vec3 diffuse;      // × light · cos θ
  vec3 specular;     // × light · highlight lobe
  vec3 reflected;    // × radiance from the mirror direction
  vec3 transmitted;  // × radiance from the refracted direction
  vec3 emitted;      // radiance that the point emits
};

Scattering no_scattering() {
  Scattering s;
  s.ambient = vec3(0.0f, 0.0f, 0.0f);
  s.diffuse = s.ambient;
  s.specular = s.ambient;
  s.reflected = s.ambient;
  s.transmitted = s.ambient;
  s.emitted = s.ambient;
  return s;
}

#if RANDOM_WALK
// The BSDF of a material in Whitted's terms. Its diffuse albedo is cut to 1, or paths would gain light without end.
Bsdf bsdf_of_scattering(Scattering scattering) {
  Bsdf bsdf = black_bsdf();
  vec3 diffuse = scattering.diffuse;
  bsdf.diffuse = vec3(minimum(diffuse.x, 1.0f), minimum(diffuse.y, 1.0f), minimum(diffuse.z, 1.0f));
  bsdf.mirror = scattering.reflected;
  bsdf.transmitted = scattering.transmitted;
  return bsdf;
}
#endif

// The highlight: Phong's (r·v)^n or Blinn's (n·h)^n. All directions are unit and point away from the surface. The cosine of two unit vectors
// is taken as 1 − |a − b|²/2, which keeps its precision where the lobe is narrow.
float highlight(Material material, vec3 n, vec3 to_light, vec3 to_viewer) {
  vec3 half_way = to_light + to_viewer;
  float length_squared = dot3(half_way, half_way);
  bool blinn = (material.flags & MATERIAL_BLINN) != 0u;
  vec3 a = blinn ? half_way / sqrt(maximum(length_squared, 1.0e-20f)) : mirror3(to_light, n);
  vec3 difference = a - (blinn ? n : to_viewer);
  return power_of_complement(minimum(0.5f * dot3(difference, difference), 1.0f), material.shininess);
}

#if RANDOM_WALK && HAS_PANES
// True if the material's surface is a border between media of one index, which refracts nothing.
bool is_interface(Material material, ScatteringContext context) {
  return material.medium != 0u && context.ior_from == context.ior_to && ANY_INTERFACE;
}
#endif

SHADER_END
#endif
