// The ABI: every record and binding slot that host and shaders share. Only float, int, uint, vec4 and uvec4, scalars in
// fours, sizes a multiple of 16: so std430, std140 and C++ agree. Positions are relative to the camera's eye.
#ifndef RECORDS_H
#define RECORDS_H

#include "language.h"

SHADER_BEGIN

// Descriptor set 0.
#define BINDING_PRIMITIVES 0
#define BINDING_VERTICES 1
#define BINDING_MATERIALS 2
#define BINDING_TEXTURES 3
#define BINDING_MEDIA 4
#define BINDING_LIGHTS 5
#define BINDING_FRAME 6
#define BINDING_OUTPUT 7
#define BINDING_RAYS 8
#define BINDING_NODES 9
#define BINDING_BVHS 10
#define BINDING_INSTANCES 11
#define BINDING_PACKET_HITS 12
#define BINDING_OCCLUSIONS 13
#define BINDING_PATHS 15
#define BINDING_LIST 16
#define BINDING_NEXT_LIST 17
#define BINDING_TEXELS 14
#define BINDING_BVH4_NODES 18

#define NONE 0xffffffffu
#define T_MISS 3.0e38f  // "no hit": beyond every t, below infinity, so that an infinite t is a miss
#define T_NONE -3.0e38f  // the same, where no t counts that is not above 0; before every t
#define T_ITERATION_LIMIT -3.2e38f  // "no hit found in the steps allowed"; uv.x says up to which t there is none for sure

// ---- Primitive: 64 bytes --------------------------------------------------------------------------------------------
//   0 id: the scene's primitive index, or that within an instance (below)    4 material | kind << 24
//   8 optical depth    12 extra: an index into vertices, or NONE
//  16 a (vec4)  32 b (vec4)   48 c (vec4)    what they hold is said in the shape's .glsl
// Where a primitive stands in the buffer, its slot, follows from the BVH and may change; its id does not.
struct Primitive {
  uvec4 head;
  vec4 a;
  vec4 b;
  vec4 c;
};
#define MOST_MATERIALS 0x1000000u
#define TRIANGLE_WOOP 0u
#define TRIANGLE_MOLLER_TRUMBORE 1u

// ---- Corners of a triangle with normals, texture coordinates or colours: 16 or 32 bytes in vertices ------------------
//   0 vertex 0   4 vertex 1   8 vertex 2    indices of vertices: normal.xyz, u; with CORNERS_COLORS then color.rgb, alpha
//                                           normals are unit, or of the lengths that a map that stretches has left them
//  12 CORNERS_ bits
//  16 v 0  20 v 1  24 v 2  28 -             only with CORNERS_UV
#define CORNERS_NORMALS 1u
#define CORNERS_UV 2u
#define CORNERS_COLORS 4u

// ---- BVH: 64 bytes; a node of it ------------------------------------------------------------------------------------
//   0 origin.xyz  12 -    16 step.xyz  28 -    a plane at q stands at origin + q · step
//  32 extent.xyz          the most that |q · step| is
//  44 slack               by which share of its reach a ray's boxes are widened
//  48 root, which may be a leaf   52 first slot of its primitives   56 end of its slots   60 -
// A node is two children. Quantised, a child is 16 bytes, its planes integers: lower | upper << 16 for x, y and z, then what it refers
// to; else it is 32: lower.xyz as floats, what it refers to, upper.xyz, -.
// A node of kernels/cooperative/bvh4.comp.glsl is four quantised children, one of kernels/cooperative/packet.glsl as many as a subgroup has lanes; those that are not there
// refer to NONE.
// A child refers to a node, to 1 … 8 primitives, LEAF | slot << 3 | count − 1, or to an instance, INSTANCE_LEAF | index.
struct Bvh {
  vec4 origin;
  vec4 step;
  vec4 extent;
  uvec4 head;
};
#define LEAF 0x80000000u
#define INSTANCE_LEAF 0xc0000000u
#define MOST_SLOTS 0x8000000u
#define MOST_INSTANCES 0x3ffffff0u

