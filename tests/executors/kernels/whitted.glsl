// Made for this scene by executors/specialise.cpp.
#define LIGHT_COUNT 1u
#define EMITTER_COUNT 0u
#define HAS_ENVIRONMENT 0
#define HAS_LIGHT_DISKS 0
#define HAS_LIGHT_BVH 0
#define HAS_ENVIRONMENT_LIGHT false
#define IS_TRANSPARENT false
#define TRIANGLE_METHOD 0u
#define HAS_COLORS 0
#define HAS_PIECES 0
#define HAS_ROUND_CONES 0
#define HAS_LATHES 0
#define HAS_SECOND_UV 0
#define HAS_SMOOTH 0
#define HAS_EMISSION 0
#define HAS_EMISSION_TEXTURES 0
#define HAS_ONE_SIDED_EMISSION 0
#define HAS_PHOTONS 0
#define HAS_GLOSSY 0
#define HAS_CONDUCTORS 0
#define HAS_ROUGH_DIFFUSE 0
#define HAS_SPECULAR_TEXTURES 0
#define HAS_COAT 0
#define HAS_BENT_COAT 0
#define HAS_ROUGH_GLASS 0
#define HAS_BENT_NORMALS 0
#define HAS_ALPHA_TEST 0
#define HAS_BLEND 0
#define HAS_FRONT_ONLY 0
#define HAS_SHEEN 0
#define HAS_THIN 0
#define HAS_TRANSLUCENT 0
#define HAS_ANISOTROPY 0
#define HAS_FILM 0
#define HAS_TRANSMISSION 0
#define HAS_PANES 0
#define ANY_PANE false
#define ANY_INTERFACE false
#define HAS_MEDIA 1
#define HAS_DISPERSION 0
#define HAS_ABSORPTION 0
#define HAS_SCATTERING 0
#define HAS_MEDIUM_EXTENT 0
#define PATH_STACK 8
#define RANDOM_WALK 0
#define TRACE_ITERATIONS 0u
#define TEXEL_BUFFERS 0
#define HAS_BVH false
#define QUANTISED_NODES false
#define HAS_LENS 0
#define HAS_FILTER 0
#define HAS_SECONDARY 1
#define CAMERA_IS(number) true
#define SAMPLER_IS(number) true
#define INTEGRATOR_IS(number) true
#define RAY_KINDS 0
#define SUBGROUP_SIZE 8
#define PACKET_ROOT 0u
#define PACKET_STACK 1
#define MAY_REACH_ITERATION_LIMIT 0
#define SHIFT_STACK 0
#define STACK_SIZE 1
#define HAS_CSG 0
#define HAS_DEFERRED_LEAVES 0
#define HAS_MIXED_CSG 0
#define HAS_INSTANCES 0
#define INSTANCE_COUNT 0u
#define BVH_HOLDS(number, primitive) (kind_of(primitive) == number)
#define BVH_OF_TRIANGLES 0
#define GROUP_STRIDE 1u
#define KIND_sphere 0u
#define FIRST_sphere 0u
#define END_sphere 3u
#define UV_sphere false
#define KIND_plane 1u
#define FIRST_plane 3u
#define END_plane 3u
#define UV_plane false
#define KIND_triangle 2u
#define FIRST_triangle 3u
#define END_triangle 5u
#define UV_triangle true
#define KIND_box 3u
#define FIRST_box 5u
#define END_box 5u
#define UV_box false
#define KIND_ellipsoid 4u
#define FIRST_ellipsoid 5u
#define END_ellipsoid 5u
#define UV_ellipsoid false
#define KIND_cylinder 5u
#define FIRST_cylinder 5u
#define END_cylinder 5u
#define UV_cylinder false
#define KIND_cone 6u
#define FIRST_cone 5u
#define END_cone 5u
#define UV_cone false
#define KIND_polygon 7u
#define FIRST_polygon 5u
#define END_polygon 5u
#define UV_polygon false
#define KIND_parallelogram 8u
#define FIRST_parallelogram 5u
#define END_parallelogram 5u
#define UV_parallelogram false
#define KIND_prism 9u
#define FIRST_prism 5u
#define END_prism 5u
#define UV_prism false
#define KIND_disk 10u
#define FIRST_disk 5u
#define END_disk 5u
#define UV_disk false
#define KIND_paraboloid 11u
#define FIRST_paraboloid 5u
#define END_paraboloid 5u
#define UV_paraboloid false
#define KIND_hyperboloid 12u
#define FIRST_hyperboloid 5u
#define END_hyperboloid 5u
#define UV_hyperboloid false
#define KIND_capsule 13u
#define FIRST_capsule 5u
#define END_capsule 5u
#define UV_capsule false
#define KIND_quadric 14u
#define FIRST_quadric 5u
#define END_quadric 5u
#define UV_quadric false
#define KIND_torus 15u
#define FIRST_torus 5u
#define END_torus 5u
#define UV_torus false
#define KIND_superellipsoid 16u
#define FIRST_superellipsoid 5u
#define END_superellipsoid 5u
#define UV_superellipsoid false
#define KIND_bilinear 17u
#define FIRST_bilinear 5u
#define END_bilinear 5u
#define UV_bilinear false
#define KIND_implicit 18u
#define FIRST_implicit 5u
#define END_implicit 5u
#define UV_implicit false
#define KIND_csg 19u
#define FIRST_csg 5u
#define END_csg 5u
#define UV_csg false
#define KIND_bezier 20u
#define FIRST_bezier 5u
#define END_bezier 5u
#define UV_bezier false
#define KIND_points 21u
#define FIRST_points 5u
#define END_points 5u
#define UV_points false
#define KIND_FIRST(name) FIRST_##name
#define KIND_END(name) END_##name
#if defined FIRST_HITS || defined PROBING
#define UV_OF(name) true
#else
#define UV_OF(name) UV_##name
#endif
#ifdef FIRST_HITS
#define SEARCH_COST 0
#else
#define SEARCH_COST 0
#endif
#define HAS_DEFERRED_SHAPES 0
#include "kernels/features.h"
#include "kernels/bindings.glsl"
Material load_material(uint i) {
  Material r = Material(0u, 0u, 0u, 268435456u, 1u, 0u, 0u, 1u, 0u, 0u, 0.000000000e+00, 3.200000000e+01, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 1u, 0u, 0u, 0u, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 0u, 0u, 0u, 0u, 0u, 0u, 4294967295u, 0.000000000e+00, 4294967295u, 0.000000000e+00, 0.000000000e+00, 4294967295u, 0.000000000e+00, 0u, 0u, 0u, 4294967295u, vec2(1.000000000e+00, 0.000000000e+00), 0u, 0u, 0.000000000e+00, 0.000000000e+00, 1.000000000e+00, 0u);
  if (i == 1u) r = Material(0u, 0u, 0u, 268435456u, 3u, 2u, 4u, 3u, 0u, 0u, 0.000000000e+00, 6.400000000e+01, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 3u, 0u, 0u, 0u, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 0u, 0u, 0u, 0u, 0u, 0u, 4294967295u, 0.000000000e+00, 4294967295u, 0.000000000e+00, 0.000000000e+00, 4294967295u, 0.000000000e+00, 0u, 0u, 0u, 4294967295u, vec2(1.000000000e+00, 0.000000000e+00), 0u, 0u, 0.000000000e+00, 0.000000000e+00, 1.000000000e+00, 0u);
  if (i == 2u) r = Material(2u, 0u, 1u, 772764u, 0u, 5u, 6u, 0u, 0u, 0u, 0.000000000e+00, 2.000000000e+02, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 6u, 0u, 0u, 0u, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 0u, 0u, 0u, 0u, 0u, 0u, 4294967295u, 0.000000000e+00, 4294967295u, 0.000000000e+00, 0.000000000e+00, 4294967295u, 0.000000000e+00, 0u, 0u, 0u, 4294967295u, vec2(1.000000000e+00, 0.000000000e+00), 0u, 0u, 0.000000000e+00, 0.000000000e+00, 1.000000000e+00, 0u);
  if (i == 3u) r = Material(2u, 0u, 2u, 0u, 0u, 0u, 6u, 0u, 0u, 0u, 0.000000000e+00, 3.200000000e+01, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 6u, 0u, 0u, 0u, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 0u, 0u, 0u, 0u, 0u, 0u, 4294967295u, 0.000000000e+00, 4294967295u, 0.000000000e+00, 0.000000000e+00, 4294967295u, 0.000000000e+00, 0u, 0u, 0u, 4294967295u, vec2(1.000000000e+00, 0.000000000e+00), 0u, 0u, 0.000000000e+00, 0.000000000e+00, 1.000000000e+00, 0u);
  return r;
}
Texture load_texture(uint i) {
  Texture r = Texture(vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 0u, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), uvec4(0u, 0u, 0u, 0u));
  if (i == 1u) r = Texture(vec3(8.000000119e-01, 3.000000119e-01, 1.500000060e-01), 1u, vec4(8.999999762e-01, 8.500000238e-01, 5.000000075e-02, 0.000000000e+00), vec4(1.000000000e+00, 1.000000000e+00, 0.000000000e+00, 0.000000000e+00), uvec4(0u, 0u, 0u, 0u));
  if (i == 2u) r = Texture(vec3(8.000000119e-01, 8.000000119e-01, 8.000000119e-01), 0u, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), uvec4(0u, 0u, 0u, 0u));
  if (i == 3u) r = Texture(vec3(7.000000030e-02, 2.000000030e-01, 2.399999946e-01), 0u, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), uvec4(0u, 0u, 0u, 0u));
  if (i == 4u) r = Texture(vec3(6.000000238e-01, 6.800000072e-01, 6.999999881e-01), 0u, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), uvec4(0u, 0u, 0u, 0u));
  if (i == 5u) r = Texture(vec3(8.999999762e-01, 8.999999762e-01, 8.999999762e-01), 0u, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), uvec4(0u, 0u, 0u, 0u));
  if (i == 6u) r = Texture(vec3(1.000000000e+00, 1.000000000e+00, 1.000000000e+00), 0u, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), uvec4(0u, 0u, 0u, 0u));
  return r;
}
Medium load_medium(uint i) {
  Medium r = Medium(vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 1.000000000e+00, vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00);
  if (i == 1u) r = Medium(vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 1.399999976e+00, vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00);
  if (i == 2u) r = Medium(vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 1.000000000e+00, vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00);
  return r;
}
Light load_light(uint i) {
  Light r = Light(vec3(1.000000000e+00, 1.000000000e+00, 1.000000000e+00), 0u, vec4(5.200000000e+01, 3.800000000e+01, 4.000000000e+00, 0.000000000e+00), vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00));
  return r;
}
Emitter load_emitter(uint i) {
  Emitter r = Emitter(vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 0u, vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec4(0.000000000e+00, 0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 0u, 0u, 0.000000000e+00, 0.000000000e+00, 0u, 0u, 0u, 0.000000000e+00);
  return r;
}
#define SHADING_AS_CONSTANTS
#define SCENE_MATERIALS(X) X(phong, 0u, load_material(0u)) X(phong, 1u, load_material(1u)) X(dielectric, 2u, load_material(2u)) X(dielectric, 3u, load_material(3u))
uvec4 load_vertex(uint i) {
  uvec4 r = uvec4(2147483648u, 1065353216u, 0u, 0u);
  if (i == 1u) r = uvec4(2147483648u, 1065353216u, 0u, 1107296256u);
  if (i == 2u) r = uvec4(2147483648u, 1065353216u, 0u, 1107296256u);
  if (i == 3u) r = uvec4(0u, 1u, 2u, 2u);
  if (i == 4u) r = uvec4(0u, 0u, 1098907648u, 0u);
  if (i == 5u) r = uvec4(0u, 1065353216u, 0u, 0u);
  if (i == 6u) r = uvec4(0u, 1065353216u, 0u, 1107296256u);
  if (i == 7u) r = uvec4(0u, 1065353216u, 0u, 0u);
  if (i == 8u) r = uvec4(5u, 6u, 7u, 2u);
  if (i == 9u) r = uvec4(0u, 1098907648u, 1098907648u, 0u);
  return r;
}
Primitive load_primitive(uint i) {
  Primitive r = Primitive(0u, 1u, 268435456u, 4294967295u, vec4(-6.000000000e+00, -5.000000000e-01, 1.500000000e+00, 1.000000000e+00), vec4(0.000000000e+00, 1.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec4(1.000000000e+00, 0.000000000e+00, 0.000000000e+00, 1.000000000e+00));
  if (i == 1u) r = Primitive(1u, 2u, 772764u, 4294967295u, vec4(-4.000000000e+00, 3.000000119e-01, 0.000000000e+00, 1.000000000e+00), vec4(0.000000000e+00, 1.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec4(1.000000000e+00, 0.000000000e+00, 0.000000000e+00, 1.000000000e+00));
  if (i == 2u) r = Primitive(2u, 3u, 0u, 4294967295u, vec4(-4.000000000e+00, 3.000000119e-01, 0.000000000e+00, 9.599999785e-01), vec4(0.000000000e+00, 1.000000000e+00, 0.000000000e+00, 0.000000000e+00), vec4(1.000000000e+00, 0.000000000e+00, 0.000000000e+00, 1.000000000e+00));
  if (i == 3u) r = Primitive(3u, 33554432u, 268435456u, 3u, vec4(-2.400000000e+01, -2.000000000e+00, 1.200000000e+01, 0.000000000e+00), vec4(8.000000000e+00, -2.000000000e+00, 1.200000000e+01, 1.000000000e+00), vec4(8.000000000e+00, -2.000000000e+00, -4.000000000e+00, 0.000000000e+00));
  if (i == 4u) r = Primitive(4u, 33554432u, 268435456u, 8u, vec4(-2.400000000e+01, -2.000000000e+00, 1.200000000e+01, 0.000000000e+00), vec4(8.000000000e+00, -2.000000000e+00, -4.000000000e+00, 1.000000000e+00), vec4(-2.400000000e+01, -2.000000000e+00, -4.000000000e+00, 0.000000000e+00));
  return r;
}
#define SCENE_PRIMITIVES(X) X(sphere, 0u, load_primitive(0u)) X(sphere, 1u, load_primitive(1u)) X(sphere, 2u, load_primitive(2u)) X(triangle, 3u, load_primitive(3u)) X(triangle, 4u, load_primitive(4u))
Frame load_frame() { return Frame(1024u, 1024u, FRAME_SEED, 1u, 0u, 0u, 0u, 8u, 1u, 2u, 1u, 0u, vec3(0.000000000e+00, 0.000000000e+00, -1.000000000e+00), 1.000000047e-03, vec3(7.478994876e-02, 9.971992970e-01, 0.000000000e+00), 1.953125000e-03, vec3(-1.727199912e+00, 1.295399964e-01, 0.000000000e+00), 1.953125000e-03, vec3(3.400000036e-01, 5.500000119e-01, 8.500000238e-01), 0u, vec3(4.000000060e-01, 4.000000060e-01, 4.000000060e-01), 0.000000000e+00, 4.317999780e-01, 0.000000000e+00, 0u, 0u, 0u, 0u, 0u, 0.000000000e+00, 1.000000000e+00, 0u, 0u, 0u, vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 0.000000000e+00, vec3(0.000000000e+00, 0.000000000e+00, 0.000000000e+00), 0.000000000e+00); }
#define FRAME_AS_CONSTANT
#include "kernels/loaders.glsl"
#define FORMULAS(X)
#define TEXTURES(X) X(constant, 0u, false) X(checker, 1u, true)
#include "textures/constant.glsl"
#include "textures/checker.glsl"
#define TEXTURES_OF(name, X) TEXTURES_OF_##name(X)
#define TEXTURES_OF_base(X) X(constant, 0u, false) X(checker, 1u, true)
#define TEXTURES_OF_specular(X) X(constant, 0u, false)
#define TEXTURES_OF_reflected(X) X(constant, 0u, false)
#define TEXTURES_OF_ambient(X) X(constant, 0u, false) X(checker, 1u, true)
#define TEXTURES_OF_emission(X) X(constant, 0u, false)
#define TEXTURES_OF_color(X) X(constant, 0u, false) X(checker, 1u, true)
#define TEXTURES_OF_roughness(X) X(constant, 0u, false)
#define TEXTURES_OF_metallic(X) X(constant, 0u, false)
#define TEXTURES_OF_coat(X) X(constant, 0u, false)
#define TEXTURES_OF_coat_roughness(X) X(constant, 0u, false)
#define TEXTURES_OF_specular_level(X) X(constant, 0u, false)
#define TEXTURES_OF_transmission(X) X(constant, 0u, false)
#define TEXTURES_OF_specular_color(X) X(constant, 0u, false)
#define TEXTURES_OF_sheen(X) X(constant, 0u, false)
#define TEXTURES_OF_sheen_roughness(X) X(constant, 0u, false)
#define TEXTURES_OF_normal_map(X)
#define TEXTURES_OF_bump(X)
#define TEXTURES_OF_coat_normal(X)
#define TEXTURES_OF_diffuse_transmission(X) X(constant, 0u, false)
#define TEXTURES_OF_diffuse_transmission_color(X) X(constant, 0u, false)
#define TEXTURES_OF_anisotropy(X) X(constant, 0u, false)
#define TEXTURES_OF_anisotropy_direction(X)
#define TEXTURES_OF_iridescence(X) X(constant, 0u, false)
#define TEXTURES_OF_iridescence_thickness(X) X(constant, 0u, false)
#define TEXTURES_OF_alpha(X) X(constant, 0u, false)
#define CLOSED_SHAPES(X)
#define IMMEDIATE_LEAVES(X)
#define DEFERRED_LEAVES(X)
#define SHAPES(X) X(sphere, 0u) X(triangle, 2u)
#include "shapes/sphere.glsl"
#include "shapes/triangle.glsl"
#define IMMEDIATE_SHAPES(X)
#define DEFERRED_SHAPES(X)
#define ALPHA_TESTED_SHAPES(X)
#define LOBES(X)
#define PANES(X) X(dielectric, 2u)
#define MATERIALS(X) X(phong, 0u) X(dielectric, 2u)
#include "materials/phong.glsl"
#include "materials/dielectric.glsl"
#define LIGHTS(X) X(point, 0u)
#include "lights/point.glsl"
#define EMITTERS(X)
#define CAMERAS(X) X(perspective, 0u, picture)
#include "cameras/perspective.glsl"
#define SAMPLERS(X) X(regular, 0u, square)
#include "samplers/regular.glsl"
#define INTEGRATORS(X) X(whitted, 1u, each_light, 2u)
#include "integrators/whitted.glsl"
