// The media that a ray is inside of: a stack of up to four medium numbers, a byte each, the innermost lowest. 0 is the medium
// around all. Entering pushes and leaving removes wherever it lies, so media may overlap as well as nest.
#ifndef MEDIA_GLSL
#define MEDIA_GLSL
#include "language.h"
#include "records.h"

SHADER_BEGIN

uint innermost_medium(uint media) { return media & 0xffu; }

uint enter_medium(uint media, uint medium, INOUT(uint) flags) {
  bool full = (media >> 24u) != 0u;
  flags = full ? flags | FLAG_MEDIA_OVERFLOW : flags;
  return full ? media : (media << 8u) | medium;
}

// Without the innermost occurrence of `medium`; unchanged when it is not there.
uint leave_medium(uint media, uint medium) {
  if ((media & 0xffu) == medium) return media >> 8u;
  if (((media >> 8u) & 0xffu) == medium) return (media & 0xffu) | ((media >> 8u) & 0xffffff00u);
  if (((media >> 16u) & 0xffu) == medium) return (media & 0xffffu) | ((media >> 8u) & 0xffff0000u);
  if ((media >> 24u) == medium) return media & 0xffffffu;
  return media;
}

SHADER_END
#endif