// ---- Instance of a mesh or a group with a BVH of its own: 112 bytes ---------------------------------------------------
//   0 BVH   4 id of its first shape, of a mesh its first triangle
//   8 material   12 optical depth        of a mesh's triangles; or of a group, whose primitives have their own:
//   8 NONE       12 id of its first triangle of a mesh
//  16 to_local.xyz, -, three rows: the linear map into its space, of what is relative to that space's origin
//  64 to_world, three rows: the affine map back, its w's that origin
// In its space ids count from 0, those of a group's meshes with ID_OF_TRIANGLE set.
struct Instance {
  uvec4 head;
  vec4 to_local[3];
  vec4 to_world[3];
};
#define ID_OF_TRIANGLE 0x80000000u

// ---- Material: 64 bytes ---------------------------------------------------------------------------------------------
//   0 kind       4 flags | emission, an index into textures, << 8      8 medium that fills the shape: 1…255, 0 for none    12 optical depth
//  16 base      20 specular  24 reflected  28 ambient    indices into textures; base, with emission, is what raycast shades
//  32 shininess 36 -         40 -          44 -
//  48 alpha, an index into textures        52 below which alpha there are holes, the bits of a float; 0 without      56 -   60 -
struct Material {
  uvec4 head;
  uvec4 textures;
  vec4 parameters;
  uvec4 mask;
};
#define MATERIAL_BLINN 1u
#define MATERIAL_EMISSION_SHIFT 8u
// Optical depth: what a shadow ray loses to each primitive that it hits, in −log2(transmittance) · OPTICAL_DEPTH_SCALE.
#define OPTICAL_DEPTH_OPAQUE 0x10000000u
#define OPTICAL_DEPTH_SCALE 1048576.0f

// ---- Medium: 16 bytes -----------------------------------------------------------------------------------------------
//   0 absorption.rgb  12 ior     number 0 is the vacuum
struct Medium {
  vec4 absorption_ior;
};

// ---- Texture: 64 bytes ----------------------------------------------------------------------------------------------
//   0 even.rgb  12 kind       kind: TEXTURE_CONSTANT, _CHECKER or _IMAGE, as a float; an image is multiplied by even
//  16 odd.rgb   28 -
//  32 1 / size.u  36 1 / size.v  40 -  44 -      of a check, or of the whole image
//  48 width  52 height  56 first texel  60 flags  of an image
struct Texture {
  vec4 even;
  vec4 odd;
  vec4 frequency;
  uvec4 image;
};
#define TEXTURE_CONSTANT 0.0f
#define TEXTURE_CHECKER 1.0f
#define TEXTURE_IMAGE 2.0f
#define IMAGE_NEAREST 1u
#define IMAGE_LINEAR 2u
#define IMAGE_WRAP_U_SHIFT 4u
#define IMAGE_WRAP_V_SHIFT 6u
#define IMAGE_WRAP_MASK 3u
#define WRAP_REPEAT 0u
#define WRAP_MIRROR 1u
#define WRAP_CLAMP 2u

// ---- Texels: 4 bytes each -------------------------------------------------------------------------------------------
// What the 256 codes stand for, as the bits of floats: by the sRGB curve, then linearly. Then the images' texels, each
// image by rows from its top left: red in the lowest byte, green, blue, alpha. Empty without images.
#define TEXELS_SRGB 0u
#define TEXELS_LINEAR 256u
#define TEXELS_FIRST 512u

// ---- Light: 48 bytes ------------------------------------------------------------------------------------------------
//   0 kind   4 falloff   8 -  12 -
//  16 position.xyz, or the unit direction towards a directional light    28 -
//  32 intensity.rgb      44 -
struct Light {
  uvec4 head;
  vec4 position;
  vec4 intensity;
};
#define LIGHT_POINT 0u
#define LIGHT_DIRECTIONAL 1u
#define FALLOFF_INVERSE_SQUARE 0u
#define FALLOFF_NONE 1u

