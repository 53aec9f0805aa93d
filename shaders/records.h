// The ABI: every record and binding slot that host and shaders share. Scalars in fours, vec4, or vec3 with a scalar behind it, and a
// size that is a multiple of 16: so std430 and C++ agree. Positions are relative to the camera's eye. A word that holds several things
// has a function here that takes it apart.
#ifndef RECORDS_H
#define RECORDS_H

#include "language.h"
#include "photon_records.h"
#include "result_records.h"

SHADER_BEGIN

// Descriptor set 0. No two have one number.
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
#define BINDING_TEXELS 14
#define BINDING_PATHS 15
#define BINDING_LIST 16
#define BINDING_NEXT_LIST 17
#define BINDING_BVH4_NODES 18
#define BINDING_PROBE 19
#define BINDING_TUNABLES 20
#define BINDING_EMITTERS 21
#define BINDING_ENVIRONMENT 22
#define BINDING_ALBEDOS 23
#define BINDING_LIGHT_NODES 24
#define BINDING_PHOTONS 25
#define BINDING_PHOTON_CELLS 26  // where each key's photons begin, and where the last one's end
#define BINDING_PHOTON_PASS 27
#define BINDING_EMITTER_MEDIA 28
#define BINDING_FORMULA_NUMBERS 29

#define NONE 0xffffffffu
#define T_MISS 3.0e38f  // "no hit": beyond every t, below infinity, so that an infinite t is a miss
#define T_NONE -3.0e38f  // the same, where no t counts that is not above 0; before every t
#define T_ITERATION_LIMIT -3.2e38f  // "no hit found in the steps allowed"; up to t = uv.x there is none for sure

// ---- Primitive: 64 bytes --------------------------------------------------------------------------------------------
// Where a primitive stands in the buffer, its slot, follows from the BVH and may change; its id does not.
struct Primitive {
  uint id;                 // the scene's primitive index, or that within an instance (below)
  uint material_and_kind;  // material_of, kind_of
  uint optical_depth;
  uint extra;  // an index into vertices, or NONE; a shape that needs none may keep a word here
  vec4 a;      // contents: see the shape's .glsl
  vec4 b;
  vec4 c;
};
INLINE uint kind_of(Primitive primitive) { return primitive.material_and_kind >> 24u; }
INLINE uint material_of(Primitive primitive) { return primitive.material_and_kind & 0xffffffu; }
INLINE uint material_and_kind(uint material, uint kind) { return material | kind << 24u; }
// A primitive as four words of vertices.
INLINE uvec4 head_of(Primitive primitive) {
  return uvec4(primitive.id, primitive.material_and_kind, primitive.optical_depth, primitive.extra);
}
INLINE Primitive primitive_of(uvec4 head, vec4 a, vec4 b, vec4 c) {
  Primitive primitive;
  primitive.id = head.x;
  primitive.material_and_kind = head.y;
  primitive.optical_depth = head.z;
  primitive.extra = head.w;
  primitive.a = a;
  primitive.b = b;
  primitive.c = c;
  return primitive;
}
#define MOST_MATERIALS 0x1000000u
#define TRIANGLE_WOOP 0u
#define TRIANGLE_MOLLER_TRUMBORE 1u

// ---- Corners of a triangle with normals, texture coordinates or colours: 16 to 96 bytes in vertices ------------------
//   0 vertex 0   4 vertex 1   8 vertex 2    indices of vertices: normal.xyz, u; with CORNERS_COLORS then color.rgb, alpha.
//                                           Normals are unit, or of the lengths that a map that stretches has left them.
//  12 CORNERS_ bits
//  16 v 0  20 v 1  24 v 2  28 -             only with CORNERS_UV.
// With CORNERS_GRADIENTS then the gradients of u and of v, a vec4 each, and with CORNERS_SECOND_UV those of the second ones.
// Behind all that, a vertex has its second u and v, -, -, with CORNERS_SECOND_UV; and with CORNERS_TANGENTS Surface::tangent, which with
// CORNERS_SECOND_TANGENTS is along the second u.
#define CORNERS_NORMALS 1u
#define CORNERS_UV 2u
#define CORNERS_COLORS 4u
#define CORNERS_GRADIENTS 8u
#define CORNERS_TANGENTS 16u
#define CORNERS_SECOND_UV 32u
#define CORNERS_SECOND_TANGENTS 64u

