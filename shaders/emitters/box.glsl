// |x|, |y|, |z| ≤ 1 in object space (emitters/object_map.glsl).
#ifndef EMITTER_BOX_GLSL
#define EMITTER_BOX_GLSL
#include "emitters/object_map.glsl"
#include "geometry/cube.glsl"

SHADER_BEGIN

// The faces that a point may choose from: of each axis the one that is turned to it; within the box both, as likely as each other.
struct BoxFaces {
  vec3 weight;  // weight of each axis; from outside area · cosine / distance² of the face's centre, up to a factor
  vec3 side;
  bool inside;
};

float box_face_weight(ObjectMap map, float beyond, vec3 arm, vec3 from) {
  vec3 way = map.center + arm - from;
  float squared = dot3(way, way);
  return maximum(beyond, 0.0f) / (squared * sqrt(squared));
}

BoxFaces box_faces(ObjectMap map, vec3 from) {
  vec3 q = map_into_object(map, from - map.center);
  // A point on the box is not outside, however it is rounded.
  vec3 beyond = abs3(q) - vec3(1.0002f, 1.0002f, 1.0002f);
  BoxFaces faces;
  faces.side = vec3(q.x < 0.0f ? -1.0f : 1.0f, q.y < 0.0f ? -1.0f : 1.0f, q.z < 0.0f ? -1.0f : 1.0f);
  faces.inside = max_component(beyond) <= 0.0f;
  faces.weight = vec3(box_face_weight(map, beyond.x, map.x * faces.side.x, from), box_face_weight(map, beyond.y, map.y * faces.side.y, from),
                      box_face_weight(map, beyond.z, map.z * faces.side.z, from));
  if (faces.inside)
    faces.weight = vec3(sqrt(dot3(map.across_x, map.across_x)), sqrt(dot3(map.across_y, map.across_y)), sqrt(dot3(map.across_z, map.across_z)));
  return faces;
}

EmitterSample box_emitter_sample(Emitter e, vec3 from, vec2 u) {
  ObjectMap map = object_map(e);
  BoxFaces faces = box_faces(map, from);
  vec3 weight = faces.weight;
  float at = u.x * ((weight.x + weight.y) + weight.z);
  bool is_x = at < weight.x;
  bool is_y = !is_x && (at < weight.x + weight.y || weight.z == 0.0f);
  float before = is_x ? 0.0f : is_y ? weight.x : weight.x + weight.y;
  float taken = is_x ? weight.x : is_y ? weight.y : weight.z;
  float right = minimum(maximum((at - before) / maximum(taken, 1.0e-38f), 0.0f), 1.0f);
  float side = is_x ? faces.side.x : is_y ? faces.side.y : faces.side.z;
  if (faces.inside) {
    side = right < 0.5f ? -1.0f : 1.0f;
    right = right < 0.5f ? 2.0f * right : 2.0f * right - 1.0f;
  }
  float h = 2.0f * right - 1.0f;
  float v = 2.0f * u.y - 1.0f;
  vec3 p = is_x ? vec3(side, h, v) : is_y ? vec3(h, side, v) : vec3(h, v, side);
  vec2 face = vec2(is_x ? 0.0f : is_y ? 1.0f : 2.0f, side);
  EmitterSample point;
  point.p = map_out_of_object(map, p);
  point.normal = normalize3(map_normal(map, cube_normal(face)));
  point.uv = cube_uv(p, face).uv;
  return point;
}

float box_emitter_density(Emitter e, vec3 from, EmitterSample point) {
  ObjectMap map = object_map(e);
  BoxFaces faces = box_faces(map, from);
  vec3 area = vec3(sqrt(dot3(map.across_x, map.across_x)), sqrt(dot3(map.across_y, map.across_y)), sqrt(dot3(map.across_z, map.across_z)));
  // The face by its normal, and from outside by its side.
  float x = abs(dot3(map.across_x, point.normal)) / area.x;
  float y = abs(dot3(map.across_y, point.normal)) / area.y;
  float z = abs(dot3(map.across_z, point.normal)) / area.z;
  bool is_x = x >= y && x >= z;
  bool is_y = !is_x && y >= z;
  float its_area = is_x ? area.x : is_y ? area.y : area.z;
  float weight = is_x ? faces.weight.x : is_y ? faces.weight.y : faces.weight.z;
  float side = is_x ? faces.side.x : is_y ? faces.side.y : faces.side.z;
  vec3 q = map_into_object(map, point.p - map.center);
  bool turned = (is_x ? q.x : is_y ? q.y : q.z) * side > 0.0f;
  float sum = (faces.weight.x + faces.weight.y) + faces.weight.z;
  float share = faces.inside ? 0.5f * weight / sum : turned ? weight / sum : 0.0f;
  return share * density_of_area(4.0f * its_area, from, point);
}

SHADER_END
#endif
