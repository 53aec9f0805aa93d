// The tables that have no kinds: their keys, and functions that turn them into the scene's settings.
#pragma once

#include <span>

#include "host/reading/table_reader.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

std::span<const reading::Key> image_keys();
std::span<const reading::Key> render_keys();
std::span<const reading::Key> verify_keys();

// The settings of the table. Conflicts between its values are reported to the table.
RenderSettings read_render(reading::TableReader& table);
ImageSettings read_image(reading::TableReader& table, IntegratorType integrator);
VerifySettings read_verify(reading::TableReader& table);

}  // namespace eyeray::engine::loader
