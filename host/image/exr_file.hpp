// OpenEXR pictures (.exr): channels of half or float32, in layers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/image/image.hpp"

namespace eyeray::engine::image {

// One channel of a file to be written.
struct ExrChannel {
  std::string name;  // with its layer, if it has one: "R", "normal.X"
  bool half = false;
};

// The channels of a picture without layers: Y of one channel, R, G and B of three, and A, too, of four.
std::vector<ExrChannel> exr_channels(int channels, bool half);

// Reads the channels of one layer: R, G and B; else X, Y and Z; else Y; else all of them, at most three,
// sorted by name. With two channels the third is 0. Other channels (A, beside R, G and B) are left out.
// `layer` "": the layer without a name, or the only one. In a file of several parts, each part is a layer
// with the part's name. Reads scan lines, and the largest level of tiles. The picture is the display window:
// it is 0 where the file has no data, and data outside it is left out. Warnings:
// chromaticities other than Rec. 709's and other attributes of color, X, Y and Z or a depth in place of
// colors, and pixels that are not square. Error (file_io), with `name` in it, for a layer that is
// missing or lacks a channel, for deep or subsampled data, and for a file that ends early or is too short for
// its pixels.
Image decode_exr(std::string_view bytes, const std::string& name, const std::string& layer,
                 std::vector<std::string>& warnings);

// The channels that decode_exr() without a layer and decode_exr_alpha() leave out: "Z", "normal.X".
std::vector<std::string> exr_channels_left_out(std::string_view bytes, const std::string& name);

// Reads the channel A of the layer without a name; empty if there is no such channel.
std::optional<Image> decode_exr_alpha(std::string_view bytes, const std::string& name);

}  // namespace eyeray::engine::image
