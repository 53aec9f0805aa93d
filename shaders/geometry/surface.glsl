// From a hit to the surface there: calls the shape that was hit, and brings an instance's into the world.
#ifndef SURFACE_GLSL
#define SURFACE_GLSL
#include "geometry/clear_of_planes.glsl"
#include "geometry/instance.glsl"
#include "geometry/lift.glsl"
#include "geometry/ray.glsl"
#if HAS_BENT_NORMALS
#include "materials/bent_normal.glsl"
#endif
#include "records.h"

SHADER_BEGIN

// The primitive that was hit, with the material that it has there.
Primitive primitive_at(Hit hit) {
  Primitive primitive = load_primitive(hit.slot);
#if HAS_INSTANCES
  if (hit.instance != NONE) {
    Instance instance = load_instance(hit.instance);
    if (!of_group(instance)) primitive.material_and_kind = material_and_kind(instance.material, kind_of(primitive));
  }
#endif
#if HAS_CSG
  if (kind_of(primitive) == KIND_csg)
    primitive.material_and_kind = material_and_kind(material_of(csg_leaf(primitive, hit)), KIND_csg);
#endif
  return primitive;
}

Surface surface_at(Primitive primitive, Ray ray, Hit hit) {
  Surface surface = no_surface();
  Ray local = ray;
#if HAS_INSTANCES
  if (hit.instance != NONE) local = into_instance(ray, load_instance(hit.instance), hit.instance).ray;
#endif
#define SURFACE_OF(name, number) \
  if (kind_of(primitive) == number) surface = name##_surface(primitive, local, hit);
  SHAPES(SURFACE_OF)
#if HAS_SECOND_UV
  surface.second_uv = second_uv(primitive, hit, surface.uv);
#endif
#if HAS_SMOOTH
  surface.lift = lift_of(primitive, hit.uv);
#endif
#if HAS_INSTANCES
  if (hit.instance != NONE) surface = out_of_instance(surface, load_instance(hit.instance));
#endif
  surface = clear_of_planes(surface, ray, hit.slot);
  // Here and in no other space: a stretch may take an interpolated normal to the other side, and back again.
  bool turned = !(dot3(surface.normal, surface.normal_geometric) > 0.0f);
  if (turned) surface.normal = surface.normal_geometric;
#if HAS_SMOOTH
  bool lifts = !turned && surface.lift.x >= 0.0f;
  surface.normal_side = lifts ? surface.normal : surface.normal_geometric;
  surface.lift = lifts ? bounded_lift(surface.lift, primitive, hit.instance) : vec2(-1.0f, -1.0f);
#endif
#if HAS_BENT_NORMALS
  surface = bent_surface(material_of(primitive), surface, ray.d);
#endif
  return surface;
}

// The surface as its viewer sees it: normals towards where the ray came from.
Surface face_viewer(Surface surface, bool front) {
  Surface seen = surface;
  seen.normal_geometric = front ? surface.normal_geometric : -surface.normal_geometric;
  seen.normal = front ? surface.normal : -surface.normal;
#if HAS_SMOOTH
  seen.normal_side = front ? surface.normal_side : -surface.normal_side;
  seen.lift = front ? surface.lift : vec2(surface.lift.y, surface.lift.x);
#endif
#if HAS_BENT_COAT
  seen.coat_normal = front ? surface.coat_normal : -surface.coat_normal;
#endif
  return seen;
}

SHADER_END
#endif
