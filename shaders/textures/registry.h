// Every kind of texture; see shapes/registry.h. A row says whether the texture varies over a surface.
#ifndef TEXTURES
#define TEXTURES(X)      \
  X(constant, 0u, false) \
  X(checker, 1u, true)   \
  X(image, 2u, true)     \
  X(formula, 3u, true)
#endif
