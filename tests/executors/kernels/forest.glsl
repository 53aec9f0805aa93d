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
#define MAY_REACH_ITERATION_LIMIT 0
#define SHIFT_STACK 0
#define STACK_SIZE 22
#define HAS_CSG 0
#define HAS_DEFERRED_LEAVES 0
#define HAS_MIXED_CSG 0
#define HAS_INSTANCES 1
#define INSTANCE_COUNT 262u
#define BVH_HOLDS(number, primitive) (kind_of(primitive) == number)
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
#define UV_implicit false
#define KIND_csg 19u
#define FIRST_csg 1u
#define END_csg 1u
#define UV_csg false
#define KIND_bezier 20u
#define FIRST_bezier 1u
#define END_bezier 1u
#define UV_bezier false
#define KIND_points 21u
#define FIRST_points 1u
#define END_points 1u
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
#define SHAPES(X) X(sphere, 0u) X(plane, 1u) X(ellipsoid, 4u) X(cylinder, 5u) X(cone, 6u) X(disk, 10u) X(capsule, 13u)
#include "shapes/sphere.glsl"
#include "shapes/plane.glsl"
#include "shapes/ellipsoid.glsl"
#include "shapes/cylinder.glsl"
#include "shapes/cone.glsl"
#include "shapes/disk.glsl"
#include "shapes/capsule.glsl"
#define IMMEDIATE_SHAPES(X) X(sphere, 0u) X(ellipsoid, 4u) X(cylinder, 5u) X(cone, 6u) X(disk, 10u) X(capsule, 13u)
#include "shapes/sphere.glsl"
#include "shapes/ellipsoid.glsl"
#include "shapes/cylinder.glsl"
#include "shapes/cone.glsl"
#include "shapes/disk.glsl"
#include "shapes/capsule.glsl"
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
