#pragma once

#include "host/scene/material.hpp"

namespace eyeray::materials {

// Every kind of material, in registry order.
std::span<const MaterialType* const> types();

}  // namespace eyeray::materials
