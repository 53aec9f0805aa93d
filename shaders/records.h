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
#define BINDING_TEXELS 9

#define NONE 0xffffffffu

// ---- Primitive: 64 bytes --------------------------------------------------------------------------------------------
//   0 kind       4 material    8 shadow density (its material's)    12 extra: an index into vertices, or NONE
//  16 a (vec4)  32 b (vec4)   48 c (vec4)                           what they hold is said in the shape's .glsl
struct Primitive {
  uvec4 head;
  vec4 a;
  vec4 b;
  vec4 c;
};
#define TRIANGLE_WOOP 0u
#define TRIANGLE_MOLLER_TRUMBORE 1u

// ---- Material: 48 bytes ---------------------------------------------------------------------------------------------
//   0 kind       4 flags      8 medium that fills the shape: 1…255, 0 for none    12 shadow density
//  16 base      20 specular  24 reflected  28 ambient    indices into textures; base is what raycast shades
//  32 shininess 36 -         40 -          44 -
struct Material {
  uvec4 head;
  uvec4 textures;
  vec4 parameters;
};
#define MATERIAL_BLINN 1u
// Shadow density: what a shadow ray loses to each primitive that it meets, in −log2(transmittance) · SHADOW_SCALE.
#define SHADOW_OPAQUE 0x10000000u
#define SHADOW_SCALE 1048576.0f

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
// image by rows from its top left: red in the lowest byte, green, blue, and one that is not read. Empty without images.
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
//  16 camera type  20 sample pattern  24 media that the eye is in (media.glsl)  28 max_depth
//  32 light count  36 -  40 integrator  44 triangle method
//  48 right.xyz      60 min_weight
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
//  16 sample  20 -      24 -          28 -
struct Dispatch {
  uvec4 tile;
  uvec4 sample_index;
};

// ---- Results --------------------------------------------------------------------------------------------------------
// One sample of one pixel, 32 bytes: colour.rgb and a 1 that says "written"; rays, hits, flags, loop iterations.
struct SampleResult {
  vec4 color;
  uvec4 counts;
};
// The first hit of one pixel, 64 bytes: position.xyz (relative to the eye), t; normal.xyz; u, v; primitive, material.
// A miss has primitive = material = NONE and t = T_MISS.
struct HitResult {
  vec4 position_t;
  vec4 normal;
  vec4 uv;
  uvec4 ids;
};
// query.comp.glsl: a ray, 32 bytes: origin.xyz; direction.xyz, the t up to which occlusion counts.
struct QueryRay {
  vec4 origin;
  vec4 direction;
};
// And its answer, 16 bytes: the bits of t, primitive, occlusion, -.
struct QueryHit {
  uvec4 hit;
};

// Bits of SampleResult.counts.z; core/pixel.hpp names them for the host.
#define FLAG_MEDIA_OVERFLOW 1u
#define FLAG_STACK_OVERFLOW 2u
#define FLAG_LOOP_BUDGET 4u

SHADER_END

#ifdef __cplusplus
static_assert(sizeof(eyeray::shader::Primitive) == 64);
static_assert(sizeof(eyeray::shader::Material) == 48);
static_assert(sizeof(eyeray::shader::Medium) == 16);
static_assert(sizeof(eyeray::shader::Texture) == 64);
static_assert(sizeof(eyeray::shader::Light) == 48);
static_assert(sizeof(eyeray::shader::Frame) == 128);
static_assert(sizeof(eyeray::shader::Dispatch) == 32);
static_assert(sizeof(eyeray::shader::SampleResult) == 32);
static_assert(sizeof(eyeray::shader::HitResult) == 64);
static_assert(sizeof(eyeray::shader::QueryRay) == 32);
static_assert(sizeof(eyeray::shader::QueryHit) == 16);
#endif
#endif
