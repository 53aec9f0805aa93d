// Instances of meshes and groups: into their space and back.
#ifndef INSTANCE_GLSL
#define INSTANCE_GLSL
#include "geometry/ray.glsl"
#include "records.h"

SHADER_BEGIN

// A ray in the space where it is traced: world space, or that of an instance.
struct LocalRay {
  Ray ray;
  uint instance;        // NONE in the world
  uint first_id;        // to be added to the id of a primitive, …
  uint first_triangle;  // … or this, to that of a triangle of a group's meshes
  uint optical_depth;         // by which each primitive weakens a shadow ray; NONE where they set it themselves
};

LocalRay world_ray(Ray ray) {
  LocalRay local;
  local.ray = ray;
  local.instance = NONE;
  local.first_id = 0u;
  local.first_triangle = 0u;
  local.optical_depth = NONE;
  return local;
}

uint id_of(LocalRay local, Primitive primitive) {
#if HAS_INSTANCES
  uint id = primitive.id & ~ID_OF_TRIANGLE;
  return (primitive.id & ID_OF_TRIANGLE) != 0u ? local.first_triangle + id : local.first_id + id;
#else
  return primitive.id;
#endif
}

#if HAS_INSTANCES
vec3 map_direction(vec4 rows[3], vec3 d) { return vec3(dot3(vec3(rows[0]), d), dot3(vec3(rows[1]), d), dot3(vec3(rows[2]), d)); }
vec3 map_offset(vec4 rows[3]) { return vec3(rows[0].w, rows[1].w, rows[2].w); }
vec3 map_size(vec4 rows[3], vec3 size) {
  return vec3(dot3(abs3(vec3(rows[0])), size), dot3(abs3(vec3(rows[1])), size), dot3(abs3(vec3(rows[2])), size));
}
// By rows as columns: maps normals, when `rows` is the inverse map.
vec3 transposed(vec4 rows[3], vec3 n) { return vec3(rows[0]) * n.x + vec3(rows[1]) * n.y + vec3(rows[2]) * n.z; }

// The direction keeps its length in the instance's space, so that t stays the same. The difference comes first: near the instance it is exact
// or nearly so.
LocalRay into_instance(Ray ray, Instance instance, uint index) {
  LocalRay local;
  local.ray = continue_ray(ray, map_direction(instance.to_local, ray.o - map_offset(instance.to_world)),
                           map_direction(instance.to_local, ray.d));
  vec3 offset = abs3(map_offset(instance.to_world));
  local.ray.reach = max_component(map_size(instance.to_local, abs3(ray.o) + (offset + offset)));
  local.instance = index;
  local.first_id = instance.first_id;
  local.first_triangle = first_triangle_of(instance);
  local.optical_depth = mesh_optical_depth(instance);
  return local;
}

// The surface in the world. A step of its offset across it is as long as the map makes it; to that come the errors of the way out and of a
// next ray's way back in.
Surface out_of_instance(Surface surface, Instance instance) {
  Surface world = surface;
  world.p = map_direction(instance.to_world, surface.p) + map_offset(instance.to_world);
  vec3 across = transposed(instance.to_local, surface.normal_geometric);
  float shrinks = sqrt(dot3(across, across));
  world.normal_geometric = across / shrinks;
  vec3 shading = transposed(instance.to_local, surface.normal);
  world.normal = normalize3(shading);
#if HAS_SMOOTH
  world.lift = surface.lift / sqrt(dot3(shading, shading));
#endif
  vec3 tangent = map_direction(instance.to_world, vec3(surface.tangent));
  float turned = dot3(vec3(instance.to_world[0]), cross3(vec3(instance.to_world[1]), vec3(instance.to_world[2])));
  set_gradients(world, transposed(instance.to_local, surface.u_gradient), transposed(instance.to_local, surface.v_gradient));
  world.tangent = vec4(tangent.x, tangent.y, tangent.z, turned < 0.0f ? -surface.tangent.w : surface.tangent.w);
#if HAS_SECOND_UV
  world.second_u_gradient = transposed(instance.to_local, surface.second_u_gradient);
  world.second_v_gradient = transposed(instance.to_local, surface.second_v_gradient);
  vec3 second = map_direction(instance.to_world, vec3(surface.second_tangent));
  world.second_tangent = vec4(second.x, second.y, second.z, turned < 0.0f ? -surface.second_tangent.w : surface.second_tangent.w);
#endif
  vec3 local = abs3(surface.p) + map_size(instance.to_local, abs3(world.p - map_offset(instance.to_world)));
  vec3 reach = map_size(instance.to_world, local) + (abs3(world.p) + abs3(map_offset(instance.to_world)));
  world.inward = map_direction(instance.to_world, surface.inward);
  world.offset = surface.offset / shrinks + 8.0f * EPSILON * dot3(abs3(world.normal_geometric), reach);
  return world;
}
#endif

SHADER_END
#endif
