// The defines by which a kernel is specialised: the contract between executors/specialise.cpp, which writes these defines for a scene,
// the twin, which is compiled once for every scene (twin/shader_functions.hpp), and the shaders that test them. A test compares the lists.
#ifndef FEATURES_H
#define FEATURES_H

// ---- The scene's features. Default: everything; the twin takes it, and shaders test the records as well -------------
#ifndef HAS_COLORS  // a mesh's vertices have colours, or points have
#define HAS_COLORS 1
#endif
#ifndef HAS_PIECES  // a shape has several primitives of one id
#define HAS_PIECES 1
#endif
#ifndef HAS_ROUND_CONES  // a capsule has two radii
#define HAS_ROUND_CONES 1
#endif
#ifndef HAS_LATHES  // a patch has texture coordinates of its own, as those of a lathe do
#define HAS_LATHES 1
#endif
#ifndef HAS_SECOND_UV  // a mesh's vertices have second texture coordinates, which an image may read
#define HAS_SECOND_UV 1
#endif
#ifndef HAS_SMOOTH  // a triangle has normals at its corners
#define HAS_SMOOTH 1
#endif
#ifndef HAS_EMISSION  // a material emits light
#define HAS_EMISSION 1
#endif
#ifndef HAS_EMISSION_TEXTURES  // … and not the same everywhere on a surface that a path may choose
#define HAS_EMISSION_TEXTURES 1
#endif
#ifndef HAS_ONE_SIDED_EMISSION  // … only in front
#define HAS_ONE_SIDED_EMISSION 1
#endif
#ifndef HAS_ENVIRONMENT  // there is an environment in place of the background
#define HAS_ENVIRONMENT 1
#endif
#ifndef HAS_LIGHT_DISKS  // a light is seen under an angle
#define HAS_LIGHT_DISKS 1
#endif
#ifndef HAS_LIGHT_BVH  // lights are chosen by one
#define HAS_LIGHT_BVH 1
#endif
#ifndef HAS_PHOTONS  // lights send out photons, which paths gather
#define HAS_PHOTONS 1
#endif
#ifndef HAS_GLOSSY  // a surface has the lobe of bsdf/glossy.glsl …
#define HAS_GLOSSY 1
#endif
#ifndef HAS_CONDUCTORS  // … and mirrors by the index of a metal
#define HAS_CONDUCTORS 1
#endif
#ifndef HAS_ROUGH_DIFFUSE  // a diffuse lobe is not Lambert's
#define HAS_ROUGH_DIFFUSE 1
#endif
#ifndef HAS_SPECULAR_TEXTURES  // a surface's mirroring varies otherwise than by colour and roughness
#define HAS_SPECULAR_TEXTURES 1
#endif
#ifndef HAS_COAT  // a surface is coated
#define HAS_COAT 1
#endif
#ifndef HAS_BENT_COAT  // … where its own normal is not the surface's
#define HAS_BENT_COAT 1
#endif
#ifndef HAS_ROUGH_GLASS
#define HAS_ROUGH_GLASS 1
#endif
#ifndef HAS_SHEEN  // a surface has the lobe of bsdf/sheen.glsl
#define HAS_SHEEN 1
#endif
#ifndef HAS_THIN  // … or of bsdf/thin.glsl
#define HAS_THIN 1
#endif
#ifndef HAS_TRANSLUCENT  // … or of bsdf/translucent.glsl
#define HAS_TRANSLUCENT 1
#endif
#ifndef HAS_ANISOTROPY  // microfacets of a surface are wider along one direction
#define HAS_ANISOTROPY 1
#endif
#ifndef HAS_FILM  // a thin film lies on a surface
#define HAS_FILM 1
#endif
#ifndef HAS_TRANSMISSION  // light goes through a principled material
#define HAS_TRANSMISSION 1
#endif
#ifndef HAS_PANES  // paths may pass a surface straight
#define HAS_PANES 1
#endif
#ifndef HAS_BENT_NORMALS  // a material has a normal map or bumps
#define HAS_BENT_NORMALS 1
#endif
#ifndef HAS_ALPHA_TEST  // a material has an alpha
#define HAS_ALPHA_TEST 1
#endif
#ifndef HAS_BLEND  // … of alpha_mode "blend"
#define HAS_BLEND 1
#endif
#ifndef HAS_FRONT_ONLY  // a material is not hit from behind
#define HAS_FRONT_ONLY 1
#endif
#ifndef HAS_MEDIA  // light goes through surfaces
#define HAS_MEDIA 1
#endif
#ifndef HAS_DISPERSION  // … and bends the colours of light differently
#define HAS_DISPERSION 1
#endif
#ifndef HAS_ABSORPTION  // a medium takes light away
#define HAS_ABSORPTION 1
#endif
#ifndef HAS_SCATTERING  // … and sends some of it elsewhere
#define HAS_SCATTERING 1
#endif
#ifndef HAS_MEDIUM_EXTENT  // the medium around all is not endless
#define HAS_MEDIUM_EXTENT 1
#endif
#ifndef HAS_LENS  // the camera has one that rays start from
#define HAS_LENS 1
#endif
#ifndef HAS_FILTER  // pixels have one that is no box
#define HAS_FILTER 1
#endif
#ifndef HAS_SECONDARY  // rays are reflected or refracted
#define HAS_SECONDARY 1
#endif
#ifndef HAS_CSG
#define HAS_CSG 1
#endif
#ifndef HAS_DEFERRED_LEAVES  // there are DEFERRED_LEAVES
#define HAS_DEFERRED_LEAVES 1
#endif
#ifndef HAS_MIXED_CSG  // a CSG object's surfaces differ in optical depth
#define HAS_MIXED_CSG 1
#endif
#ifndef HAS_INSTANCES
#define HAS_INSTANCES 1
#endif
#ifndef HAS_DEFERRED_SHAPES  // a BVH holds both DEFERRED_SHAPES and others
#define HAS_DEFERRED_SHAPES 0
#endif
#ifndef MAY_REACH_ITERATION_LIMIT  // a shape may return T_ITERATION_LIMIT
#define MAY_REACH_ITERATION_LIMIT 1
#endif
#ifndef BVH_HOLDS  // (number, primitive): whether the primitive, which is in a BVH, is of that kind
#define BVH_HOLDS(number, primitive) (kind_of(primitive) == number)
#endif
#ifndef BVH_OF_TRIANGLES  // BVHs hold nothing else
#define BVH_OF_TRIANGLES 0
#endif
#ifndef UV_OF  // (name): whether the texture coordinates of that kind of shape count
#define UV_OF(name) true
#endif
// No default; the twin queries its PackedScene.
//   LIGHT_COUNT        how many lights there are
//   EMITTER_COUNT      how many lights and surfaces one is chosen from; 0 where none is.
//   ANY_PANE           true or false: whether paths may pass a surface straight
//   ANY_INTERFACE      true or false: whether one of these may be a border between media of one index.
//   HAS_ENVIRONMENT_LIGHT  true or false: whether one is chosen from the environment.
//   IS_TRANSPARENT     true or false: whether the picture leaves out the background that the eye sees straight.
//   INSTANCE_COUNT     how many instances
//   TRIANGLE_METHOD    TRIANGLE_WOOP or TRIANGLE_MOLLER_TRUMBORE
//   HAS_BVH            true or false: whether there is a BVH of the world
//   QUANTISED_NODES    true or false: how its nodes are coded.
//   KIND_FIRST         (name): the first slot of that kind in no BVH
//   KIND_END           (name): and the end of its slots.
//   KIND_name          the number of a shape, and below, by which KIND_FIRST, KIND_END and UV_OF answer
//   FIRST_name
//   END_name
//   UV_name

