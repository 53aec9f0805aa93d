// Leaves the primitive's id where it is the nearest, for the triangles of `eyeray verify --raster`.
#version 450

layout(location = 0) flat in uint drawn;
layout(location = 0) out uint id;

void main() {
  id = drawn;
}
