#include "host/tables/albedos.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::tables {

extern const optics::GgxAlbedo ggx_numbers[ggx_side * ggx_side];
extern const optics::SheenAlbedo sheen_numbers[sheen_side * sheen_side];
extern const double glass_numbers[(glass_slices + 1) * glass_side * glass_side];

namespace {

// Interpolates between four entries; number(entry) is the value of an entry.
template <typename Entry, typename Number>
double between(std::span<const Entry> table, int side, double cosine, double roughness,
               const Number& number) {
  const double x = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (side - 1);
  const double y = std::clamp(roughness, 0.0, 1.0) * (side - 1);
  const auto i = size_t(std::min(x, side - 2.0)), j = size_t(std::min(y, side - 2.0));
  const auto row = [&](size_t k) {
    const Entry* near = &table[k * size_t(side) + i];
    return std::lerp(number(near[0]), number(near[1]), x - double(i));
  };
  return std::lerp(row(j), row(j + 1), y - double(j));
}

}  // namespace

std::span<const optics::GgxAlbedo> ggx_albedos() {
  return ggx_numbers;
}
std::span<const optics::SheenAlbedo> sheen_albedos() {
  return sheen_numbers;
}
std::span<const double> glass_albedos(int end) {
  constexpr size_t size = glass_side * glass_side;
  return std::span(glass_numbers).subspan(size_t(end) * size, size);
}

optics::GgxAlbedo ggx_albedo(double cosine, double roughness) {
  using optics::GgxAlbedo;
  const auto at = [&](double GgxAlbedo::* member) {
    return between(ggx_albedos(), ggx_side, cosine, roughness,
                   [&](const GgxAlbedo& of) { return of.*member; });
  };
  return {at(&GgxAlbedo::once), at(&GgxAlbedo::edge), at(&GgxAlbedo::mean_once), at(&GgxAlbedo::mean_edge)};
}

optics::SheenAlbedo sheen_albedo(double cosine, double roughness) {
  using optics::SheenAlbedo;
  const auto at = [&](double SheenAlbedo::* member) {
    return between(sheen_albedos(), sheen_side, cosine, roughness,
                   [&](const SheenAlbedo& of) { return of.*member; });
  };
  return {at(&SheenAlbedo::unweakened), at(&SheenAlbedo::albedo)};
}

double glass_albedo(double cosine, double roughness, double ior_from, double ior_to) {
  const double contrast = (ior_to - ior_from) / (ior_to + ior_from) / most_contrast;
  const int steps = contrast < 0 ? glass_slices_below : glass_slices - glass_slices_below;
  const double position = glass_slices_below + std::copysign(std::sqrt(std::abs(contrast)), contrast) * steps;
  const int slice = std::clamp(int(std::floor(position)), 0, glass_slices - 1);
  const auto at = [&](int end) {
    return between(glass_albedos(end), glass_side, cosine, roughness, [](double x) { return x; });
  };
  return std::lerp(at(slice), at(slice + 1), position - slice);
}

}  // namespace eyeray::engine::tables
