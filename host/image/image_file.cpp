#include "host/image/image_file.hpp"

#include <stb_image.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "host/core/error.hpp"
#include "host/image/color_fields.hpp"
#include "host/image/exr_file.hpp"
#include "host/image/image_writer.hpp"
#include "host/image/pfm_file.hpp"
#include "host/image/radiance_file.hpp"
#include "host/image/srgb.hpp"

namespace eyeray::engine::image {

namespace {

namespace fs = std::filesystem;

struct Free {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

[[noreturn]] void malformed(const std::string& name, const std::string& why) {
  throw Error(ExitCode::file_io, "cannot read {} as PNG: {}", name, why);
}

// Decodes with one of stb_image's loaders, and converts each sample by `convert`.
template <typename Load, typename Convert>
Image decode(std::string_view bytes, const std::string& name, Load load, Convert convert) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = int(bytes.size());

  // Check the size before allocating memory for it.
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels)) malformed(name, stbi_failure_reason());
  if (!image_size_allowed(width, height)) malformed(name, "its size is out of range");

  const int wanted = channels <= 2 ? 1 : 3;
  using Sample = std::remove_pointer_t<decltype(load(data, size, &width, &height, &channels, wanted))>;
  const std::unique_ptr<Sample, Free> samples(load(data, size, &width, &height, &channels, wanted));
  if (!samples) malformed(name, stbi_failure_reason());
  Image image(width, height, wanted);
  std::transform(samples.get(), samples.get() + image.sample_count(), image.samples().begin(), convert);
  return image;
}

Image decode_png(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n")) malformed(name, "its signature is not that of a PNG");
  if (bytes.size() > size_t(std::numeric_limits<int>::max())) malformed(name, "it is too long");
  if (stbi_is_16_bit_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), int(bytes.size()))) {
    return decode(bytes, name, stbi_load_16_from_memory,
                  [](stbi_us code) { return float(linear_from_srgb(code / 65535.0)); });
  }
  static const std::array<float, 256> linear = [] {
    std::array<float, 256> values{};
    for (size_t code = 0; code < values.size(); ++code)
      values[code] = float(linear_from_srgb(double(code) / 255));
    return values;
  }();
  return decode(bytes, name, stbi_load_from_memory, [](stbi_uc code) { return linear[code]; });
}

std::optional<Image> decode_png_alpha(std::string_view bytes, const std::string& name) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = int(std::min(bytes.size(), size_t(std::numeric_limits<int>::max())));
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels)) malformed(name, stbi_failure_reason());
  // A color key (tRNS) makes pixels of one color transparent.
  const bool keyed = bytes.substr(0, bytes.find("IDAT")).find("tRNS") != std::string_view::npos;
  if ((channels % 2 != 0 && !keyed) || !image_size_allowed(width, height)) return std::nullopt;
  const std::unique_ptr<stbi_us, Free> codes(
      stbi_load_16_from_memory(data, size, &width, &height, &channels, 4));
  if (!codes) malformed(name, stbi_failure_reason());
  Image alpha(width, height, 1);
  for (size_t i = 0; i < alpha.sample_count(); ++i)
    alpha.samples()[i] = float(codes.get()[4 * i + 3]) / 65535.0f;
  return alpha;
}

// For each code 1 … 255, the least linear value that gets it: the value at which srgb · 255 rounds up to the
// code.
std::array<float, 256> code_thresholds() {
  std::array<float, 256> thresholds{};
  for (int code = 1; code < 256; ++code)
    thresholds[size_t(code)] = float(linear_from_srgb((code - 0.5) / 255));
  return thresholds;
}

}  // namespace

bool image_size_allowed(int64_t width, int64_t height) {
  return width >= 1 && height >= 1 && width <= 65536 && height <= 65536 &&
         width * height <= (int64_t{1} << 28);
}

unsigned char srgb8(float linear) {
  // A search in 255 thresholds is exact at every rounding boundary, and needs no pow a pixel.
  static const std::array<float, 256> thresholds = code_thresholds();
  if (!(linear > 0)) return 0;
  return (unsigned char)(std::upper_bound(thresholds.begin() + 1, thresholds.end(), linear) -
                         thresholds.begin() - 1);
}

unsigned char alpha8(float alpha) {
  if (!(alpha > 0)) return 0;
  return (unsigned char)(std::min(alpha, 1.0f) * 255 + 0.5f);
}

void check_has_alpha(const fs::path& path) {
  const ImageFormat format = image_format(path);
  if (format != ImageFormat::png && format != ImageFormat::exr)
    throw Error(ExitCode::bad_input,
                "{}: only .png and .exr files have an alpha: write the transparent picture to one of these",
                path.string());
}

ImageFormat image_format(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  if (ending == ".png") return ImageFormat::png;
  if (ending == ".pfm") return ImageFormat::pfm;
  if (ending == ".hdr") return ImageFormat::hdr;
  if (ending == ".exr") return ImageFormat::exr;
  throw Error(ExitCode::bad_input, "{}: a picture's name must end in .png, .pfm, .hdr or .exr",
              path.string());
}

void write_image(const fs::path& path, const Image& image) {
  ImageWriter writer(path, image.width(), image.height(), image.channels());
  writer.write(image);
  writer.finish();
}

Image read_image(const fs::path& path, const std::string& layer) {
  std::vector<std::string> unheard;
  return read_image(path, layer, unheard);
}

std::optional<Image> read_alpha(const fs::path& path) {
  const ImageFormat format = image_format(path);
  if (format == ImageFormat::png) return decode_png_alpha(read_file(path), path.string());
  if (format == ImageFormat::exr) return decode_exr_alpha(read_file(path), path.string());
  return std::nullopt;
}

Image read_image(const fs::path& path, const std::string& layer, std::vector<std::string>& warnings) {
  const ImageFormat format = image_format(path);
  const std::string bytes = read_file(path);
  switch (format) {
    case ImageFormat::png:
      for (const std::string& clause : png_color_fields(bytes))
        warnings.push_back(fmt::format("{}: {}", path.string(), clause));
      return decode_png(bytes, path.string());
    case ImageFormat::pfm:
      return decode_pfm(bytes, path.string());
    case ImageFormat::hdr:
      return decode_radiance(bytes, path.string(), warnings);
    case ImageFormat::exr:
      return decode_exr(bytes, path.string(), layer, warnings);
  }
  CHECK(false);
}

}  // namespace eyeray::engine::image
