#include <webp/decode.h>

#include <algorithm>

#include "host/image/webp_rows.hpp"

namespace eyeray::engine::image {

namespace {

const uint8_t* webp_bytes(std::string_view bytes) {
  return reinterpret_cast<const uint8_t*>(bytes.data());
}

}  // namespace

bool is_webp(std::string_view bytes) {
  return bytes.starts_with("RIFF") && bytes.substr(std::min<size_t>(bytes.size(), 8)).starts_with("WEBP");
}

BitmapSize webp_size(std::string_view bytes) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(webp_bytes(bytes), bytes.size(), &features) != VP8_STATUS_OK) return {0, 0};
  return {features.width, features.height};
}

std::string read_webp(std::string_view bytes, std::span<std::array<uint8_t, 4>> pixels) {
  WebPBitstreamFeatures features;
  if (WebPGetFeatures(webp_bytes(bytes), bytes.size(), &features) != VP8_STATUS_OK) return "it has no header";
  if (features.has_animation) return "it is an animation, of which no frame is chosen";
  const int stride = features.width * 4;
  if (!WebPDecodeRGBAInto(webp_bytes(bytes), bytes.size(), pixels.data()->data(), pixels.size_bytes(),
                          stride))
    return "or it ends early";
  return "";
}

}  // namespace eyeray::engine::image
