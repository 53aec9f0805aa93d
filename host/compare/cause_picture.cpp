#include "host/compare/cause_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/core/error.hpp"
#include "host/core/escaped_text.hpp"
#include "host/image/srgb.hpp"

namespace eyeray::engine::compare {

namespace {

struct Class {
  const char* name;
  uint32_t color;  // sRGB, 0xrrggbb
};

constexpr std::pair<Cause, uint32_t> cause_colors[] = {
    {Cause::silhouette, 0x0072b2},  {Cause::texture_edge, 0x56b4e9}, {Cause::refraction_branch, 0xcc79a7},
    {Cause::shadow_edge, 0xf0e442}, {Cause::rounding, 0x009e73},     {Cause::crease, 0xe69f00},
    {Cause::grazing, 0xd55e00},     {Cause::undecidable, 0xffffff},  {Cause::diverged, 0x999933},
};
static_assert(std::size(cause_colors) == cause_count);

// The class of a pixel that does not match.
std::optional<Class> class_of(const PixelOutcome& pixel) {
  if (pixel.outcome == Outcome::unexamined) return Class{"unexamined", 0x800000};
  if (pixel.outcome == Outcome::unexplained) return Class{"unexplained", 0xff0000};
  if (pixel.outcome != Outcome::explained) return std::nullopt;
  const auto color = std::ranges::find(cause_colors, pixel.cause, &std::pair<Cause, uint32_t>::first);
  CHECK(color != std::end(cause_colors));
  return Class{name(pixel.cause), color->second};
}

}  // namespace

image::Image cause_picture(const image::Image& background, const std::vector<PixelOutcome>& outcomes) {
  CHECK_EQ(outcomes.size(), size_t(background.width()) * size_t(background.height()));
  image::Image picture(background.width(), background.height(), 3);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const auto found = class_of(outcomes[size_t(y) * size_t(picture.width()) + size_t(x)]);
      const double grey = 0.2 * glm::dot(color_at(background, x, y), luma_weights);
      for (int c = 0; c < 3; ++c)
        picture.pixel(x, y)[c] =
            float(found ? image::linear_from_srgb(double(found->color >> (16 - 8 * c) & 255) / 255) : grey);
    }
  }
  return picture;
}

std::string cause_legend(const std::vector<PixelOutcome>& outcomes) {
  nlohmann::ordered_json legend = nlohmann::ordered_json::object();
  for (const PixelOutcome& pixel : outcomes) {
    const auto found = class_of(pixel);
    if (!found) continue;
    auto& entry = legend[found->name];
    if (entry.is_null()) entry = {{"color", fmt::format("#{:06x}", found->color)}, {"pixels", 0}};
    entry["pixels"] = entry["pixels"].get<int64_t>() + 1;
  }
  return json_text(legend, 2) + "\n";
}

}  // namespace eyeray::engine::compare
