// Instances of meshes: into a mesh's space and back.
#ifndef INSTANCE_GLSL
#define INSTANCE_GLSL
#include "ray.glsl"
#include "records.h"

SHADER_BEGIN

// Where a ray is being traced: in the world, or in the mesh of an instance.
struct Place {
  Ray ray;
  uint instance;  // NONE in the world
  uint first_id;  // to be added to the id of a primitive
  uint density;   // what an instance's triangles weaken a shadow ray by
};

Place in_world(Ray ray) {
  Place place;
  place.ray = ray;
  place.instance = NONE;
  place.first_id = 0u;
  place.density = 0u;
  return place;
}

#if HAS_INSTANCES
vec3 map_direction(vec4 rows[3], vec3 d) { return vec3(dot3(vec3(rows[0]), d), dot3(vec3(rows[1]), d), dot3(vec3(rows[2]), d)); }
vec3 map_offset(vec4 rows[3]) { return vec3(rows[0].w, rows[1].w, rows[2].w); }
vec3 map_size(vec4 rows[3], vec3 size) {
  return vec3(dot3(abs3(vec3(rows[0])), size), dot3(abs3(vec3(rows[1])), size), dot3(abs3(vec3(rows[2])), size));
}
// Rows as columns: what maps normals, when `rows` is the inverse map.
vec3 map_normal(vec4 rows[3], vec3 n) {
  return normalize3(vec3(rows[0]) * n.x + vec3(rows[1]) * n.y + vec3(rows[2]) * n.z);
}

// The direction keeps its length in the mesh's space, so that t stays the same.
Place into_instance(Ray ray, Instance instance, uint index) {
  Place place;
  place.ray = make_ray(map_direction(instance.to_mesh, ray.o) + map_offset(instance.to_mesh),
                       map_direction(instance.to_mesh, ray.d));
  place.instance = index;
  place.first_id = instance.head.y;
  place.density = instance.head.w;
  return place;
}

// The surface in the world. Its offset covers the errors of the way out and of a next ray's way back in.
Surface out_of_instance(Surface surface, Instance instance, Tree tree) {
  Surface world = surface;
  world.p = map_direction(instance.to_world, surface.p) + map_offset(instance.to_world);
  world.normal_geometric = map_normal(instance.to_mesh, surface.normal_geometric);
  world.normal = map_normal(instance.to_mesh, surface.normal);
  vec3 in_mesh = vec3(tree.reach) * 3.0f + map_size(instance.to_mesh, abs3(world.p)) +
                 abs3(map_offset(instance.to_mesh));
  vec3 reach = map_size(instance.to_world, in_mesh) + abs3(map_offset(instance.to_world));
  world.offset = 8.0f * EPSILON * dot3(abs3(world.normal_geometric), reach);
  return world;
}
#endif

SHADER_END
#endif
