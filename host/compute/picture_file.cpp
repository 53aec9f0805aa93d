#include "host/compute/picture_file.hpp"

#include <cstring>

#include "host/core/error.hpp"
#include "host/core/input_file.hpp"
#include "host/image/coded_image.hpp"
#include "host/image/image_file.hpp"
#include "host/image/srgb.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::compute {
namespace {

// The array of pixels that a block consists of. Error (bad_input) if it is none.
const Type& pixels_of(const fs::path& file, const Type& block) {
  const Type& whole = unwrapped(block);
  if (whole.form == Form::array) {
    const std::optional<Number> number = only_number(*whole.element);
    const uint64_t count = count_numbers(*whole.element);
    const bool colour = number && number->kind == NumberKind::real && number->bits <= 32 &&
                        (count == 1 || count == 3 || count == 4);
    const bool code = (number == Number{NumberKind::unsigned_integer, 32} && count == 1) ||
                      (number == Number{NumberKind::unsigned_integer, 8} && count == 4);
    if (colour || code) return whole;
  }
  throw Error(
      ExitCode::bad_input,
      "{}: a picture needs a buffer that is one array of float, vec3, vec4 or uint, or an image such as "
      "r32f, rgba16f or rgba8, not {}",
      file.string(), describe(whole));
}

bool has_codes(const Type& pixels) {
  return only_number(pixels)->kind == NumberKind::unsigned_integer;
}

// The block with as many pixels as the picture.
void fit(const fs::path& file, int width, int height, const Type& pixels, TypePtr& block) {
  const uint64_t count = uint64_t(width) * uint64_t(height);
  if (is_image(pixels) && pixels.count == 0) {
    block = with_extent(pixels, {uint64_t(width), uint64_t(height)});
  } else if (is_image(pixels) && (pixels.extent[0] != uint64_t(width) || pixels.count != count)) {
    throw Error(ExitCode::bad_input, "{} has {} × {} pixels, but it is for an {}", file.string(), width,
                height, describe(pixels));
  } else if (run_time_array(*block)) {
    block = with_elements(block, count);
  } else if (pixels.count != count) {
    throw Error(ExitCode::bad_input, "{} has {} × {} pixels, but the buffer has {} elements", file.string(),
                width, height, pixels.count);
  }
}

std::vector<std::byte> read_codes(const fs::path& file, TypePtr& block, const Type& pixels) {
  const std::string text = read_input_file(file, "the picture", image::most_coded_bytes);
  image::PixelBudget budget;
  std::vector<std::string> warnings;
  const image::CodedImage picture =
      image::decode_coded_image(std::as_bytes(std::span(text)), file.string(), budget, warnings);
  fit(file, picture.width, picture.height, pixels, block);
  std::vector<std::byte> bytes(size(*block));
  for (size_t i = 0; i < picture.pixels.size(); ++i)
    std::memcpy(bytes.data() + i * pixels.stride, picture.pixels[i].data(), 4);
  return bytes;
}

}  // namespace

bool is_picture(const fs::path& file) {
  const fs::path ending = file.extension();
  return ending == ".png" || ending == ".pfm" || ending == ".hdr" || ending == ".exr";
}

void check_picture(const fs::path& file, const Type& block, uint64_t width) {
  const Type& pixels = pixels_of(file, block);
  if (width == 0 || pixels.count % width != 0)
    throw Error(ExitCode::bad_input,
                "{}: {} elements are no picture of {} pixels a row: set `width` of the buffer", file.string(),
                pixels.count, width);
  if (!image::image_size_allowed(int64_t(width), int64_t(pixels.count / width)))
    throw Error(ExitCode::bad_input,
                "{}: a picture has at most 65536 pixels along each side, and 2^28 in all", file.string());
}

std::vector<std::byte> read_picture(const fs::path& file, TypePtr& block) {
  const TypePtr declared = block;
  const Type& pixels = pixels_of(file, *declared);
  if (has_codes(pixels) && file.extension() == ".png") return read_codes(file, block, pixels);
  if (has_codes(pixels))
    throw Error(ExitCode::bad_input,
                "{}: only a .png has 8-bit codes, which a buffer of uint and an image such as "
                "rgba8 need",
                file.string());
  const uint64_t each = count_numbers(*pixels.element);
  image::Image picture = image::read_image(file);
  if (each == 1 && picture.channels() != 1)
    throw Error(ExitCode::bad_input, "{} has colours, but a pixel here is one float", file.string());
  if (each > 1) picture = image::in_color(std::move(picture));
  fit(file, picture.width(), picture.height(), pixels, block);
  std::vector<std::byte> bytes(size(*block));
  const auto channels = size_t(picture.channels());
  const Number number = *only_number(pixels);
  for (size_t i = 0; i < picture.sample_count() / channels; ++i) {
    std::byte* const at = bytes.data() + i * pixels.stride;
    for (size_t channel = 0; channel < each; ++channel)
      write_number(number, channel < channels ? double(picture.samples()[i * channels + channel]) : 1.0,
                   at + channel * number.bytes());
  }
  return bytes;
}

void write_picture(const fs::path& file, const Type& block, std::span<const std::byte> bytes,
                   uint64_t width) {
  const Type& pixels = pixels_of(file, block);
  const Number number = *only_number(pixels);
  const bool codes = has_codes(pixels), grey = !codes && count_numbers(*pixels.element) == 1;
  image::Image picture(int(width), int(pixels.count / width), grey ? 1 : 3);
  const auto channels = size_t(picture.channels());
  for (size_t i = 0; i < pixels.count; ++i) {
    const std::byte* const at = bytes.data() + i * pixels.stride;
    float* const to = &picture.samples()[i * channels];
    for (size_t channel = 0; channel < channels; ++channel)
      to[channel] = codes ? float(image::linear_from_srgb(double(uint8_t(at[channel])) / 255))
                          : float(read_number(number, at + channel * number.bytes()));
  }
  image::write_image(file, picture);
}

}  // namespace eyeray::engine::compute
