// The shapes that cannot be part of a CSG object, and why. Private to the loader.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/loader/sections.hpp"
#include "host/scene/material.hpp"

namespace eyeray::engine::loader {

// Why no table of this section can stand in a CSG object, or "".
std::string why_no_part(const Section& section);

// Why a shape encloses nothing: the key that is to blame, and the reason.
struct Blame {
  std::string_view key;
  std::string message;
};
Blame why_not_closed(const shapes::ShapeType& type);

// Why the CSG object would be filled with two media at once, or "".
std::string why_two_media(const Shape& csg, const std::vector<std::unique_ptr<Material>>& materials);

}  // namespace eyeray::engine::loader
