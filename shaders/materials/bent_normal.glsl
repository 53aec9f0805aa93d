// Shading normals that a material bends: by a normal map, in tangent space as glTF has them, and by a height field's slope (Blinn,
// "Simulation of Wrinkled Surfaces", SIGGRAPH 1978). docs/path-tracing.md has the formulas.
#ifndef BENT_NORMAL_GLSL
#define BENT_NORMAL_GLSL
#include "geometry/ray.glsl"
#include "math/sampling.glsl"
#include "textures/texture.glsl"

SHADER_BEGIN

#define LEAST_UPRIGHT 0.01f    // how far a bent normal points out of the surface at least …
#define LEAST_MIRRORED 0.001f  // … and the mirrored view, unless the viewer stands lower

vec3 unit_or(vec3 v, vec3 otherwise) {
  float squared = dot3(v, v);
  return squared > 1.0e-30f && squared < 1.0e30f ? v / sqrt(squared) : otherwise;
}

// The surface, its uv growing as those do that the texture reads.
Surface as_read_by(uint texture, Surface surface) {
  Surface read = surface;
#if HAS_SECOND_UV
  if (reads_second_uv(load_texture(texture))) {
    read.u_gradient = surface.second_u_gradient;
    read.v_gradient = surface.second_v_gradient;
    read.tangent = surface.second_tangent;
  }
#endif
  return read;
}

// The frame of tangent space: s is along u, t along v. `n`: the surface's normal, on either side of it. s is 0 where uv do not grow.
LocalFrame uv_frame(Surface surface, vec3 n) {
  float left = dot3(surface.normal_geometric, cross3(surface.u_gradient, surface.v_gradient)) < 0.0f ? -1.0f : 1.0f;
  vec3 along_u = cross3(surface.v_gradient, surface.normal_geometric) * left;
  bool own = surface.tangent.w != 0.0f;
  left = own ? surface.tangent.w : left;
  along_u = own ? vec3(surface.tangent) : along_u;
  LocalFrame frame;
  frame.s = unit_or(along_u - n * dot3(n, along_u), vec3(0.0f, 0.0f, 0.0f));
  frame.t = cross3(n, frame.s) * left;
  frame.n = n;
  return frame;
}

// `code`: the map's colour.
vec3 mapped_normal(Surface surface, vec3 n, vec3 code, float scale) {
  LocalFrame frame = uv_frame(surface, n);
  float x = (2.0f * code.x - 1.0f) * scale;
  float y = (2.0f * code.y - 1.0f) * scale;
  return unit_or(frame.s * x + frame.t * y + n * (2.0f * code.z - 1.0f), n);
}

#if HAS_ANISOTROPY
// The direction along which microfacets of the normal n are wider: u's, or the map's, turned.
vec3 rough_axis_of(Material material, Surface surface, vec3 n, TextureContext point) {
  vec2 turn = material.anisotropy_turn;
  LocalFrame frame = uv_frame(surface, n);
  float x = 1.0f;
  float y = 0.0f;
  if (material.anisotropy_direction != NONE) {
    vec3 code = anisotropy_direction_of(material, point);
    frame = uv_frame(as_read_by(material.anisotropy_direction, surface), n);
    x = 2.0f * code.x - 1.0f;
    y = 2.0f * code.y - 1.0f;
  }
  return unit_or(frame.s * (x * turn.x - y * turn.y) + frame.t * (x * turn.y + y * turn.x), vec3(0.0f, 0.0f, 0.0f));
}
#endif

// The height that a bump map's colour stands for.
float height_of(vec3 color) { return 0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z; }

// Heights are compared on both sides, `bump_width` away: in space along two directions perpendicular to n, or in uv.
vec3 bumped_normal(Material material, Surface surface, vec3 n, TextureContext point) {
  bool in_space = (material.flags & MATERIAL_BUMP_IN_SPACE) != 0u;
  vec3 s;
  vec3 t;
  tangents(n, s, t);
  vec3 slope = vec3(0.0f, 0.0f, 0.0f);
  for (uint i = 0u; i < 4u; i++) {
    bool first = i < 2u;
    float side = (i & 1u) == 0u ? 1.0f : -1.0f;
    float way = side * material.bump_width;
    TextureContext beside = point;
    beside.uv = vec2(point.uv.x + (in_space || !first ? 0.0f : way), point.uv.y + (in_space || first ? 0.0f : way));
    beside.p = point.p + (first ? s : t) * (in_space ? way : 0.0f);
    vec3 direction = in_space ? (first ? s : t) : first ? surface.u_gradient : surface.v_gradient;
    slope = slope + direction * (side * height_of(bump_of(material, beside)));
  }
  slope = slope * (material.bump_height / (2.0f * material.bump_width));
  return unit_or(n - (slope - n * dot3(n, slope)), n);
}

// A normal on the viewer's side, bent so far that the viewer's mirror direction is above the surface too. Keller et al., "The Iray Light
// Transport Simulation and Rendering System" (2017), appendix. `d`: towards the surface, unit.
vec3 above_surface(vec3 n, vec3 normal_geometric, vec3 d) {
  float upright = dot3(n, normal_geometric);
  vec3 lifted = upright < LEAST_UPRIGHT ? normalize3(n + normal_geometric * (LEAST_UPRIGHT - upright)) : n;
  float height = minimum(LEAST_MIRRORED, -0.5f * dot3(d, normal_geometric));
  vec3 mirrored = d - lifted * (2.0f * dot3(d, lifted));
  float above = dot3(mirrored, normal_geometric);
  float lift = (height - above) / dot3(lifted, normal_geometric);
  return above < height ? unit_or(unit_or(mirrored + lifted * lift, normal_geometric) - d, normal_geometric) : lifted;
}

// The surface as the material has it where it is hit in the unit direction d.
Surface bent_by(Material material, Surface surface, vec3 d) {
  TextureContext point = context_on(surface);
  vec3 n = surface.normal;
  if (material.normal_map != NONE)
    n = mapped_normal(as_read_by(material.normal_map, surface), n, normal_map_of(material, point), material.normal_scale);
  if (material.bump != NONE) n = bumped_normal(material, surface, n, point);
  float side = dot3(d, surface.normal_geometric) < 0.0f ? 1.0f : -1.0f;
  vec3 up = surface.normal_geometric * side;
  Surface bent = surface;
  if (material.normal_map != NONE || material.bump != NONE) bent.normal = above_surface(n * side, up, d) * side;
#if HAS_ANISOTROPY
  bent.rough_axis = vec3(0.0f, 0.0f, 0.0f);
  if ((material.flags & MATERIAL_ANISOTROPIC) != 0u) bent.rough_axis = rough_axis_of(material, surface, bent.normal, point);
#endif
#if HAS_BENT_COAT
  bent.coat_normal = surface.normal;
  if (material.coat_normal != NONE) {
    vec3 coat = mapped_normal(as_read_by(material.coat_normal, surface), surface.normal, coat_normal_of(material, point),
                              material.coat_normal_scale);
    bent.coat_normal = above_surface(coat * side, up, d) * side;
  }
#endif
  return bent;
}

Surface bent_surface(uint index, Surface surface, vec3 d) {
  Surface bent = surface;
#ifdef SCENE_MATERIALS
#define BENT_BY_ONE(name, i, constants) \
  if (index == i) bent = bent_by(constants, surface, d);
  SCENE_MATERIALS(BENT_BY_ONE)
#else
  bent = bent_by(load_material(index), surface, d);
#endif
  return bent;
}

SHADER_END
#endif
