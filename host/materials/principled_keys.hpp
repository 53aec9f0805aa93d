// The manual pages and the keys of `principled` and `plastic`. Private to principled.cpp.
#pragma once

#include <string_view>

#include "host/materials/medium_keys.hpp"
#include "host/materials/physical.hpp"
#include "host/materials/registry.hpp"

namespace eyeray::engine::materials {

inline constexpr std::string_view principled_manual =
    R"(The metallic-roughness model of glTF 2.0, which models come with. It is a coloured body under a clear, glossy
surface, a metal of that colour, or a blend of both. It may transmit light, and cloth and lacquer may lie on
top. A thin film may colour its reflections. Brushing may lengthen its highlights. Its body may let light through
evenly.

```toml
[[material]]
name = "car"
type = "principled"
color = [0.6, 0.02, 0.03]
metallic = 0.6
roughness = 0.4
coat = 1
```

The non-metal part reflects F0 = ((ior − 1) / (ior + 1))² · specular_color · specular at perpendicular
incidence, and `specular` at grazing incidence. A metal reflects `color` at perpendicular incidence, and white
at grazing incidence (Schlick). Microfacets are as in `conductor`.

Light that enters the non-metal part hits a Lambert body of `color`, and leaves through the surface again. The
share `transmission` of it passes through instead, tinted by `color`. It is refracted as in `dielectric` and
fills the shape. The surface of that share reflects by `ior` alone. Where the index is the same on both
sides, it continues straight, as in `dielectric`. Rough glass of a high `ior` is noisy, since it reflects most
light inside many times. With `thin` the light passes straight through, blurred by `roughness`. A coat has
index 1.5. Sheen is a layer of fibres of `sheen_color` above the body, as cloth has them. `whitted` and
`raycast` show an approximation: glass where `transmission` is 0.5 or more, and nothing of anisotropy,
iridescence, dispersion or diffuse transmission.

A film does not change the share that is glass, whose surface reflects by `ior` alone. With `dispersion` a
path that hits the glass continues with the light of one colour channel, chosen at random. Red is refracted by the index
of the C line, green by that of the d line, and blue by that of the F line.

**Source.** Khronos: glTF 2.0 Specification, appendix B; KHR_materials_ior, _specular, _clearcoat, _sheen, _transmission, _volume,
_diffuse_transmission, _anisotropy, _iridescence, _dispersion. Belcour, Barla: A Practical Extension to Microfacet Theory
for the Modeling of Varying Iridescence, TOG 2017. Kelemen,
Szirmay-Kalos: A Microfacet Based Coupled Specular-Matte BRDF Model, Eurographics 2001. Estevez, Kulla: Production Friendly Microfacet
Sheen BRDF, SIGGRAPH 2017.
)";

inline constexpr std::string_view plastic_manual =
    R"(A coloured body under a clear surface, rough or polished: plastic, lacquer, glazed clay. It is `principled`
without a metal part.

```toml
[[material]]
name = "bowl"
type = "plastic"
color = [0.1, 0.3, 0.7]
roughness = 0.1
```
)";

inline constexpr Key color_key{
    .name = "color",
    .type = KeyType::texture,
    .doc = "Colour of the body. For a metal it is the reflectance at perpendicular incidence.",
    .fallback = "0.8",
    .max = 1};
inline constexpr Key ior_key{.name = "ior",
                             .type = KeyType::number,
                             .doc = "Index of refraction of the surface.",
                             .fallback = "1.5",
                             .min = 1,
                             .max = 4};

