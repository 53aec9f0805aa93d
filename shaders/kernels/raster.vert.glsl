// Moves a vertex to the point where the host has projected it, in float64, for the triangles of `eyeray verify --raster`.
#version 450

layout(location = 0) in vec3 position;
layout(location = 1) in uint id;
layout(location = 0) flat out uint drawn;

void main() {
  gl_Position = vec4(position, 1.0);
  drawn = id;
}