// ---- The registries, with the rows alone that the scene needs. Default: rows.h of each ---------------------------
//   SHAPES
//   CLOSED_SHAPES      those that the scene's CSG objects are made of …
//   IMMEDIATE_LEAVES   … of these those that are not deferred (shapes/csg.glsl)
//   DEFERRED_LEAVES    … and those that are.
//   DEFERRED_SHAPES    those that rays wait with for each other (bvh/traverse.glsl)
//   IMMEDIATE_SHAPES   those in BVHs that are not deferred
//   ALPHA_TESTED_SHAPES  those of a material with an alpha.
//   TEXTURES
//   TEXTURES_OF        (name, X): those that materials have as that texture of theirs (MATERIAL_TEXTURES).
//   MATERIALS
//   PANES              those that may be panes
//   LOBES
//   CAMERAS
//   CAMERA_IS          (number): whether that is the frame's.
//   SAMPLERS
//   SAMPLER_IS         (number): whether that is the frame's
//   LIGHTS
//   EMITTERS
//   INTEGRATORS
//   INTEGRATOR_IS      (number): whether that is the frame's

// ---- Formulas -------------------------------------------------------------------------------------------------------
//   FORMULAS              (X): X(number, name) of each surface's; shapes/implicit/*.glsl are included once for each …
//   FORMULA_NAME          … with this to name their functions, (part), …
//   FORMULA_VALUE         … and these to evaluate the formula.
//   FORMULA_HAS_GRADIENT
//   FORMULA_GRADIENT
//   FORMULA_BOUND
//   FORMULA_DUAL
//   FORMULA_COLOR         (number, uv): the result of a colour's formula.
//   FORMULA_DIRECTION     (number, at): the result of a camera's formula …
//   FORMULA_ORIGIN        … and the start of the ray by that formula.
//   FORMULA_OVERRAN       defined where a formula loops: whether one took too many iterations
//   FORMULA_NUMBERS       defined where formulas read their numbers from a buffer

