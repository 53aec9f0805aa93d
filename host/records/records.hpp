// The packed records, as the shaders see them: namespace eyeray::engine::shader.
#pragma once

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#include "shaders/records.h"
#pragma GCC diagnostic pop
#include "shaders/bsdf/rows.h"
#include "shaders/cameras/rows.h"
#include "shaders/emitters/rows.h"
#include "shaders/integrators/rows.h"
#include "shaders/lights/rows.h"
#include "shaders/materials/rows.h"
#include "shaders/samplers/rows.h"
#include "shaders/shapes/rows.h"
#include "shaders/textures/rows.h"

namespace eyeray::engine::shader {

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

// The number of kinds of shape.
inline constexpr uint SHAPE_KINDS = 0
#define X(name, number) +1
    SHAPES(X)
#undef X
    ;

}  // namespace eyeray::engine::shader
