#include "host/image/pfm_file.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "host/core/error.hpp"
#include "host/image/image_file.hpp"
#include "host/image/row_encoder.hpp"

namespace eyeray::engine::image {

static_assert(std::endian::native == std::endian::little, "floats are written as they lie in memory");

namespace {

// Reads the header's words from the front of `rest`.
class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  // The next word, without the one white-space byte that ends it.
  std::string_view word() {
    const size_t end = rest_.find_first_of(" \t\r\n");
    if (end == 0 || end > longest_word) malformed("its header is malformed");
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return word;
  }
  template <typename Number>
  Number number() {
    const std::string_view text = word();
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      malformed("its header contains a malformed number");
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

std::string header_of(int width, int height, int channels) {
  return fmt::format("{}\n{} {}\n-1.0\n", channels == 1 ? "Pf" : "PF", width, height);
}

size_t row_size(int width, int channels) {
  return size_t(width) * size_t(channels) * sizeof(float);
}

// The rows of `image` in reverse order: a file has them from the bottom up.
std::vector<float> turned_over(const Image& image) {
  std::vector<float> samples(image.sample_count());
  const size_t row_samples = size_t(image.width()) * size_t(image.channels());
  for (int y = 0; y < image.height(); ++y)
    std::copy_n(image.pixel(0, y), row_samples, &samples[size_t(image.height() - 1 - y) * row_samples]);
  return samples;
}

class PfmEncoder final : public RowEncoder {
 public:
  PfmEncoder(AtomicFile& file, int width, int height, int channels)
      : file_(file), rows_left_(height), row_bytes_(row_size(width, channels)) {
    const std::string header = header_of(width, height, channels);
    header_bytes_ = header.size();
    file_.write(header);
  }

  void write(const Image& rows) override {
    rows_left_ -= rows.height();
    const std::vector<float> samples = turned_over(rows);
    file_.write_at(header_bytes_ + uint64_t(rows_left_) * row_bytes_, std::as_bytes(std::span(samples)));
  }

 private:
  AtomicFile& file_;
  int rows_left_;
  size_t row_bytes_;
  size_t header_bytes_ = 0;
};

}  // namespace

std::unique_ptr<RowEncoder> pfm_encoder(AtomicFile& file, int width, int height, int channels) {
  return std::make_unique<PfmEncoder>(file, width, height, channels);
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
  if (!std::isfinite(scale) || scale == 0) header.malformed("its scale must be a number other than 0");

  // Check the length before memory is taken for it.
  const int channels = magic == "PF" ? 3 : 1;
  const size_t row_samples = size_t(width) * size_t(channels);
  const size_t data_bytes = row_samples * size_t(height) * sizeof(float);
  const std::string_view data = header.rest();
  if (data.size() < data_bytes) header.malformed("it ends too early");
  if (data.size() > data_bytes) header.malformed("it has data after the last pixel");

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

PfmRows::PfmRows(std::filesystem::path path, int width, int height, int channels)
    : path_(std::move(path)),
      width_(width),
      height_(height),
      channels_(channels),
      file_(path_, std::ios::binary) {}

Image PfmRows::read(int first, int count) {
  Image rows(width_, count, channels_);
  const size_t below = size_t(height_ - first - count);
  file_.seekg(
      std::streamoff(header_of(width_, height_, channels_).size() + below * row_size(width_, channels_)));
  file_.read(reinterpret_cast<char*>(rows.samples().data()),
             std::streamsize(size_t(count) * row_size(width_, channels_)));
  if (!file_) throw Error(ExitCode::file_io, "cannot read {} again", path_.string());
  rows.samples() = turned_over(rows);
  return rows;
}

}  // namespace eyeray::engine::image