// ---- BVH: 64 bytes; a node of it ------------------------------------------------------------------------------------
// A node is two children. Quantised, a child is 16 bytes, its planes integers: lower | upper << 16 for x, y and z, then its reference;
// else it is 32: lower.xyz as floats, its reference, upper.xyz, -.
// A node of kernels/cooperative/bvh4.comp.glsl is four quantised children, one of kernels/cooperative/packet.glsl as many as a subgroup has lanes; those that are not there
// refer to NONE.
// A child refers to a node, to 1 … 8 primitives, LEAF | slot << 3 | count − 1, or to an instance, INSTANCE_LEAF | index.
struct Bvh {
  vec3 origin;  // a plane at q stands at origin + q · step
  float unused_0;
  vec3 step;
  float unused_1;
  vec3 extent;      // the most that |q · step| is
  float slack;      // by which share of its reach a ray's boxes are widened
  uint root;        // which may be a leaf
  uint first_slot;  // first slot of its primitives
  uint end_slot;
  uint unused_2;
};
#define LEAF 0x80000000u
#define INSTANCE_LEAF 0xc0000000u
#define MOST_SLOTS 0x8000000u
#define MOST_INSTANCES 0x3ffffff0u

// ---- Instance of a mesh or a group with a BVH of its own: 112 bytes ---------------------------------------------------
// In its space ids count from 0, those of a group's meshes with ID_OF_TRIANGLE set.
struct Instance {
  uint bvh;
  uint first_id;           // first id of its first shape, of a mesh its first triangle
  uint material;           // material of a mesh's triangles; NONE of a group, whose primitives have their own
  uint depth_or_triangle;  // mesh_optical_depth, first_triangle_of
  vec4 to_local[3];        // rows: the linear map into its space, of vectors relative to that space's origin; w unused
  vec4 to_world[3];        // rows: the affine map back, its w's that origin
};
INLINE bool of_group(Instance instance) { return instance.material == NONE; }
// The optical depth of each of a mesh's triangles; NONE for a group.
INLINE uint mesh_optical_depth(Instance instance) { return of_group(instance) ? NONE : instance.depth_or_triangle; }
// The id of a group's first triangle of a mesh.
INLINE uint first_triangle_of(Instance instance) { return instance.depth_or_triangle; }
#define ID_OF_TRIANGLE 0x80000000u

// ---- Material: 208 bytes --------------------------------------------------------------------------------------------
struct Material {
  uint kind;
  uint flags;
  uint medium;  // that fills the shape: 1…255, 0 for none
  uint optical_depth;
  uint base;  // indices into textures
  uint specular;
  uint reflected;
  uint ambient;
  uint emission;
  uint alpha;
  float alpha_cutoff;  // below which alpha is cut out; above 0 where there is an alpha at all
  float shininess;
  vec4 a;  // contents: see the material's .glsl
  uint color;  // more textures, of BSDFs; of roughness the green channel counts, of metallic the blue one; raycast shades color + emission
  uint roughness;
  uint metallic;
  uint coat;
  vec4 b;
  vec3 c;
  uint coat_roughness;
  uint specular_level;  // the red channel of these two textures counts, as in `coat`
  uint transmission;
  uint specular_color;
  uint sheen;
  uint sheen_roughness;  // the green channel
  uint normal_map;       // or NONE, …
  float normal_scale;
  uint bump;  // … as this (materials/bent_normal.glsl)
  float bump_height;
  float bump_width;
  uint coat_normal;  // or NONE: as normal_map, of the coat alone
  float coat_normal_scale;
  uint diffuse_transmission;  // the red channel counts
  uint diffuse_transmission_color;
  uint anisotropy;            // the blue channel counts; only of a MATERIAL_ANISOTROPIC
  uint anisotropy_direction;  // or NONE: a map as normal_map
  vec2 anisotropy_turn;       // cosine and sine of the angle by which the map's direction, or u's, is turned
  uint iridescence;           // the red channel counts
  uint iridescence_thickness;  // the green channel counts: the share of the way …
  float iridescence_least;     // … from this thickness, in nanometres, …
  float iridescence_most;      // … to this one
  float iridescence_ior;
  uint unused;
};
#define MATERIAL_BLINN 1u
#define MATERIAL_PANE 2u   // it has no inside: paths may pass it straight
#define MOST_PANES 8u      // that a shadow ray to a light with an extent goes through; paths find the light behind more
#define MOST_CROSSINGS 65536u  // the most panes and interfaces that a shadow ray crosses; more set FLAG_ITERATION_LIMIT
#define MATERIAL_CLEAR 4u  // for principled: Whitted's pictures show glass, and `base` is its colour
#define MATERIAL_EMITS_IN_FRONT 8u  // its own light goes only where normals point
#define MATERIAL_FRONT_ONLY 32u  // rays that come from behind a triangle do not hit it
#define MATERIAL_BLENDS 64u  // rays hit it with a probability of its alpha, for any alpha_cutoff
#define MATERIAL_ANISOTROPIC 128u  // its microfacets are wider along one direction
#define MATERIAL_BUMP_IN_SPACE 16u  // bump_width is a length in the world, else in uv
// Optical depth: the loss at each primitive that a shadow ray hits, in −log2(transmittance) · OPTICAL_DEPTH_SCALE.
#define OPTICAL_DEPTH_OPAQUE 0x10000000u
#define OPTICAL_DEPTH_SCALE 1048576.0f

