// A step of bodies that attract each other.
#version 450
layout(local_size_x = 64) in;
struct Body {
  vec3 position;
  float mass;
  vec3 velocity;
};
layout(std430, binding = 0) readonly buffer Before { Body before[]; };
layout(std430, binding = 1) writeonly buffer After { Body after[]; };
layout(push_constant) uniform Step { float seconds; float softening; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  Body body = before[i];
  vec3 acceleration = vec3(0);
  for (uint k = 0; k < before.length(); ++k) {
    const vec3 to = before[k].position - body.position;
    const float distance2 = dot(to, to) + softening;
    acceleration += before[k].mass / (distance2 * sqrt(distance2)) * to;
  }
  body.velocity += seconds * acceleration;
  body.position += seconds * body.velocity;
  after[i] = body;
}
