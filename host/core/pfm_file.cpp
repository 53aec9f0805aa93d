#include "core/pfm_file.hpp"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "core/error.hpp"
#include "core/image_file.hpp"

namespace eyeray {

static_assert(std::endian::native == std::endian::little, "encode_pfm writes floats as they lie in memory");

namespace {

// Reads the header's words from the front of `rest`.
class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  // The next word, without the one white-space byte that ends it.
  std::string_view word() {
    const size_t end = rest_.find_first_of(" \t\r\n");
    if (end == 0 || end > longest_word) malformed("its header is not one");
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return word;
  }
  template <typename Number>
  Number number() {
    const std::string_view text = word();
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) malformed("its header holds a bad number");
    return value;
  }
  std::string_view rest() const { return rest_; }

  [[noreturn]] void malformed(const char* why) const {
    throw Error(ExitCode::file_io, "cannot read {} as PFM: {}", name_, why);
  }

 private:
  static constexpr size_t longest_word = 32;
  std::string_view rest_;
  const std::string& name_;
};

float swap_bytes(float value) {
  return std::bit_cast<float>(__builtin_bswap32(std::bit_cast<uint32_t>(value)));
}

}  // namespace

std::string encode_pfm(const Image& image) {
  std::string bytes =
      fmt::format("{}\n{} {}\n-1.0\n", image.channels() == 1 ? "Pf" : "PF", image.width(), image.height());
  const size_t row_bytes = size_t(image.width()) * size_t(image.channels()) * sizeof(float);
  bytes.reserve(bytes.size() + row_bytes * size_t(image.height()));
  for (int y = image.height() - 1; y >= 0; --y) {
    bytes.append(reinterpret_cast<const char*>(image.pixel(0, y)), row_bytes);
  }
  return bytes;
}

Image decode_pfm(std::string_view bytes, const std::string& name) {
  // Read the header.
  HeaderReader header(bytes, name);
  const std::string_view magic = header.word();
  if (magic != "PF" && magic != "Pf") header.malformed("it does not begin with PF or Pf");
  const int width = header.number<int>();
  const int height = header.number<int>();
  const double scale = header.number<double>();
  if (!image_size_allowed(width, height)) header.malformed("its size is out of range");
  if (!std::isfinite(scale) || scale == 0) header.malformed("its scale is not a number other than 0");

  // Check the length before memory is taken for it.
  const int channels = magic == "PF" ? 3 : 1;
  const size_t row_samples = size_t(width) * size_t(channels);
  const size_t data_bytes = row_samples * size_t(height) * sizeof(float);
  const std::string_view data = header.rest();
  if (data.size() < data_bytes) header.malformed("it ends too early");
  if (data.size() > data_bytes) header.malformed("it goes on after the last pixel");

  // Take the rows from the bottom up.
  Image image(width, height, channels);
  for (int row = 0; row < height; ++row) {
    float* samples = image.pixel(0, height - 1 - row);
    std::memcpy(samples, data.data() + size_t(row) * row_samples * sizeof(float),
                row_samples * sizeof(float));
    for (size_t i = 0; i < row_samples; ++i) {
      if (scale > 0) samples[i] = swap_bytes(samples[i]);
      if (std::abs(scale) != 1) samples[i] *= float(std::abs(scale));
    }
  }
  return image;
}

}  // namespace eyeray
