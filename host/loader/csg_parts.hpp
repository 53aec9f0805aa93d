// The reasons for which a shape cannot be part of a CSG object. Private to the loader.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/loader/sections.hpp"
#include "host/scene/material.hpp"

namespace eyeray::engine::loader {

// The reason why no table of this section can stand in a CSG object, or "".
std::string why_no_part(const Section& section);

// The reason why a shape encloses nothing, and the key that is to blame.
struct Blame {
  std::string_view key;
  std::string message;
};
Blame why_not_closed(const shapes::ShapeType& type);

// The reason why the CSG object would be filled with two media at once, or "".
std::string why_two_media(const Shape& csg, const std::vector<std::unique_ptr<Material>>& materials);

}  // namespace eyeray::engine::loader
