// The start of the paths of a tile's pixels, for entries that trace camera rays before others shade them.
#ifndef EYE_PATH_GLSL
#define EYE_PATH_GLSL
#include "kernels/pixel.glsl"

// The sample's path through the pixel at `slot` of the tile. Where the camera sees nothing there is a ray all the same, whose hit is
// not used.
Path eye_path(uint slot) {
  uint row = quotient(slot, dispatch.tile_width);
  uint x = dispatch.tile_x + (slot - row * dispatch.tile_width) * dispatch.stride;
  uint y = dispatch.tile_y + row * dispatch.stride;
  Frame frame = load_frame();
  Ray ray;
  camera_ray(frame, x, y, dispatch.sample_index, ray);
  return begin(frame, ray, y * frame.width + x, dispatch.sample_index);
}

#endif
