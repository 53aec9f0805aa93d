// Textures built in code, by materials, importers and tests. A scene file's textures are made by their
// TextureType instead.
#pragma once

#include "host/formula/formula.hpp"
#include "host/scene/image_texture.hpp"
#include "host/scene/texture.hpp"

namespace eyeray::engine::textures {

TexturePtr make_constant(const Vec3& color);

// A checkerboard in uv: the colour at (u, v) is `even` if floor(u / size.x) + floor(v / size.y) is even, else
// `odd`.
TexturePtr make_checker(const Vec3& even, const Vec3& odd, const Vec2& size);

// The colour that the formula gives for uv, each component clamped to [0, 1], times `tint`.
TexturePtr make_formula(std::shared_ptr<const formula::Formula> formula, const Vec3& tint = Vec3(1));

// The position of a picture in uv.
struct ImagePosition {
  Vec2 corner{0};          // its lower left
  Vec2 size{1};            // from there to the upper right; not 0
  bool second_uv = false;  // it lies in a mesh's second uv, as an alpha never does
};

// A picture in uv, times `tint`. Its alpha is the picture's alpha times the first component of `tint`.
TexturePtr make_image(std::shared_ptr<const ImageTexture> image, const Vec3& tint = Vec3(1),
                      const ImagePosition& position = {});

}  // namespace eyeray::engine::textures
