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
#define HAS_MEDIA 0
#define HAS_DISPERSION 0
#define HAS_ABSORPTION 0
#define HAS_SCATTERING 0
#define HAS_MEDIUM_EXTENT 0
#define PATH_STACK 0
#define RANDOM_WALK 0
#define TRACE_ITERATIONS 16u
#define TEXEL_BUFFERS 0
#define HAS_BVH false
#define QUANTISED_NODES false
#define HAS_LENS 1
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
#define END_plane 4u
#define UV_plane true
#define KIND_triangle 2u
#define FIRST_triangle 4u
#define END_triangle 4u
#define UV_triangle false
#define KIND_box 3u
#define FIRST_box 4u
#define END_box 10u
#define UV_box false
#define KIND_ellipsoid 4u
#define FIRST_ellipsoid 10u
#define END_ellipsoid 10u
#define UV_ellipsoid false
#define KIND_cylinder 5u
#define FIRST_cylinder 10u
#define END_cylinder 10u
#define UV_cylinder false
#define KIND_cone 6u
#define FIRST_cone 10u
#define END_cone 16u
#define UV_cone false
#define KIND_polygon 7u
#define FIRST_polygon 16u
#define END_polygon 16u
#define UV_polygon false
#define KIND_parallelogram 8u
#define FIRST_parallelogram 16u
#define END_parallelogram 16u
#define UV_parallelogram false
#define KIND_prism 9u
#define FIRST_prism 16u
#define END_prism 16u
#define UV_prism false
#define KIND_disk 10u
#define FIRST_disk 16u
#define END_disk 16u
#define UV_disk false
#define KIND_paraboloid 11u
#define FIRST_paraboloid 16u
#define END_paraboloid 16u
#define UV_paraboloid false
#define KIND_hyperboloid 12u
#define FIRST_hyperboloid 16u
#define END_hyperboloid 16u
#define UV_hyperboloid false
#define KIND_capsule 13u
#define FIRST_capsule 16u
#define END_capsule 16u
#define UV_capsule false
#define KIND_quadric 14u
#define FIRST_quadric 16u
#define END_quadric 16u
#define UV_quadric false
#define KIND_torus 15u
#define FIRST_torus 16u
#define END_torus 16u
#define UV_torus false
#define KIND_superellipsoid 16u
#define FIRST_superellipsoid 16u
#define END_superellipsoid 16u
#define UV_superellipsoid false
#define KIND_bilinear 17u
#define FIRST_bilinear 16u
#define END_bilinear 16u
#define UV_bilinear false
#define KIND_implicit 18u
#define FIRST_implicit 16u
#define END_implicit 16u
#define UV_implicit false
#define KIND_csg 19u
#define FIRST_csg 16u
#define END_csg 16u
#define UV_csg false
#define KIND_bezier 20u
#define FIRST_bezier 16u
#define END_bezier 16u
#define UV_bezier false
#define KIND_points 21u
#define FIRST_points 16u
#define END_points 16u
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
#include "kernels/loaders.glsl"
#include "math/formula.glsl"
void f0_0(float r0, float r1, out float r2, out float r3, out float r4) {
  float r5;
  float r6;
  float r7;
  float r8;
  float r9;
  float r10;
  float r11;
  float r12;
  float r13;
  float r14;
  r5 = r0 * uintBitsToFloat(0x400ccccdu);
  r6 = r1 * uintBitsToFloat(0x400ccccdu);
  r9 = r5 * uintBitsToFloat(0x40000000u);
  r10 = r6 * uintBitsToFloat(0x40000000u);
  r11 = r5 * r5;
  r12 = r6 * r6;
  r13 = r11 + r12;
  r14 = uintBitsToFloat(0x3f800000u) - r13;
  r2 = r9;
  r3 = r10;
  r4 = r14;
  return;
}
void f0_1(float r0, float r1, float r2, float r3, out float r4, out float r5, out float r6) {
  float r7;
  float r8;
  r7 = r2 * uintBitsToFloat(0x3cf5c28fu);
  r8 = r3 * uintBitsToFloat(0x3cf5c28fu);
  r4 = r7;
  r5 = r8;
  r6 = uintBitsToFloat(0x00000000u);
  return;
}
void f0_2(float r0, float r1, float r2, float r3, out float r4, out float r5, out float r6) {
  float r7;
  float r8;
  float r9;
  float r10;
  float r11;
  float r12;
  float r13;
  float r14;
  float r15;
  float r16;
  bool r17;
  float r18;
  float r19;
  float r20;
  float r21;
  float r22;
  float r23;
  float r24;
  float r25;
  float r26;
  float r27;
  float r28;
  float r29;
  float r30;
  float r31;
  float r32;
  float r33;
  float r34;
  float r35;
  float r36;
  float r37;
  float r38;
  r13 = r0 * r0;
  r14 = r1 * r1;
  r15 = r13 + r14;
  r16 = fn_sqrt(r15);
  r17 = uintBitsToFloat(0x3f7ae148u) < r16;
  if (r17) {
    r4 = uintBitsToFloat(0x00000000u);
    r5 = uintBitsToFloat(0x00000000u);
    r6 = uintBitsToFloat(0x00000000u);
    return;
  }
  r7 = r0;
  r8 = r1;
  f0_0(r7, r8, r18, r19, r20);
  r21 = r18 * r18;
  r22 = r19 * r19;
  r23 = r21 + r22;
  r24 = r20 * r20;
  r25 = r23 + r24;
  r26 = fn_sqrt(r25);
  r27 = r18 / r26;
  r28 = r19 / r26;
  r29 = r20 / r26;
  r30 = r27 * uintBitsToFloat(0x40600000u);
  r31 = r28 * uintBitsToFloat(0x40600000u);
  r32 = r29 * uintBitsToFloat(0x40600000u);
  r9 = r0;
  r10 = r1;
  r11 = r2;
  r12 = r3;
  f0_1(r9, r10, r11, r12, r33, r34, r35);
  r36 = r30 - r33;
  r37 = r31 - r34;
  r38 = r32 - r35;
  r4 = r36;
  r5 = r37;
  r6 = r38;
  return;
}
void f0_3(float r0, float r1, float r2, float r3, out float r4, out float r5, out float r6) {
  float r7;
  float r8;
  float r9;
  float r10;
  float r11;
  float r12;
  float r13;
  r7 = r0;
  r8 = r1;
  r9 = r2;
  r10 = r3;
  f0_2(r7, r8, r9, r10, r11, r12, r13);
  r4 = r11;
  r5 = r12;
  r6 = r13;
  return;
}
void f0_4(float r0, float r1, float r2, float r3, out float r4, out float r5, out float r6) {
  float r7;
  float r8;
  float r9;
  float r10;
  float r11;
  float r12;
  float r13;
  r7 = r0;
  r8 = r1;
  r9 = r2;
  r10 = r3;
  f0_1(r7, r8, r9, r10, r11, r12, r13);
  r4 = r11;
  r5 = r12;
  r6 = r13;
  return;
}
vec3 f0_direction(vec4 p) {
  float v0;
  float v1;
  float v2;
  f0_3(p.x, p.y, p.z, p.w, v0, v1, v2);
  return vec3(v0, v1, v2);
}
vec3 f0_origin(vec4 p) {
  float v0;
  float v1;
  float v2;
  f0_4(p.x, p.y, p.z, p.w, v0, v1, v2);
  return vec3(v0, v1, v2);
}
vec3 formula_direction(vec4 at) { return f0_direction(at); }
vec3 formula_origin(vec4 at) { return f0_origin(at); }
#define FORMULA_DIRECTION(number, at) formula_direction(at)
#define FORMULA_ORIGIN(number, at) formula_origin(at)
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
#define SHAPES(X) X(sphere, 0u) X(plane, 1u) X(box, 3u) X(cone, 6u)
#include "shapes/sphere.glsl"
#include "shapes/plane.glsl"
#include "shapes/box.glsl"
#include "shapes/cone.glsl"
#define IMMEDIATE_SHAPES(X)
#define DEFERRED_SHAPES(X)
#define ALPHA_TESTED_SHAPES(X)
#define LOBES(X)
#define PANES(X)
#define MATERIALS(X) X(phong, 0u) X(mirror, 1u)
#include "materials/phong.glsl"
#include "materials/mirror.glsl"
#define LIGHTS(X) X(directional, 1u)
#include "lights/directional.glsl"
#define EMITTERS(X)
#define CAMERAS(X) X(formula, 5u, itself)
#include "cameras/formula.glsl"
#define SAMPLERS(X) X(regular, 0u, square)
#include "samplers/regular.glsl"
#define INTEGRATORS(X) X(whitted, 1u, each_light, 2u)
#include "integrators/whitted.glsl"
