// Pictures that stand for the shape of a surface: normal maps, and heights. Private to the importers.
#pragma once

#include "host/scene/image_texture.hpp"

namespace eyeray::engine::importers {

// True if the picture looks like a normal map, most of which points away from the surface: bluish.
bool has_normals(const ImageTexture& picture);

// True if the picture is grey, as one of heights is. JPEG may tint it a little.
bool has_heights(const ImageTexture& picture);

// The normal map of a picture of heights, of the same size, with the same wrapping. A difference of all its
// brightness between neighbours is a slope of `strength`, so of 45 degrees for 1: no format defines the
// height of white, and programs differ.
ImageTexture normals_of_heights(const ImageTexture& heights, double strength);

}  // namespace eyeray::engine::importers