inline constexpr Key principled_keys[] = {
    color_key,
    {.name = "metallic",
     .type = KeyType::texture,
     .doc = "Share of the surface that is metal. The blue channel counts.",
     .fallback = "0",
     .max = 1},
    roughness_key,
    ior_key,
    {.name = "specular",
     .type = KeyType::texture,
     .doc = "Factor for the reflectance of the non-metal part. The red channel counts.",
     .fallback = "1",
     .max = 1},
    {.name = "specular_color",
     .type = KeyType::texture,
     .doc = "Tint of the reflectance of the non-metal part at perpendicular incidence.",
     .fallback = "1"},
    {.name = "transmission",
     .type = KeyType::texture,
     .doc = "Share of light that is transmitted, of the light that the non-metal part does not reflect. The "
            "red channel counts.",
     .fallback = "0",
     .max = 1},
    {.name = "thin",
     .type = KeyType::boolean,
     .doc = "If true, the part that transmits light is a pane without an inside: a window, a leaf, a bubble.",
     .fallback = "false"},
    {.name = "absorption",
     .type = KeyType::color,
     .doc =
         "Absorption coefficient per world unit: inside, light is weakened by exp(-absorption * distance).",
     .fallback = "0"},
    dispersion_key,
    {.name = "diffuse_transmission",
     .type = KeyType::texture,
     .doc = "Share of the body's light that comes through it evenly, to the other side, as in paper and in "
            "leaves. The red channel counts.",
     .fallback = "0",
     .max = 1},
    {.name = "diffuse_transmission_color",
     .type = KeyType::texture,
     .doc = "Colour of the light that comes through evenly.",
     .fallback = "1",
     .max = 1},
    {.name = "anisotropy",
     .type = KeyType::texture,
     .doc =
         "How much rougher the surface is along one direction than across it, from 0 to 1, as brushed metal "
         "is: highlights grow long along this direction. The blue channel counts.",
     .fallback = "0",
     .max = 1},
    {.name = "anisotropy_rotation",
     .type = KeyType::number,
     .doc = "Angle in degrees by which that direction is rotated, from u to v.",
     .fallback = "0",
     .min = -360,
     .max = 360},
    {.name = "anisotropy_direction",
     .type = KeyType::texture,
     .doc = "Map of directions, as in glTF: the red channel is along u, and the green one along v, from -1 "
            "to 1. "
            "Without this map the direction is that of u.",
     .max = 1,
     .optional = true},
    {.name = "iridescence",
     .type = KeyType::texture,
     .doc =
         "Share of the surface that a thin film covers: a soap bubble, oil on water, heated steel. The red "
         "channel counts.",
     .fallback = "0",
     .max = 1},
    {.name = "iridescence_ior",
     .type = KeyType::number,
     .doc = "Index of refraction of the film.",
     .fallback = "1.3",
     .min = 1,
     .max = 4},
    {.name = "iridescence_thickness",
     .type = KeyType::number,
     .doc = "Thickness of the film in nanometres.",
     .fallback = "400",
     .min = 0,
     .max = 10000},
    {.name = "iridescence_thickness_map",
     .type = KeyType::texture,
     .doc =
         "Map of the thickness, from `iridescence_thickness_least` at 0 to `iridescence_thickness` at 1. The "
         "green channel counts.",
     .max = 1,
     .optional = true},
    {.name = "iridescence_thickness_least",
     .type = KeyType::number,
     .doc = "Thickness of the film in nanometres at which `iridescence_thickness_map` begins.",
     .fallback = "100",
     .min = 0,
     .max = 10000},
    {.name = "sheen_color",
     .type = KeyType::texture,
     .doc = "Colour of the fibres above the body; black means no fibres.",
     .fallback = "0",
     .max = 1},
    {.name = "sheen_roughness",
     .type = KeyType::texture,
     .doc = "Spread of the directions of the fibres: from 0 (sheen only at grazing angles) to 1 (all "
            "directions). The green channel counts. Values below 0.07 are raised to 0.07.",
     .fallback = "0.5",
     .max = 1},
    {.name = "coat",
     .type = KeyType::texture,
     .doc = "Share of the surface that a clear coat covers. The red channel counts.",
     .fallback = "0",
     .max = 1},
    {.name = "coat_roughness",
     .type = KeyType::texture,
     .doc = "Roughness of the coat. The green channel counts.",
     .fallback = "0",
     .max = 1},
    {.name = "coat_normal",
     .type = KeyType::texture,
     .doc = "Normal map of the coat, in the form of `normal`. Neither `normal` nor `bump` bends the coat.",
     .max = 1,
     .optional = true},
    {.name = "coat_normal_scale",
     .type = KeyType::number,
     .doc = "Strength of `coat_normal`. A negative value bends the normals in the opposite direction.",
     .fallback = "1",
     .min = -1000,
     .max = 1000},
    emission_key,
};

inline constexpr Key plastic_keys[] = {color_key, roughness_key, ior_key, emission_key};

}  // namespace eyeray::engine::materials
