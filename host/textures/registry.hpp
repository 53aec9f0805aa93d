#pragma once

#include "host/scene/texture.hpp"

namespace eyeray::textures {

// Every kind of texture, in registry order.
std::span<const TextureType* const> types();

}  // namespace eyeray::textures