// ---- Frame: what is the same for all pixels, 128 bytes --------------------------------------------------------------
//   0 width  4 height  8 seed  12 samples along a side (n of n × n)
//  16 camera type  20 sample pattern  24 media that the eye is in (materials/media.glsl)  28 max_depth
//  32 light count  36 2 (kernels/loops.glsl)  40 integrator  44 triangle method
//  48 right.xyz      60 min_throughput
//  64 up.xyz         76 2 / width
//  80 forward.xyz    92 2 / height
//  96 background.rgb
// 112 ambient.rgb
struct Frame {
  uvec4 image;
  uvec4 camera;
  uvec4 counts;
  vec4 right;
  vec4 up;
  vec4 forward;
  vec4 background;
  vec4 ambient;
};
#define CAMERA_PERSPECTIVE 0u
#define CAMERA_ORTHOGRAPHIC 1u
#define PATTERN_REGULAR 0u
#define PATTERN_JITTERED 1u

// ---- Push constants: what changes from dispatch to dispatch, 32 bytes -----------------------------------------------
//   0 tile x  4 tile y  8 tile width  12 tile height
//  16 sample  20 depth of a wave: the reflections before it    24 pixels of the tile    28 -
struct Dispatch {
  uvec4 tile;
  uvec4 sample_index;
};

// ---- Results --------------------------------------------------------------------------------------------------------
// One sample of one pixel, 32 bytes: colour.rgb and a 1 that says "written"; rays, hits, flags, loop iterations. With RAY_KINDS the
// last two are flags | refracted rays << REFRACTED_SHIFT, and reflected rays | total reflections << TOTAL_SHIFT.
struct SampleResult {
  vec4 color;
  uvec4 counts;
};
// The first hit of one pixel, 64 bytes: position.xyz (relative to the eye), t; normal.xyz; u, v; primitive, material.
// ids: primitive, material, flags. A miss has primitive = material = NONE and t = T_MISS.
struct HitResult {
  vec4 position_t;
  vec4 normal;
  vec4 uv;
  uvec4 ids;
};
// kernels/query.comp.glsl: a ray, 32 bytes: origin.xyz; direction.xyz, the t up to which occlusion counts.
struct QueryRay {
  vec4 origin;
  vec4 direction;
};
// And its answer, 16 bytes: the bits of t, primitive or NONE, flags, -. Asked whether anything is hit: 0 or T_MISS, NONE, flags,
// occlusion.
struct QueryHit {
  uvec4 hit;
};

// Rays that kernels/cooperative/packet.comp.glsl traces together. More share more of the work, and take longer to compile.
#define PACKET 32

// What the ray of one sample of a pixel hits, 32 bytes: the bits of t, slot, id, flags; the bits of u and v, -, -.
struct PacketHit {
  uvec4 hit;
  uvec4 uv;
};

// Where a pixel's path goes on, 48 bytes: origin.xyz; direction.xyz; throughput.rgb.
struct PathState {
  vec4 origin;
  vec4 direction;
  vec4 throughput;
};

#define REFRACTED_SHIFT 8u
#define TOTAL_SHIFT 20u

// Bits of SampleResult.counts.z; core/pixel.hpp names them for the host.
#define FLAG_MEDIA_OVERFLOW 1u
#define FLAG_STACK_OVERFLOW 2u
#define FLAG_LOOP_BUDGET 4u
#define FLAG_ITERATION_LIMIT 8u
#define FLAG_ENDLESS 16u  // a formula made more than FORMULA_TURNS turns of its loops in one call

SHADER_END

#ifdef __cplusplus
static_assert(sizeof(eyeray::shader::Primitive) == 64);
static_assert(sizeof(eyeray::shader::Bvh) == 64);
static_assert(sizeof(eyeray::shader::Instance) == 112);
static_assert(sizeof(eyeray::shader::Material) == 64);
static_assert(sizeof(eyeray::shader::Medium) == 16);
static_assert(sizeof(eyeray::shader::Texture) == 64);
static_assert(sizeof(eyeray::shader::Light) == 48);
static_assert(sizeof(eyeray::shader::Frame) == 128);
static_assert(sizeof(eyeray::shader::Dispatch) == 32);
static_assert(sizeof(eyeray::shader::SampleResult) == 32);
static_assert(sizeof(eyeray::shader::HitResult) == 64);
static_assert(sizeof(eyeray::shader::QueryRay) == 32);
static_assert(sizeof(eyeray::shader::QueryHit) == 16);
static_assert(sizeof(eyeray::shader::PacketHit) == 32);
static_assert(sizeof(eyeray::shader::PathState) == 48);
#endif
#endif