// ---- Albedos: 16 bytes each; empty where no lobe needs them ----------------------------------------------------------
// Those of host/tables, of as many rows by roughness as columns by √cosine. First bsdf/ggx_albedo.glsl, then sheen.glsl, then
// rough_glass.glsl, this one with GLASS_SLICES of them by the two indices.
#define GGX_ALBEDOS 64u
#define SHEEN_ALBEDOS 32u
#define GLASS_ALBEDOS 32u
#define GLASS_SLICES 24u  // each has the values at its begin and at its end; …
#define GLASS_SLICES_BELOW 14u  // … so many where light comes from the greater index
#define FIRST_SHEEN_ALBEDO 4096u
#define FIRST_GLASS_ALBEDO 5120u
#define END_OF_ALBEDOS 29696u

// ---- Medium: 48 bytes -----------------------------------------------------------------------------------------------
// Number 0 is around all: the scene's own, or the vacuum.
struct Medium {
  vec3 absorption;  // per unit of length, as …
  float ior;
  vec3 scattering;  // … this is, which is 0 where paths do not walk at random
  float anisotropy;
  float spread;  // by which the index at blue exceeds `ior`, and that at red is below
  float unused_0;
  float unused_1;
  float unused_2;
};

// ---- Texture: 64 bytes ----------------------------------------------------------------------------------------------
struct Texture {
  vec3 color;
  uint kind;
  vec4 a;  // contents: see the texture's .glsl
  vec4 b;
  uvec4 c;
};
// The flags of an image, in c.w, which is 0 of any other kind.
#define IMAGE_NEAREST 1u
#define IMAGE_LINEAR 2u
#define IMAGE_SECOND_UV 4u
#define IMAGE_WRAP_U_SHIFT 4u
#define IMAGE_WRAP_V_SHIFT 6u
#define IMAGE_WRAP_MASK 3u
INLINE bool reads_second_uv(Texture texture) { return (texture.c.w & IMAGE_SECOND_UV) != 0u; }
#define WRAP_REPEAT 0u
#define WRAP_MIRROR 1u
#define WRAP_CLAMP 2u

// ---- Texels: 4 bytes each -------------------------------------------------------------------------------------------
// The values of the 256 codes, as the bits of floats: by the sRGB curve, then linearly. Then the images' texels, each
// image by rows from its top left: red in the lowest byte, green, blue, alpha. Empty without images.
#define TEXELS_SRGB 0u
#define TEXELS_LINEAR 256u
#define TEXELS_FIRST 512u

// ---- Light: 48 bytes ------------------------------------------------------------------------------------------------
struct Light {
  vec3 intensity;
  uint kind;
  vec4 a;  // contents: see the light's .glsl
  vec4 b;
};

// ---- Emitter: a light that a path may choose, 96 bytes --------------------------------------------------------------
// The first LIGHT_COUNT stand for the lights; only `end` of these counts. The others are surfaces.
struct Emitter {
  vec3 radiance;  // unless `texture` contains it
  uint kind;
  vec4 a;  // contents: see the emitter's .glsl
  vec4 b;
  vec4 c;
  uint primitive;  // whose surface it is
  uint end;        // end of the numbers by which it is chosen (emitters/emitter.glsl)
  float area;
  float offset;  // a point this far off it is off it, however it is rounded
  uint trail;    // to it through the light BVH: bit k is set where it is the second child at level k; NONE where it is not in that
  uint texture;  // texture of its radiance, or NONE
  uint corners;  // corners of a triangle with a texture, four of vertices: color.rgb and u of each corner, the three v; or NONE
  float side;    // 1 where it lights only the side that its normal points to, −1 the other side; 0 both sides
};

