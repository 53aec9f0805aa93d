// Every kind of texture; see shapes/rows.h. A row states whether the texture varies over a surface.
#ifndef TEXTURES
#define TEXTURES(X)      \
  X(constant, 0u, false) \
  X(checker, 1u, true)   \
  X(image, 2u, true)     \
  X(formula, 3u, true)   \
  X(gradient, 4u, true) \
  X(solid_checker, 5u, true) \
  X(brick, 6u, true) \
  X(marble, 7u, true) \
  X(wood, 8u, true) \
  X(noise, 9u, true) \
  X(cells, 10u, true)
#endif
