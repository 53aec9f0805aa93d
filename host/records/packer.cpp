#include "host/records/packer.hpp"

#include <bit>
#include <cstring>
#include <functional>
#include <limits>
#include <string_view>

#include "host/core/error.hpp"
#include "host/formula/formula.hpp"
#include "host/image/srgb.hpp"

namespace eyeray::engine::records {

namespace {

// Limit on the instructions of all formulas in one kernel.
constexpr double most_formula_instructions = 1 << 15;

size_t hash_bytes(std::span<const std::byte> bytes) {
  return std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

uint32_t Packer::add_vertices(std::span<const shader::uvec4> data) {
  const auto first = uint32_t(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), data.begin(), data.end());
  return first;
}

uint32_t Packer::add_formula(const std::shared_ptr<const formula::Formula>& formula, bool by_bounds) {
  auto& all = scene.formulas;
  for (size_t i = 0; i < all.size(); ++i)
    if (formula->same(*all[i].formula) && all[i].by_bounds == by_bounds) return uint32_t(i);
  formula_instructions_ += formula->instructions();
  if (formula_instructions_ > most_formula_instructions)
    throw InputError({{Severity::error, formula->text().start,
                       fmt::format("all functions up to {} have {} instructions; at most {} are allowed: use "
                                   "fewer functions, or shorter ones",
                                   formula->title(), formula_instructions_, most_formula_instructions),
                       ""}});
  all.push_back({formula, by_bounds});
  return uint32_t(all.size() - 1);
}

uint32_t Packer::add_medium(const Medium& medium) {
  CHECK_LT(scene.media.size(), size_t{256});
  scene.media.push_back(to_record(medium));
  return uint32_t(scene.media.size() - 1);
}

uint32_t Packer::add_image(const std::shared_ptr<const ImageTexture>& image) {
  const auto& texels = image->texels;
  const size_t hash = hash_bytes(std::as_bytes(std::span(texels)));
  const auto [begin, end] = images_by_texels_.equal_range(hash);
  for (auto known = begin; known != end; ++known) {
    const PlacedImage& placed = images_[known->second];
    if (placed.image == image || placed.image->texels == texels) return placed.first;
  }

  CHECK_EQ(texels.size(), size_t(image->width) * size_t(image->height));
  const size_t first = std::max(scene.texel_count, size_t{TEXELS_FIRST});
  if (first + texels.size() > std::numeric_limits<uint32_t>::max())
    throw Error(ExitCode::bad_input, "the scene's images have more than {} pixels together",
                std::numeric_limits<uint32_t>::max() - TEXELS_FIRST);
  scene.texel_count = first + texels.size();
  images_by_texels_.emplace(hash, images_.size());
  images_.push_back({image, uint32_t(first)});
  return uint32_t(first);
}

void Packer::write_texels() {
  if (images_.empty()) return;
  scene.texels.reserve(scene.texel_count);

  // The tables of the two colour spaces precede the first image.
  for (const bool srgb : {true, false})
    for (int code = 0; code < 256; ++code) {
      const double value = srgb ? image::linear_from_srgb(code / 255.0) : code / 255.0;
      scene.texels.push_back(std::bit_cast<uint32_t>(float(value)));
    }
  for (const auto& [image, first] : images_) {
    CHECK_EQ(scene.texels.size(), size_t{first});
    for (const auto& [red, green, blue, alpha] : image->texels)
      scene.texels.push_back(uint32_t(red) | uint32_t(green) << 8 | uint32_t(blue) << 16 |
                             uint32_t(alpha) << 24);
  }
  CHECK_EQ(scene.texels.size(), scene.texel_count);
}

uint32_t Packer::add(const shader::Texture& record) {
  const size_t hash = hash_bytes(std::as_bytes(std::span(&record, 1)));
  const auto [begin, end] = textures_by_bytes_.equal_range(hash);
  for (auto known = begin; known != end; ++known)
    if (std::memcmp(&scene.textures[known->second], &record, sizeof record) == 0)
      return uint32_t(known->second);
  textures_by_bytes_.emplace(hash, scene.textures.size());
  scene.textures.push_back(record);
  return uint32_t(scene.textures.size() - 1);
}

}  // namespace eyeray::engine::records