// ---- A node of the light BVH: 48 bytes; nodes are pairs of children, the root's first -------------------------------
struct LightNode {
  vec3 center;  // center of a sphere around its lights
  float radius;
  vec3 axis;  // that their normals are not far from
  float power;
  float cos_spread;  // cosine of the largest angle between the axis and a normal
  float cos_reach;   // and of that between a normal and a way that light goes
  uint child;        // its own pair of children; or LEAF | the light, as emitters are counted
  uint both_sides;   // 1 where light also goes along the normals' opposites
};
#define LIGHT_BVH_DEPTH 24u
#define LIGHT_BVH_LEVELS_A_NUMBER 4u  // that one random number is used for

// ---- Environment: 16 bytes a texel; empty without one ---------------------------------------------------------------
// height + 1 rows of width + 1 texels: red, green and blue as the bits of floats. The last row and the last column are the picture's last
// row and first column again. The fourth word is the end of the numbers by which the cell is chosen whose lower left corner this is,
// among those of its row. In the last column it is the end of those by which the row is chosen.

// ---- Frame: the values that all pixels share, 208 bytes -------------------------------------------------------------
struct Frame {
  uint width;
  uint height;
  uint seed;
  uint samples_per_side;  // n of n × n
  uint camera;
  uint pattern;  // the sampler's number
  uint media;  // that the eye is in (materials/media.glsl)
  uint max_depth;
  uint light_count;
  uint loop_probe;  // 2 (kernels/loops.glsl)
  uint integrator;
  uint triangle_method;
  vec3 right;
  float min_throughput;
  vec3 up;
  float pixel_width;  // pixel width of a picture that is 2 wide
  vec3 forward;
  float pixel_height;
  vec3 background;
  uint emitter_count;
  vec3 ambient;
  float aperture;        // radius of the lens
  float sharpness;       // the share of the way to the plane in focus at which `forward` ends
  float blade_rotation;  // radians
  uint blades;           // corners of the lens; 0: it is a disk
  uint pixel_filter;     // FILTER_
  uint environment_width;    // environment width of the picture; 0 without one
  uint environment_height;
  uint environment_numbers;  // how many numbers of 2^24 choose the environment and not a light
  float environment_turn;    // by how much of a whole turn it is turned about y
  float filter_width;        // pixels
  uint light_bvh_numbers;    // how many numbers of 2^24 choose a light by the light BVH; 0 without one
  uint camera_formula;       // the number of the camera's, where it has one
  uint has_medium_extent;    // 1 where the medium around all has the extent that follows (materials/medium_extent.glsl)
  vec3 medium_min;  // corners of a box; ±T_MISS where a side is infinitely far away
  float medium_decay;  // 1 / scale height; 0 where the medium is the same at all heights
  vec3 medium_max;
  float medium_base;  // height at which the density is 1
};
#define FILTER_BOX 0u
#define FILTER_GAUSSIAN 1u
#define FILTER_BLACKMAN_HARRIS 2u

// ---- Push constants: the values that change from dispatch to dispatch, 32 bytes -------------------------------------
struct Dispatch {
  uint tile_x;
  uint tile_y;
  uint tile_width;
  uint tile_height;
  uint sample_index;
  uint depth;  // the reflections before this wavefront
  uint count;   // pixels of the tile, or rays of a query
  uint stride;  // the tile has one of so many pixels along each axis of the picture
};

SHADER_END

#ifdef __cplusplus
static_assert(sizeof(eyeray::engine::shader::Primitive) == 64);
static_assert(sizeof(eyeray::engine::shader::Bvh) == 64);
static_assert(sizeof(eyeray::engine::shader::Instance) == 112);
static_assert(sizeof(eyeray::engine::shader::Material) == 208);
static_assert(sizeof(eyeray::engine::shader::Medium) == 48);
static_assert(sizeof(eyeray::engine::shader::Texture) == 64);
static_assert(sizeof(eyeray::engine::shader::Light) == 48);
static_assert(sizeof(eyeray::engine::shader::Emitter) == 96);
static_assert(sizeof(eyeray::engine::shader::LightNode) == 48);
static_assert(sizeof(eyeray::engine::shader::Frame) == 208);
static_assert(sizeof(eyeray::engine::shader::Dispatch) == 32);
#endif
#endif
