// The tables that have no kinds: their keys, and their values as the scene holds them.
#pragma once

#include <span>

#include "host/scene/scene.hpp"

namespace eyeray::loader {

std::span<const Key> image_keys();
std::span<const Key> render_keys();
std::span<const Key> verify_keys();

// What the table says; what is wrong between its values is reported to it.
RenderSettings read_render(TableReader& table);
ImageSettings read_image(TableReader& table, IntegratorType integrator);
VerifySettings read_verify(TableReader& table);

}  // namespace eyeray::loader
