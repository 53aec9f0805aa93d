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

// The channels of a picture without layers: R, G and B, or Y.
std::vector<ExrChannel> exr_channels(int channels, bool half);

// The channels of one layer, as they are named before it: R, G and B, else X, Y and Z, else Y, else all there
// are, up to three and sorted by name. With two the third is 0. What else is there (A, beside R, G and B) is
// left out. `layer` "": that without a name, or the only one. A part of a file of several is a layer of its
// name. Reads scan lines and tiles, of these the largest level; the picture is the display window: 0 where it
// has no data, and without the data around it. Chromaticities other than Rec. 709's and pixels that are no
// squares are warnings. Error (file_io), with `name` in it, for a layer that is not there or lacks a channel,
// deep or subsampled data, a file that ends early or is too short for its pixels.
Image decode_exr(std::string_view bytes, const std::string& name, const std::string& layer,
                 std::vector<std::string>& warnings);

// Its channel A, of the layer without a name; none where there is no such channel.
std::optional<Image> decode_exr_alpha(std::string_view bytes, const std::string& name);

}  // namespace eyeray::engine::image
