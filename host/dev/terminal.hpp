// A picture in a terminal.
#pragma once

#include <string>
#include <string_view>

#include "host/image/image.hpp"

namespace eyeray::dev {

enum class TerminalGraphics {
  kitty,   // the kitty terminal's protocol: all pixels
  sixel,   // DEC's: all pixels, of 216 colours
  blocks,  // half blocks in 24-bit colour, two pixels a character: any terminal
};

// "kitty", "sixel" or "blocks", or of "auto" what the environment ($TERM, $TERM_PROGRAM, $KITTY_WINDOW_ID)
// promises. Error (bad_input) for another name.
TerminalGraphics parse_terminal_graphics(std::string_view name);

struct TerminalSize {
  int columns = 80, rows = 24;
  int width = 0, height = 0;  // in pixels; 0 where it does not say
};
// Of the terminal on standard output; 80 × 24 where there is none.
TerminalSize terminal_size();

// What shows a linear picture of three channels, as sRGB and made as small as the terminal wants it, with the
// last line free. It ends with a line break.
std::string in_terminal(const image::Image& picture, TerminalGraphics how, const TerminalSize& size);

}  // namespace eyeray::dev
