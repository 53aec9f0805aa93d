// The packed records, as the shaders see them: namespace eyeray::shader.
#pragma once

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#include "shaders/records.h"
#pragma GCC diagnostic pop
#include "shaders/bsdf/registry.h"
#include "shaders/cameras/registry.h"
#include "shaders/emitters/registry.h"
#include "shaders/integrators/registry.h"
#include "shaders/lights/registry.h"
#include "shaders/materials/registry.h"
#include "shaders/samplers/registry.h"
#include "shaders/shapes/registry.h"
#include "shaders/textures/registry.h"

namespace eyeray::shader {

// The registries' numbers: KIND_sphere, MATERIAL_phong, LIGHT_point, …
#define X(name, number) inline constexpr uint KIND_##name = number;
SHAPES(X)
#undef X
#define X(name, number) inline constexpr uint MATERIAL_##name = number;
MATERIALS(X)
#undef X
#define X(name, number, ...) inline constexpr uint LOBE_##name = number;
LOBES(X)
#undef X
#define X(name, number) inline constexpr uint LIGHT_##name = number;
LIGHTS(X)
#undef X
#define X(name, number, ...) inline constexpr uint EMITTER_##name = number;
EMITTERS(X)
#undef X
#define X(name, number, ...) inline constexpr uint TEXTURE_##name = number;
TEXTURES(X)
#undef X
#define X(name, number, ...) inline constexpr uint CAMERA_##name = number;
CAMERAS(X)
#undef X

// How many kinds of shape there are.
inline constexpr uint SHAPE_KINDS = 0
#define X(name, number) +1
    SHAPES(X)
#undef X
    ;

}  // namespace eyeray::shader
