// The tables that have no kinds: their keys, and their values as the scene holds them.
#pragma once

#include <span>

#include "host/scene/scene.hpp"

namespace eyeray::loader {

std::span<const Key> image_keys();
std::span<const Key> render_keys();
std::span<const Key> verify_keys();

// What the table says; what is wrong between its values is reported to it.
ImageSettings read_image(TableReader& table);
RenderSettings read_render(TableReader& table);
VerifySettings read_verify(TableReader& table);

}  // namespace eyeray::loader
