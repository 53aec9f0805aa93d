// Made for this scene by executors/specialise.cpp.
#define LIGHT_COUNT 1u
#define EMITTER_COUNT 0u
#define HAS_ENVIRONMENT 0
#define HAS_LIGHT_DISKS 0
#define HAS_LIGHT_BVH 0
#define HAS_ENVIRONMENT_LIGHT false
#define TRIANGLE_METHOD 0u
#define HAS_COLORS 0
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
#define HAS_TRANSMISSION 0
#define HAS_PANES 0
#define ANY_PANE false
#define ANY_INTERFACE false
#define HAS_MEDIA 0
#define HAS_ABSORPTION 0
#define HAS_SCATTERING 0
#define HAS_MEDIUM_EXTENT 0
#define PATH_STACK 0
#define RANDOM_WALK 0
#define TRACE_ITERATIONS 0u
#define TEXEL_BUFFERS 0
#define HAS_BVH true
#define QUANTISED_NODES true
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
#define MAY_REACH_ITERATION_LIMIT 1
#define SHIFT_STACK 0
#define STACK_SIZE 4
#define HAS_CSG 0
#define HAS_DEFERRED_LEAVES 0
#define HAS_MIXED_CSG 0
#define HAS_INSTANCES 0
#define INSTANCE_COUNT 0u
#define BVH_HOLDS(number, primitive) (number == 18u)
#define BVH_OF_TRIANGLES 0
#define GROUP_STRIDE 1u
#define KIND_sphere 0u
#define FIRST_sphere 0u
#define END_sphere 0u
#define UV_sphere false
#define KIND_plane 1u
#define FIRST_plane 0u
#define END_plane 1u
#define UV_plane true
#define KIND_triangle 2u
#define FIRST_triangle 1u
#define END_triangle 1u
#define UV_triangle false
#define KIND_box 3u
#define FIRST_box 1u
#define END_box 1u
#define UV_box false
#define KIND_ellipsoid 4u
#define FIRST_ellipsoid 1u
#define END_ellipsoid 1u
#define UV_ellipsoid false
#define KIND_cylinder 5u
#define FIRST_cylinder 1u
#define END_cylinder 1u
#define UV_cylinder false
#define KIND_cone 6u
#define FIRST_cone 1u
#define END_cone 1u
#define UV_cone false
#define KIND_polygon 7u
#define FIRST_polygon 1u
#define END_polygon 1u
#define UV_polygon false
#define KIND_parallelogram 8u
#define FIRST_parallelogram 1u
#define END_parallelogram 1u
#define UV_parallelogram false
#define KIND_prism 9u
#define FIRST_prism 1u
#define END_prism 1u
#define UV_prism false
#define KIND_disk 10u
#define FIRST_disk 1u
#define END_disk 1u
#define UV_disk false
#define KIND_paraboloid 11u
#define FIRST_paraboloid 1u
#define END_paraboloid 1u
#define UV_paraboloid false
#define KIND_hyperboloid 12u
#define FIRST_hyperboloid 1u
#define END_hyperboloid 1u
#define UV_hyperboloid false
#define KIND_capsule 13u
#define FIRST_capsule 1u
#define END_capsule 1u
#define UV_capsule false
#define KIND_quadric 14u
#define FIRST_quadric 1u
#define END_quadric 1u
#define UV_quadric false
#define KIND_torus 15u
#define FIRST_torus 1u
#define END_torus 1u
#define UV_torus false
#define KIND_superellipsoid 16u
#define FIRST_superellipsoid 1u
#define END_superellipsoid 1u
#define UV_superellipsoid false
#define KIND_bilinear 17u
#define FIRST_bilinear 1u
#define END_bilinear 1u
#define UV_bilinear false
#define KIND_implicit 18u
#define FIRST_implicit 1u
#define END_implicit 1u
#define UV_implicit true
#define KIND_csg 19u
#define FIRST_csg 1u
#define END_csg 1u
#define UV_csg false
#define KIND_bezier 20u
#define FIRST_bezier 1u
#define END_bezier 1u
#define UV_bezier false
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
#include "shapes/implicit/search.glsl"
void f0_0(float r0, float r1, float r2, out float r3) {
  float r4;
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
  float r15;
  float r16;
  float r17;
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
  float r39;
  float r40;
  r7 = uintBitsToFloat(0x3d75c28fu) * r0;
  r8 = fn_degrees(r7);
  r9 = fn_sin(r8);
  r10 = uintBitsToFloat(0x43480000u) * r2;
  r11 = fn_radians(r10);
  r12 = fn_cos(r11);
  r13 = r9 + r12;
  r14 = uintBitsToFloat(0x3f666666u) * r2;
  r15 = fn_tan(r14);
  r4 = r13 + r15;
  r17 = uintBitsToFloat(0x3f666666u) * r0;
  r18 = fn_asin(r17);
  r19 = uintBitsToFloat(0x3f59999au) * r2;
  r20 = fn_acos(r19);
  r21 = r18 - r20;
  r22 = uintBitsToFloat(0x40400000u) * r0;
  r23 = fn_atan(r22);
  r24 = r21 + r23;
  r25 = uintBitsToFloat(0x3fc00000u) + r0;
  r26 = fn_atan(r2, r25);
  r27 = uintBitsToFloat(0x40000000u) * r26;
  r5 = r24 + r27;
  r29 = uintBitsToFloat(0x3f99999au) * r0;
  r30 = fn_sinh(r29);
  r31 = uintBitsToFloat(0x3f8ccccdu) * r2;
  r32 = fn_cosh(r31);
  r33 = r30 - r32;
  r34 = uintBitsToFloat(0x40000000u) * r2;
  r35 = fn_tanh(r34);
  r6 = r33 + r35;
  r37 = r4 + r5;
  r38 = r37 + r6;
  r39 = uintBitsToFloat(0x3dcccccdu) * r38;
  r40 = r1 - r39;
  r3 = r40;
  return;
}
float f0_f(vec3 p) {
  float v0;
  f0_0(p.x, p.y, p.z, v0);
  return float(v0);
}
float formula0_value(vec3 p) { return f0_f(p); }
vec3 formula0_gradient(vec3 p) { return vec3(0.0f, 0.0f, 0.0f); }
#define FORMULA_NAME(part) formula0_##part
#define FORMULA_VALUE(it, p) formula0_value(p)
#define FORMULA_HAS_GRADIENT(it) false
#define FORMULA_GRADIENT(it, p) formula0_gradient(p)
#include "shapes/implicit/lipschitz_march.glsl"
#undef FORMULA_NAME
#undef FORMULA_VALUE
#undef FORMULA_HAS_GRADIENT
#undef FORMULA_GRADIENT
void f1_0(float r0, float r1, float r2, out float r3) {
  float r4;
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
  float r15;
  float r16;
  float r17;
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
  r8 = r0 * r0;
  r9 = r8 + uintBitsToFloat(0x3d4ccccdu);
  r10 = fn_sqrt(r9);
  r11 = uintBitsToFloat(0x3fa66666u) + r2;
  r12 = fn_inversesqrt(r11);
  r4 = r10 + r12;
  r14 = uintBitsToFloat(0x3f99999au) + r0;
  r15 = fn_pow(r14, uintBitsToFloat(0x3fd9999au));
  r16 = fn_pow(r2, uintBitsToFloat(0x40400000u));
  r5 = r15 - r16;
  r18 = fn_exp(r0);
  r19 = uintBitsToFloat(0x3fc00000u) * r2;
  r20 = fn_exp2(r19);
  r6 = r18 - r20;
  r22 = uintBitsToFloat(0x3fb33333u) + r2;
  r23 = fn_log(r22);
  r24 = uintBitsToFloat(0x40000000u) + r0;
  r25 = fn_log2(r24);
  r7 = r23 - r25;
  r27 = r4 + r5;
  r28 = r27 + r6;
  r29 = uintBitsToFloat(0x3dcccccdu) * r28;
  r30 = r1 - r29;
  r31 = uintBitsToFloat(0x3e19999au) * r7;
  r32 = r30 - r31;
  r3 = r32;
  return;
}
float f1_f(vec3 p) {
  float v0;
  f1_0(p.x, p.y, p.z, v0);
  return float(v0);
}
float formula1_value(vec3 p) { return f1_f(p); }
vec3 formula1_gradient(vec3 p) { return vec3(0.0f, 0.0f, 0.0f); }
#define FORMULA_NAME(part) formula1_##part
#define FORMULA_VALUE(it, p) formula1_value(p)
#define FORMULA_HAS_GRADIENT(it) false
#define FORMULA_GRADIENT(it, p) formula1_gradient(p)
#include "shapes/implicit/lipschitz_march.glsl"
#undef FORMULA_NAME
#undef FORMULA_VALUE
#undef FORMULA_HAS_GRADIENT
#undef FORMULA_GRADIENT
void f2_0(float r0, float r1, float r2, out float r3) {
  float r4;
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
  float r15;
  float r16;
  float r17;
  float r18;
  float r19;
  float r20;
  float r21;
  float r22;
  float r23;
  float r24;
  r6 = fn_max(r0, uintBitsToFloat(0x00000000u));
  r7 = fn_pow(r6, uintBitsToFloat(0x40a00000u));
  r8 = fn_min(r2, uintBitsToFloat(0x00000000u));
  r9 = fn_abs(r8);
  r10 = fn_pow(r9, uintBitsToFloat(0x40a00000u));
  r11 = r7 - r10;
  r12 = r0 + r2;
  r13 = fn_clamp(r12, uintBitsToFloat(0x00000000u), uintBitsToFloat(0x40400000u));
  r14 = fn_pow(r13, uintBitsToFloat(0x40a00000u));
  r15 = uintBitsToFloat(0x3dcccccdu) * r14;
  r4 = r11 + r15;
  r17 = -r2;
  r18 = fn_mix(r0, r17, uintBitsToFloat(0x3e99999au));
  r19 = fn_smoothstep(uintBitsToFloat(0xc0000000u), uintBitsToFloat(0x40000000u), r2);
  r20 = uintBitsToFloat(0x40000000u) * r19;
  r5 = r18 + r20;
  r22 = r4 + r5;
  r23 = uintBitsToFloat(0x3e19999au) * r22;
  r24 = r1 - r23;
  r3 = r24;
  return;
}
float f2_f(vec3 p) {
  float v0;
  f2_0(p.x, p.y, p.z, v0);
  return float(v0);
}
float formula2_value(vec3 p) { return f2_f(p); }
vec3 formula2_gradient(vec3 p) { return vec3(0.0f, 0.0f, 0.0f); }
#define FORMULA_NAME(part) formula2_##part
#define FORMULA_VALUE(it, p) formula2_value(p)
#define FORMULA_HAS_GRADIENT(it) false
#define FORMULA_GRADIENT(it, p) formula2_gradient(p)
#include "shapes/implicit/lipschitz_march.glsl"
#undef FORMULA_NAME
#undef FORMULA_VALUE
#undef FORMULA_HAS_GRADIENT
#undef FORMULA_GRADIENT
void f3_0(float r0, float r1, float r2, out float r3) {
  float r4;
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
  float r15;
  float r16;
  float r17;
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
  float r39;
  float r40;
  float r41;
  float r42;
  float r43;
  float r44;
  float r45;
  float r46;
  float r47;
  float r48;
  float r49;
  float r50;
  float r51;
  float r52;
  float r53;
  float r54;
  float r55;
  float r56;
  float r57;
  float r58;
  float r59;
  float r60;
  float r61;
  float r62;
  float r63;
  float r64;
  float r65;
  float r66;
  float r67;
  r7 = r0 - uintBitsToFloat(0x3e99999au);
  r8 = r2 - uintBitsToFloat(0xbe4ccccdu);
  r9 = r7 * r7;
  r10 = r8 * r8;
  r11 = r9 + r10;
  r12 = fn_sqrt(r11);
  r13 = r0 - uintBitsToFloat(0xbf000000u);
  r14 = r1 - uintBitsToFloat(0xbfc00000u);
  r15 = r2 - uintBitsToFloat(0x3e4ccccdu);
  r16 = r13 * r13;
  r17 = r14 * r14;
  r18 = r16 + r17;
  r19 = r15 * r15;
  r20 = r18 + r19;
  r21 = fn_sqrt(r20);
  r4 = r12 - r21;
  r23 = r0 + uintBitsToFloat(0x00000000u);
  r24 = r1 + uintBitsToFloat(0x40000000u);
  r25 = r2 + uintBitsToFloat(0x00000000u);
  r26 = r23 * r23;
  r27 = r24 * r24;
  r28 = r26 + r27;
  r29 = r25 * r25;
  r30 = r28 + r29;
  r31 = fn_sqrt(r30);
  r32 = r23 / r31;
  r33 = r24 / r31;
  r34 = r25 / r31;
  r35 = uintBitsToFloat(0x40400000u) * r32;
  r36 = uintBitsToFloat(0x3e88d677u) * r0;
  r37 = uintBitsToFloat(0x3f4d41b2u) * r1;
  r38 = r36 + r37;
  r39 = uintBitsToFloat(0x3f08d677u) * r2;
  r40 = r38 + r39;
  r41 = uintBitsToFloat(0x40000000u) * r40;
  r42 = uintBitsToFloat(0x3e88d677u) * r41;
  r43 = r0 - r42;
  r44 = uintBitsToFloat(0x3f4d41b2u) * r41;
  r45 = r1 - r44;
  r46 = uintBitsToFloat(0x3f08d677u) * r41;
  r47 = r2 - r46;
  r5 = r35 + r47;
  r49 = r0 * uintBitsToFloat(0x3e99999au);
  r50 = r1 * uintBitsToFloat(0x3f000000u);
  r51 = r49 + r50;
  r52 = r2 * uintBitsToFloat(0xbe4ccccdu);
  r53 = r51 + r52;
  r54 = r1 * uintBitsToFloat(0xbf800000u);
  r55 = r2 * uintBitsToFloat(0x40000000u);
  r56 = r54 - r55;
  r57 = r2 * uintBitsToFloat(0x3f000000u);
  r58 = r0 * uintBitsToFloat(0xbf800000u);
  r59 = r57 - r58;
  r60 = r0 * uintBitsToFloat(0x40000000u);
  r61 = r1 * uintBitsToFloat(0x3f000000u);
  r62 = r60 - r61;
  r63 = r53 + r59;
  r6 = r63;
  r64 = r4 + r5;
  r65 = r64 + r6;
  r66 = uintBitsToFloat(0x3e4ccccdu) * r65;
  r67 = r1 - r66;
  r3 = r67;
  return;
}
float f3_f(vec3 p) {
  float v0;
  f3_0(p.x, p.y, p.z, v0);
  return float(v0);
}
float formula3_value(vec3 p) { return f3_f(p); }
vec3 formula3_gradient(vec3 p) { return vec3(0.0f, 0.0f, 0.0f); }
#define FORMULA_NAME(part) formula3_##part
#define FORMULA_VALUE(it, p) formula3_value(p)
#define FORMULA_HAS_GRADIENT(it) false
#define FORMULA_GRADIENT(it, p) formula3_gradient(p)
#include "shapes/implicit/lipschitz_march.glsl"
#undef FORMULA_NAME
#undef FORMULA_VALUE
#undef FORMULA_HAS_GRADIENT
#undef FORMULA_GRADIENT
void f4_0(float r0, float r1, float r2, out float r3) {
  float r4;
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
  float r15;
  float r16;
  float r17;
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
  float r39;
  float r40;
  float r41;
  float r42;
  float r43;
  float r44;
  float r45;
  float r46;
  float r47;
  float r48;
  float r49;
  float r50;
  float r51;
  float r52;
  float r53;
  float r54;
  float r55;
  r6 = uintBitsToFloat(0x3fd9999au) * r0;
  r7 = fn_fract(r6);
  r8 = uintBitsToFloat(0x40c90fdbu) * r7;
  r9 = fn_sin(r8);
  r10 = r0 + r2;
  r11 = fn_mod(r10, uintBitsToFloat(0x3f99999au));
  r12 = uintBitsToFloat(0x40c90fdbu) * r11;
  r13 = r12 / uintBitsToFloat(0x3f99999au);
  r14 = fn_sin(r13);
  r15 = r9 + r14;
  r16 = uintBitsToFloat(0x3fd9999au) * r2;
  r17 = uintBitsToFloat(0x3fd9999au) * r2;
  r18 = fn_round(r17);
  r19 = r16 - r18;
  r20 = uintBitsToFloat(0x40c90fdbu) * r19;
  r21 = fn_sin(r20);
  r4 = r15 + r21;
  r23 = uintBitsToFloat(0x3ff33333u) * r2;
  r24 = fn_ceil(r23);
  r25 = uintBitsToFloat(0x3ff33333u) * r2;
  r26 = r24 - r25;
  r27 = uintBitsToFloat(0x40c90fdbu) * r26;
  r28 = fn_cos(r27);
  r29 = uintBitsToFloat(0x3fcccccdu) * r0;
  r30 = uintBitsToFloat(0x3fcccccdu) * r0;
  r31 = fn_trunc(r30);
  r32 = r29 - r31;
  r33 = uintBitsToFloat(0x40c90fdbu) * r32;
  r34 = fn_cos(r33);
  r35 = r28 + r34;
  r36 = uintBitsToFloat(0x3fa66666u) * r2;
  r37 = uintBitsToFloat(0x3fa66666u) * r2;
  r38 = fn_floor(r37);
  r39 = r36 - r38;
  r40 = uintBitsToFloat(0x40c90fdbu) * r39;
  r41 = fn_sin(r40);
  r42 = r35 + r41;
  r4 = r4 + r42;
  r44 = fn_sign(r2);
  r45 = fn_pow(r2, uintBitsToFloat(0x40a00000u));
  r46 = r44 * r45;
  r47 = fn_step(uintBitsToFloat(0x3e4ccccdu), r0);
  r48 = r0 - uintBitsToFloat(0x3e4ccccdu);
  r49 = fn_pow(r48, uintBitsToFloat(0x40800000u));
  r50 = r47 * r49;
  r5 = r46 - r50;
  r52 = uintBitsToFloat(0x3d23d70au) * r4;
  r53 = r1 - r52;
  r54 = uintBitsToFloat(0x3ecccccdu) * r5;
  r55 = r53 - r54;
  r3 = r55;
  return;
}
float f4_f(vec3 p) {
  float v0;
  f4_0(p.x, p.y, p.z, v0);
  return float(v0);
}
float formula4_value(vec3 p) { return f4_f(p); }
vec3 formula4_gradient(vec3 p) { return vec3(0.0f, 0.0f, 0.0f); }
#define FORMULA_NAME(part) formula4_##part
#define FORMULA_VALUE(it, p) formula4_value(p)
#define FORMULA_HAS_GRADIENT(it) false
#define FORMULA_GRADIENT(it, p) formula4_gradient(p)
#include "shapes/implicit/lipschitz_march.glsl"
#undef FORMULA_NAME
#undef FORMULA_VALUE
#undef FORMULA_HAS_GRADIENT
#undef FORMULA_GRADIENT
#define FORMULAS(X) X(0u, formula0) X(1u, formula1) X(2u, formula2) X(3u, formula3) X(4u, formula4)
#define TEXTURES(X) X(constant, 0u, false) X(checker, 1u, true)
#include "textures/constant.glsl"
#include "textures/checker.glsl"
#define TEXTURES_OF(name, X) TEXTURES_OF_##name(X)
#define TEXTURES_OF_base(X) X(checker, 1u, true)
#define TEXTURES_OF_specular(X) X(constant, 0u, false)
#define TEXTURES_OF_reflected(X) X(constant, 0u, false)
#define TEXTURES_OF_ambient(X) X(checker, 1u, true)
#define TEXTURES_OF_emission(X) X(constant, 0u, false)
#define TEXTURES_OF_color(X) X(checker, 1u, true)
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
#define TEXTURES_OF_alpha(X) X(constant, 0u, false)
#define CLOSED_SHAPES(X)
#define IMMEDIATE_LEAVES(X)
#define DEFERRED_LEAVES(X)
#define SHAPES(X) X(plane, 1u) X(implicit, 18u)
#include "shapes/plane.glsl"
#include "shapes/implicit.glsl"
#define IMMEDIATE_SHAPES(X) X(implicit, 18u)
#include "shapes/implicit.glsl"
#define DEFERRED_SHAPES(X)
#define ALPHA_TESTED_SHAPES(X)
#define LOBES(X)
#define PANES(X)
#define MATERIALS(X) X(phong, 0u)
#include "materials/phong.glsl"
#define LIGHTS(X) X(directional, 1u)
#include "lights/directional.glsl"
#define EMITTERS(X)
#define CAMERAS(X) X(perspective, 0u, picture)
#include "cameras/perspective.glsl"
#define SAMPLERS(X) X(regular, 0u, square)
#include "samplers/regular.glsl"
#define INTEGRATORS(X) X(whitted, 1u, each_light, 2u)
#include "integrators/whitted.glsl"
