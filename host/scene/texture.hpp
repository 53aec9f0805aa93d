// The interface of every texture, in float64: a colour that may vary over a surface. A texture is one .cpp in
// host/textures, one .glsl in shaders/textures and one row in textures/rows.h.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "host/core/vec.hpp"

namespace eyeray::engine {

namespace records {
class Packer;  // records/packer.hpp
}

// The point of a texture's lookup: on the surface, and in the world.
struct TextureContext {
  TextureContext(const Vec2& at_uv = Vec2(0.0), const Vec3& at_position = Vec3(0.0))
      : TextureContext(at_uv, at_uv, at_position) {}
  TextureContext(const Vec2& at_uv, const Vec2& at_second_uv, const Vec3& at_position)
      : uv(at_uv), second_uv(at_second_uv), position(at_position) {}

  Vec2 uv;
  Vec2 second_uv;  // second uv of a mesh that has them, else uv
  Vec3 position;
};

class Texture;
using TexturePtr = std::shared_ptr<const Texture>;

class Texture {
 public:
  virtual ~Texture() = default;

  // The colour in linear RGB. This is the reference's version: no float32.
  virtual Vec3 at(const TextureContext& point) const = 0;
  // The colour of a texture that is the same everywhere; empty for any other.
  virtual std::optional<Vec3> constant() const { return std::nullopt; }
  // The texture's value as an alpha.
  virtual double alpha_at(const TextureContext& point) const { return at(point).x; }
  // The same texture, but with the codes of its picture as they are, for data that is not a colour; null if
  // it has no picture.
  virtual TexturePtr as_data() const { return nullptr; }
  // The distance for measuring a slope: in uv, or for a texture in_space() in the world.
  virtual double detail() const { return 0.01; }
  // True if the texture depends on the position in the world, which is unknown where cutouts are sampled.
  virtual bool in_space() const { return false; }
  // True if the texture reads the second texture coordinates of a mesh.
  virtual bool reads_second_uv() const { return false; }
  // The index of the texture's record, which is added unless there is an equal one.
  virtual uint32_t pack(records::Packer& packer) const = 0;
};

}  // namespace eyeray::engine