// ---- Compiled-in records: defined or not; the twin has none of it ---------------------------------------------------
//   SHADING_AS_CONSTANTS  materials, textures, media and lights
//   FRAME_AS_CONSTANT     the frame.
//   SCENE_MATERIALS       (X): X(name, index, material) of each
//   SCENE_PRIMITIVES      (X): X(name, slot, primitive) of each, in the order of their ids

// ---- Loops and stacks ------------------------------------------------------------------------------------------------
#ifndef STACK_SIZE  // size of a traversal's stack
#define STACK_SIZE 128
#endif
#ifndef SHIFT_STACK  // whether it stays in registers (bvh/bvh.glsl)
#define SHIFT_STACK 0
#endif
#ifndef PATH_STACK  // paths of a pixel that wait; 0 where no ray splits in two
#define PATH_STACK 64
#endif
#ifndef RANDOM_WALK  // whether paths draw random numbers on their way
#define RANDOM_WALK 1
#endif
#ifndef TRACE_ITERATIONS  // that a ray makes outside BVHs
#define TRACE_ITERATIONS 0u
#endif
//   TUNABLES              constants that eyeray dev lets people move, from a buffer (executors/tunables.hpp).
//   LOOP_PROBE            2, from a buffer (kernels/loops.glsl); kernels/bindings.glsl defines it
//   STOPPED_LOOPS         defined in kernels that may hold a user's shaders: the bit of the loop that was stopped, or 0.
//   LOOP_BUDGET           defined where a driver caps loops: the iterations that a pixel may make (docs/lavapipe.md)

// ---- How the kernel runs ---------------------------------------------------------------------------------------------
#ifndef TEXEL_BUFFERS  // whether records that grow with the scene are in texel buffers (kernels/bindings.glsl)
#define TEXEL_BUFFERS 0
#endif
#ifndef RAY_KINDS  // whether rays are counted by their kinds (records.h, SampleResult)
#define RAY_KINDS 1
#endif
#ifndef SEARCH_COST  // whether first hits contain the cost of their search (records.h, HitResult)
#define SEARCH_COST 1
#endif
#ifndef GROUP_STRIDE  // runs of workgroups (kernels/tile.glsl)
#define GROUP_STRIDE 1u
#endif
#ifndef SUBGROUP_SIZE  // lanes
#define SUBGROUP_SIZE 8
#endif
#ifndef PACKET_ROOT  // node of the BVH that packets traverse
#define PACKET_ROOT 0u
#endif
#ifndef PACKET_STACK  // and their stack
#define PACKET_STACK 1
#endif

// ---- Defines of an executor for one kernel of an entry ---------------------------------------------------------------
#ifndef STORED_HITS  // whether other kernels have traced the paths' rays and their shadow rays
#define STORED_HITS 0
#endif
//   FIRST_HITS            first hits instead of samples
//   AUXILIARY             the denoiser's inputs from the samples (integrators/auxiliary.glsl).
//   SENDS_PHOTONS         photons are sent out and stored, where other kernels gather them.
//   QUERY_ANY             any hit will do
//   LISTED                the pixels of a list
//   ENDS_ONLY             of a wavefront: the paths that go on are only listed.
//   PACKET_PRIMARY        a packet's rays are those of the eye …
//   PACKET_SHADOW         … or those to the lights from their hits.
//   BOUNCE_HITS           kernels/cooperative/bvh4.comp.glsl traces the rays of a bounce …
//   BOUNCE_SHADOW         … or those to the lights from their hits.
//   BVH4_STACK_SIZE       of kernels/cooperative/bvh4.comp.glsl
//   PROBING               the values that shaders PROBE are recorded (kernels/probe.glsl) …
//   PROBE_CAPACITY        … so many of it at most, …
//   PROBED_name           … each name by its number.
//   PROBE                 (name, value), PROBE_RAY, PROBE_BACK: language.h has them empty, kernels/probe.glsl and the twin as they record
//   PROBE_RAY             (kind, number, depth)
//   PROBE_BACK            (depth)

#endif
