#include "host/compare/cause_picture.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "host/core/error.hpp"
#include "host/image/srgb.hpp"

namespace eyeray::compare {

namespace {

struct Class {
  const char* name;
  uint32_t color;  // sRGB, 0xrrggbb
};

// Of a pixel that does not match.
std::optional<Class> class_of(const PixelOutcome& pixel) {
  if (pixel.outcome == Outcome::unexamined) return Class{"unexamined", 0x800000};
  if (pixel.outcome == Outcome::unexplained) return Class{"unexplained", 0xff0000};
  if (pixel.outcome != Outcome::explained) return std::nullopt;
  const auto colored = [&](uint32_t color) { return Class{name(pixel.cause), color}; };
  switch (pixel.cause) {
    case Cause::silhouette:
      return colored(0x0072b2);
    case Cause::texture_edge:
      return colored(0x56b4e9);
    case Cause::refraction_branch:
      return colored(0xcc79a7);
    case Cause::shadow_edge:
      return colored(0xf0e442);
    case Cause::rounding:
      return colored(0x009e73);
    case Cause::crease:
      return colored(0xe69f00);
    case Cause::grazing:
      return colored(0xd55e00);
    case Cause::undecidable:
      return colored(0xffffff);
  }
  return std::nullopt;
}

}  // namespace

Image cause_picture(const Image& background, const std::vector<PixelOutcome>& outcomes) {
  CHECK_EQ(outcomes.size(), size_t(background.width()) * size_t(background.height()));
  Image picture(background.width(), background.height(), 3);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const auto found = class_of(outcomes[size_t(y) * size_t(picture.width()) + size_t(x)]);
      const double grey = 0.2 * glm::dot(color_at(background, x, y), Vec3(0.2126, 0.7152, 0.0722));
      for (int c = 0; c < 3; ++c)
        picture.pixel(x, y)[c] =
            float(found ? linear_from_srgb(double(found->color >> (16 - 8 * c) & 255) / 255) : grey);
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
  return legend.dump(2) + "\n";
}

}  // namespace eyeray::compare
