// Patterns in space: a number in [0, 1], the share, at each point of the world, and a color for each share.
#pragma once

#include <vector>

#include "host/records/records.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/texture.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::textures {

// The keys that all patterns have.
inline constexpr Key pattern_transform_key{
    .name = "transform",
    .type = KeyType::transform,
    .doc = "Steps that move the pattern, in world units. Without steps the pattern lies as described.",
    .fallback = "[]"};
inline constexpr Key octaves_key{
    .name = "octaves",
    .type = KeyType::integer,
    .doc = "Number of octaves of the noise. Each is twice as fine as the one before and half as strong.",
    .fallback = "4",
    .min = 1,
    .max = 10};
constexpr Key colors_key(std::string_view fallback) {
  return {
      .name = "colors",
      .type = KeyType::color_map,
      .doc = "Color at each t, interpolated between two neighbours. Two colors at the same t make a step.",
      .fallback = fallback};
}

class Pattern : public Texture {
 public:
  // `parameters`: four numbers, whose meaning the pattern's .glsl defines.
  Pattern(const TableReader& table, uint32_t kind, const Vec4& parameters = Vec4(0));

  Vec3 at(const TextureContext& point) const final;
  bool in_space() const final { return true; }
  double detail() const final;
  uint32_t pack(records::Packer& packer) const final;

 protected:
  // The share, in [0, 1], at a point of the pattern's own space.
  virtual double share(const Vec3& p) const = 0;

 private:
  Affine to_pattern_;
  std::vector<Vec4> colors_;
  uint32_t kind_;
  Vec4 parameters_;
};

// True if the table's transform can be inverted; else an error is reported.
bool pattern_stands(TableReader& table);

// The triangle wave: 0 at whole numbers, 1 half way between them.
double triangle_wave(double x);
// The sum of so many octaves of Perlin's noise at p.
double turbulence(const Vec3& p, int octaves);
// The hash of the cell that has this lower corner.
uint32_t cell_hash(const Vec3& corner);
uint32_t next_hash(uint32_t hash);

}  // namespace eyeray::engine::textures
