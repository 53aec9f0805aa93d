#include "host/bench/svg.hpp"

#include <fmt/format.h>

#include "host/core/escaped_text.hpp"

namespace eyeray::bench {
Svg::Svg(double width, double height)
    : body_(
          fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 "
                      "{0} {1}\" font-family=\"sans-serif\">\n",
                      width, height)) {
  box({0, 0}, {width, height}, "white");
}

void Svg::line(const Vec2& a, const Vec2& b, std::string_view color, double width) {
  body_ += fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"{}\"/>\n",
      a.x, a.y, b.x, b.y, color, width);
}

void Svg::polyline(std::span<const Vec2> points, std::string_view color, double width) {
  body_ += "<polyline points=\"";
  for (const Vec2& p : points) body_ += fmt::format("{:.1f},{:.1f} ", p.x, p.y);
  body_ += fmt::format("\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>\n", color, width);
}

void Svg::dot(const Vec2& center, std::string_view color) {
  body_ +=
      fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", center.x, center.y, color);
}

void Svg::box(const Vec2& corner, const Vec2& size, std::string_view color) {
  body_ += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
                       corner.x, corner.y, size.x, size.y, color);
}

void Svg::text(const Vec2& at, std::string_view text, std::string_view anchor, double size) {
  body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\">{}</text>\n",
                       at.x, at.y, anchor, size, xml_text(text));
}

std::string Svg::finished() const {
  return body_ + "</svg>\n";
}

}  // namespace eyeray::bench
