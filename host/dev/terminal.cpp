#include "host/dev/terminal.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "host/core/base64.hpp"
#include "host/core/error.hpp"
#include "host/image/image_file.hpp"

namespace eyeray::dev {
namespace {

using Codes = std::array<unsigned char, 3>;

// The mean of the pixels that fall into each of width × height, never more than there are.
image::Image shrunk(const image::Image& picture, int width, int height) {
  image::Image small(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int x0 = x * picture.width() / width, x1 = std::max(x0 + 1, (x + 1) * picture.width() / width);
      const int y0 = y * picture.height() / height,
                y1 = std::max(y0 + 1, (y + 1) * picture.height() / height);
      for (int c = 0; c < 3; ++c) {
        float sum = 0;
        for (int j = y0; j < y1; ++j)
          for (int i = x0; i < x1; ++i) sum += std::max(0.0f, picture.pixel(i, j)[c]);  // NaN counts as 0
        small.pixel(x, y)[c] = sum / float((x1 - x0) * (y1 - y0));
      }
    }
  }
  return small;
}

// As large as the picture may be in width × height, with its shape; no larger than it is.
image::Image fitted(const image::Image& picture, int width, int height) {
  const double scale = std::min({1.0, double(width) / picture.width(), double(height) / picture.height()});
  return shrunk(picture, std::max(1, int(picture.width() * scale)),
                std::max(1, int(picture.height() * scale)));
}

Codes codes_of(const image::Image& picture, int x, int y) {
  const float* pixel = picture.pixel(x, y);
  return {image::srgb8(pixel[0]), image::srgb8(pixel[1]), image::srgb8(pixel[2])};
}

std::string in_blocks(const image::Image& picture) {
  std::string text;
  for (int y = 0; y < picture.height(); y += 2) {
    for (int x = 0; x < picture.width(); ++x) {
      const Codes upper = codes_of(picture, x, y);
      text += fmt::format("\x1b[38;2;{}m", fmt::join(upper, ";"));
      if (y + 1 < picture.height())
        text += fmt::format("\x1b[48;2;{}m", fmt::join(codes_of(picture, x, y + 1), ";"));
      else
        text += "\x1b[49m";
      text += "▀";
    }
    text += "\x1b[0m\n";
  }
  return text;
}

// https://sw.kovidgoyal.net/kitty/graphics-protocol: a PNG, in pieces of at most 4096 bytes.
std::string by_kitty(const image::Image& picture) {
  constexpr size_t piece = 4096;
  const std::string data = base64(image::encode_png(picture));
  std::string text;
  for (size_t i = 0; i < data.size(); i += piece)
    text += fmt::format("\x1b_G{}m={};{}\x1b\\", i == 0 ? "a=T,f=100," : "", i + piece < data.size() ? 1 : 0,
                        data.substr(i, piece));
  return text + "\n";
}

// Bayer's 8 × 8 thresholds, in (0, 1).
double threshold(int x, int y) {
  int rank = 0;
  for (int bit = 0; bit < 3; ++bit) rank = rank << 2 | ((x >> bit ^ y >> bit) & 1) << 1 | (y >> bit & 1);
  return (rank + 0.5) / 64;
}

// DEC STD 070, chapter 9: bands of six rows, a colour at a time; of each component six codes, dithered.
std::string by_sixel(const image::Image& picture) {
  const int width = picture.width(), height = picture.height();
  std::vector<int> colors(size_t(width) * size_t(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Codes codes = codes_of(picture, x, y);
      int color = 0;
      for (const unsigned char code : codes) color = color * 6 + int(code / 51.0 + threshold(x, y));
      colors[size_t(y) * size_t(width) + size_t(x)] = color;
    }
  }
  std::string text = fmt::format("\x1bPq\"1;1;{};{}", width, height);
  for (int color = 0; color < 216; ++color)
    text += fmt::format("#{};2;{};{};{}", color, color / 36 * 20, color / 6 % 6 * 20, color % 6 * 20);
  for (int top = 0; top < height; top += 6) {
    std::array<std::string, 216> rows;
    for (int x = 0; x < width; ++x) {
      for (int y = top; y < std::min(top + 6, height); ++y) {
        std::string& row = rows[size_t(colors[size_t(y) * size_t(width) + size_t(x)])];
        if (row.empty()) row.assign(size_t(width), 0);
        row[size_t(x)] = char(row[size_t(x)] | 1 << (y - top));
      }
    }
    for (size_t color = 0; color < rows.size(); ++color) {
      if (rows[color].empty()) continue;
      text += fmt::format("#{}", color);
      // Runs of the same six pixels.
      for (size_t x = 0; x < rows[color].size();) {
        const size_t end = std::min(rows[color].find_first_not_of(rows[color][x], x), rows[color].size());
        const char sixel = char(rows[color][x] + '?');
        text += end - x > 3 ? fmt::format("!{}{}", end - x, sixel) : std::string(end - x, sixel);
        x = end;
      }
      text += '$';
    }
    text += '-';
  }
  return text + "\x1b\\\n";
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

TerminalGraphics parse_terminal_graphics(std::string_view name) {
  if (name == "kitty") return TerminalGraphics::kitty;
  if (name == "sixel") return TerminalGraphics::sixel;
  if (name == "blocks") return TerminalGraphics::blocks;
  if (name != "auto")
    throw Error(ExitCode::bad_input, "--term is auto, kitty, sixel or blocks, not '{}'", name);
  const std::string terminal = environment("TERM"), program = environment("TERM_PROGRAM");
  if (!environment("KITTY_WINDOW_ID").empty() || terminal == "xterm-kitty" || program == "ghostty" ||
      program == "WezTerm")
    return TerminalGraphics::kitty;
  if (terminal.starts_with("foot") || terminal.starts_with("mlterm") ||
      terminal.find("sixel") != std::string::npos)
    return TerminalGraphics::sixel;
  return TerminalGraphics::blocks;
}

TerminalSize terminal_size() {
  winsize size{};
  TerminalSize result;
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) return result;
  return {size.ws_col, size.ws_row, size.ws_xpixel, size.ws_ypixel};
}

std::string in_terminal(const image::Image& picture, TerminalGraphics how, const TerminalSize& size) {
  const int rows = std::max(1, size.rows - 1);
  if (how == TerminalGraphics::blocks) return in_blocks(fitted(picture, size.columns, 2 * rows));
  // A character is some 8 × 16 pixels where the terminal does not say.
  const int width = size.width > 0 ? size.width : 8 * size.columns;
  const int height = (size.height > 0 ? size.height : 16 * size.rows) * rows / size.rows;
  const image::Image small = fitted(picture, width, height);
  return how == TerminalGraphics::kitty ? by_kitty(small) : by_sixel(small);
}

}  // namespace eyeray::dev
