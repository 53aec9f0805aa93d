// Every kind of material; see shapes/rows.h.
#ifndef MATERIALS
#define MATERIALS(X) \
  X(phong, 0u)       \
  X(mirror, 1u)      \
  X(dielectric, 2u)  \
  X(diffuse, 3u)     \
  X(conductor, 4u)   \
  X(plastic, 5u)     \
  X(principled, 6u)
#endif

// The kinds of materials that may be panes.
#ifndef PANES
#define PANES(X)    \
  X(dielectric, 2u) \
  X(principled, 6u)
#endif

// The textures of a material, as its record names them.
#ifndef MATERIAL_TEXTURES
#define MATERIAL_TEXTURES(X) \
  X(base)                    \
  X(specular)                \
  X(reflected)               \
  X(ambient)                 \
  X(emission)                \
  X(color)                   \
  X(roughness)               \
  X(metallic)                \
  X(coat)                    \
  X(coat_roughness)          \
  X(specular_level)          \
  X(transmission)            \
  X(specular_color)          \
  X(sheen)                   \
  X(sheen_roughness)         \
  X(normal_map)              \
  X(bump)                    \
  X(coat_normal)             \
  X(diffuse_transmission)    \
  X(diffuse_transmission_color) \
  X(anisotropy)              \
  X(anisotropy_direction)    \
  X(iridescence)             \
  X(iridescence_thickness)   \
  X(alpha)
#endif
