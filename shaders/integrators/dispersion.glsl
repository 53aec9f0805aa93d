// Glass whose index of refraction depends on the colour (KHR_materials_dispersion). A path that hits it goes on with the light of one
// channel, chosen in proportion to the light left in each. So a path of one channel alone has made that choice.
#ifndef DISPERSION_GLSL
#define DISPERSION_GLSL
#include "integrators/continuation.glsl"
#include "materials/media.glsl"
#include "samplers/sampler.glsl"

SHADER_BEGIN

#if HAS_DISPERSION
// −1 for red light, 1 for blue light, else 0.
float hue_of(vec3 light) {
  bool red = light.x > 0.0f && light.y == 0.0f && light.z == 0.0f;
  bool blue = light.z > 0.0f && light.x == 0.0f && light.y == 0.0f;
  return red ? -1.0f : blue ? 1.0f : 0.0f;
}
#endif

// The index of the innermost medium for a path that has so much light left in each channel.
float index_of_medium(uint media, vec3 light) {
  Medium medium = load_medium(innermost_medium(media));
  float ior = medium.ior;
#if HAS_DISPERSION
  ior = ior + hue_of(light) * medium.spread;
#endif
  return ior;
}

#if HAS_DISPERSION
bool disperses(uint medium) { return load_medium(medium).spread > 0.0f; }

// The path with the channel chosen, if the surface there bounds a medium that disperses light: the innermost, the one below, or its own.
Path dispersed(Frame frame, Path path, uint medium) {
  if (medium != 0u && (disperses(medium) || disperses(innermost_medium(path.media)) || disperses(innermost_medium(path.media >> 8u)))) {
    vec3 light = path.throughput;
    float all = light.x + light.y + light.z;
    float random = sample_pair(frame, path.pixel, path.index, PAIR_CHANNEL).x * all;
    bool red = random < light.x;
    bool green = !red && random < light.x + light.y;
    path.throughput = vec3(red ? all : 0.0f, green ? all : 0.0f, red || green ? 0.0f : all);
  }
  return path;
}
#endif

SHADER_END
#endif
