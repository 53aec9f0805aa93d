// SVG pictures, as far as plots need them.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "host/core/vec.hpp"

namespace eyeray::bench {

// Told apart by colour-blind people too (Okabe and Ito).
inline constexpr std::string_view plot_colors[] = {"#0072B2", "#E69F00", "#009E73", "#D55E00",
                                                   "#CC79A7", "#56B4E9", "#333333"};
inline constexpr std::string_view grid_color = "#dddddd", axis_color = "#444444";

class Svg {
 public:
  Svg(double width, double height);

  void line(const Vec2& a, const Vec2& b, std::string_view color, double width = 1);
  void polyline(std::span<const Vec2> points, std::string_view color, double width = 2);
  void dot(const Vec2& center, std::string_view color);
  // From the upper left corner.
  void box(const Vec2& corner, const Vec2& size, std::string_view color);
  // `anchor`: start, middle or end. Any text; what XML reserves is escaped.
  void text(const Vec2& at, std::string_view text, std::string_view anchor = "start", double size = 12);

  // The whole document.
  std::string finished() const;

 private:
  std::string body_;
};

}  // namespace eyeray::bench
