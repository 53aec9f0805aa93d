// The kinds of textures, and the names of host/reading that their code uses.
#pragma once

#include <span>

#include "host/reading/table_reader.hpp"
#include "host/reading/texture_type.hpp"

namespace eyeray::engine::textures {

using reading::Key, reading::KeyType, reading::TableReader, reading::TextureType;

// Every kind of texture, in registry order.
std::span<const TextureType* const> types();

}  // namespace eyeray::engine::textures
