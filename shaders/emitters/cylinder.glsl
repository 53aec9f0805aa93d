// x² + z² = 1, |y| ≤ 1 in object space (emitters/object_map.glsl), and the caps.   area = the share of it that the side has
#ifndef EMITTER_CYLINDER_GLSL
#define EMITTER_CYLINDER_GLSL
#include "emitters/object_map.glsl"

SHADER_BEGIN

EmitterSample cylinder_emitter_sample(Emitter e, vec3 from, vec2 u) {
  ObjectMap map = object_map(e);
  bool on_side = u.x < e.area;
  vec2 turned = sine_cosine(2.0f * PI * (u.x / e.area));
  float rest = 2.0f * ((u.x - e.area) / maximum(1.0f - e.area, 1.0e-30f));
  float up = rest < 1.0f ? -1.0f : 1.0f;
  vec2 cap = on_disk(vec2(minimum(rest < 1.0f ? rest : rest - 1.0f, 1.0f), u.y));
  vec3 out_there = on_side ? vec3(turned.y, 0.0f, turned.x) : vec3(0.0f, up, 0.0f);
  EmitterSample point;
  point.p = map_out_of_object(map, on_side ? vec3(turned.y, 2.0f * u.y - 1.0f, turned.x) : vec3(cap.x, up, cap.y));
  point.normal = normalize3(map_normal(map, out_there));
  float about = 0.5f + atan_yx(-turned.x, turned.y) / (2.0f * PI);
  point.uv = on_side ? vec2(about < 1.0f ? about : 0.0f, u.y) : vec2(0.5f + 0.5f * cap.x, 0.5f - 0.5f * cap.y * up);
  return point;
}

float cylinder_emitter_density(Emitter e, vec3 from, EmitterSample point) {
  ObjectMap map = object_map(e);
  vec3 own = normal_in_object(map, point.normal);
  float outward = maximum(sqrt(own.x * own.x + own.z * own.z), 1.0e-30f);
  vec3 along = map.x * (-own.z / outward) + map.z * (own.x / outward);
  vec3 across = cross3(along, map.y);
  float of_side = e.area * density_of_area(4.0f * PI * sqrt(dot3(across, across)), from, point);
  float of_cap = 0.5f * (1.0f - e.area) * density_of_area(PI * sqrt(dot3(map.across_y, map.across_y)), from, point);
  return abs(own.y) > 0.7f ? of_cap : of_side;
}

SHADER_END
#endif
