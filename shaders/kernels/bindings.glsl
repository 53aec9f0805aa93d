// The buffers, which the entries share.
// Those that grow with the scene, and the frame, are texel buffers where TEXEL_BUFFERS is set: a storage buffer's range can be as small
// as 128 MiB, and a CPU driver loads texels faster.
#ifndef BINDINGS_GLSL
#define BINDINGS_GLSL
#include "records.h"
#ifdef PROBING
layout(std430, binding = BINDING_PROBE) writeonly restrict buffer ProbeRecords { ProbeRecord probe_records[]; };
#include "kernels/probe.glsl"
#endif
#ifdef TUNABLES
layout(std430, binding = BINDING_TUNABLES) readonly restrict buffer Tunables { vec4 tunables[]; };
#endif
#ifdef FORMULA_NUMBERS
layout(std430, binding = BINDING_FORMULA_NUMBERS) readonly restrict buffer FormulaNumbers { uint formula_numbers[]; };
#endif

layout(push_constant) uniform PushConstants { Dispatch dispatch; };
#if TEXEL_BUFFERS
layout(rgba32ui, binding = BINDING_PRIMITIVES) readonly restrict uniform uimageBuffer primitives;
layout(rgba32ui, binding = BINDING_VERTICES) readonly restrict uniform uimageBuffer vertices;
layout(rgba32ui, binding = BINDING_NODES) readonly restrict uniform uimageBuffer nodes;
layout(rgba32ui, binding = BINDING_TEXELS) readonly restrict uniform uimageBuffer texels;
layout(rgba32ui, binding = BINDING_ENVIRONMENT) readonly restrict uniform uimageBuffer environment;
layout(rgba32ui, binding = BINDING_FRAME) readonly restrict uniform uimageBuffer frame_words;
#define LOOP_PROBE imageLoad(frame_words, 2).y
#define FRAME_SEED imageLoad(frame_words, 0).z
#else
layout(std430, binding = BINDING_PRIMITIVES) readonly restrict buffer Primitives { Primitive primitives[]; };
layout(std430, binding = BINDING_VERTICES) readonly restrict buffer Vertices { uvec4 vertices[]; };
layout(std430, binding = BINDING_NODES) readonly restrict buffer Nodes { uvec4 nodes[]; };
layout(std430, binding = BINDING_TEXELS) readonly restrict buffer Texels { uint texels[]; };
layout(std430, binding = BINDING_ENVIRONMENT) readonly restrict buffer EnvironmentBuffer { uvec4 environment[]; };
layout(std430, binding = BINDING_FRAME) readonly restrict buffer FrameBuffer { Frame frame_record; };
#define LOOP_PROBE frame_record.loop_probe
#define FRAME_SEED frame_record.seed
#endif
#if STORED_HITS
// The results of kernels/cooperative/packet.comp.glsl for this sample: the camera rays' hits, and the loss of each light there.
layout(std430, binding = BINDING_PACKET_HITS) readonly restrict buffer PacketHits { PacketHit packet_hits[]; };
layout(std430, binding = BINDING_OCCLUSIONS) readonly restrict buffer Occlusions { uint occlusions[]; };
#endif
layout(std430, binding = BINDING_BVHS) readonly restrict buffer Bvhs { Bvh bvhs[]; };
layout(std430, binding = BINDING_INSTANCES) readonly restrict buffer Instances { Instance instances[]; };
layout(std430, binding = BINDING_MATERIALS) readonly restrict buffer Materials { Material materials[]; };
layout(std430, binding = BINDING_TEXTURES) readonly restrict buffer Textures { Texture textures[]; };
layout(std430, binding = BINDING_MEDIA) readonly restrict buffer Media { Medium media[]; };
layout(std430, binding = BINDING_LIGHTS) readonly restrict buffer Lights { Light lights[]; };
layout(std430, binding = BINDING_EMITTERS) readonly restrict buffer Emitters { Emitter emitters[]; };
#if HAS_LIGHT_BVH
layout(std430, binding = BINDING_LIGHT_NODES) readonly restrict buffer LightNodes { LightNode light_nodes[]; };
#endif
#if HAS_PHOTONS
layout(std430, binding = BINDING_PHOTON_PASS) readonly restrict buffer PhotonPassBuffer { PhotonPass photon_pass; };
layout(std430, binding = BINDING_EMITTER_MEDIA) readonly restrict buffer EmitterMedia { uint emitter_media[]; };
#ifdef SENDS_PHOTONS
layout(std430, binding = BINDING_PHOTONS) writeonly restrict buffer Photons { Photon photons[]; };
// The number of photons stored, or that would be stored if all had room.
layout(std430, binding = BINDING_NEXT_LIST) restrict buffer NextList { uint next_list[]; };
#else
layout(std430, binding = BINDING_PHOTONS) readonly restrict buffer Photons { Photon photons[]; };
layout(std430, binding = BINDING_PHOTON_CELLS) readonly restrict buffer PhotonCells { uint photon_cells[]; };
#endif
#endif
#if RANDOM_WALK
layout(std430, binding = BINDING_ALBEDOS) readonly restrict buffer Albedos { vec4 albedos[]; };
#endif

#endif
