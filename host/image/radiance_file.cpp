#include "host/image/radiance_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "host/core/error.hpp"
#include "host/core/vec.hpp"
#include "host/image/image_file.hpp"
#include "host/image/row_encoder.hpp"

namespace eyeray::engine::image {

namespace {

using Rgbe = std::array<unsigned char, 4>;

// Takes lines, bytes and rows from the front of the file.
class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

  [[noreturn]] void malformed(const char* why) const {
    throw Error(ExitCode::file_io, "cannot read {} as HDR: {}", name_, why);
  }

  std::string line() {
    const size_t end = rest_.find('\n');
    if (end == std::string_view::npos) malformed("it ends within its header");
    std::string line(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    return line;
  }
  size_t left() const { return rest_.size(); }

  void row(std::vector<Rgbe>& pixels) {
    const size_t width = pixels.size();
    const auto starts = [&](unsigned char a, unsigned char b, size_t n) {
      return rest_.size() >= 4 && peek(0) == a && peek(1) == b && size_t(peek(2)) << 8 == (n & 0xff00) &&
             peek(3) == (n & 0xff);
    };
    if (width >= 8 && width < 32768 && starts(2, 2, width)) {
      rest_.remove_prefix(4);
      for (size_t channel = 0; channel < 4; ++channel) runs(pixels, channel);
    } else {
      plain_row(pixels);
    }
  }

 private:
  // Reads a row pixel by pixel. A pixel of 1, 1, 1 repeats the pixel before it; its last byte is the count.
  // Several such pixels in sequence form one count, the lowest byte first. (No colour is written as 1, 1, 1:
  // colours are scaled to 128 and more.)
  void plain_row(std::vector<Rgbe>& pixels) {
    int shift = 0;
    for (size_t x = 0; x < pixels.size();) {
      Rgbe pixel;
      for (unsigned char& value : pixel) value = byte();
      if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
        pixels[x++] = pixel;
        shift = 0;
        continue;
      }
      const size_t count = shift < 32 ? size_t(pixel[3]) << shift : pixels.size();
      if (x == 0 || count > pixels.size() - x) malformed("a run of pixels extends beyond its row");
      std::fill_n(pixels.begin() + std::ptrdiff_t(x), count, pixels[x - 1]);
      x += count;
      shift += 8;
    }
  }
  unsigned char peek(size_t i) const { return static_cast<unsigned char>(rest_[i]); }
  unsigned char byte() {
    if (rest_.empty()) malformed("it ends too early");
    const unsigned char value = peek(0);
    rest_.remove_prefix(1);
    return value;
  }
  // One channel of a row: n > 128 means "the next byte n − 128 times", n in 1 … 128 "the next n bytes".
  void runs(std::vector<Rgbe>& pixels, size_t channel) {
    for (size_t x = 0; x < pixels.size();) {
      const unsigned char code = byte();
      const size_t count = code > 128 ? code - 128u : code;
      if (count == 0 || count > pixels.size() - x) malformed("a run of pixels extends beyond its row");
      const unsigned char repeated = code > 128 ? byte() : 0;
      for (size_t i = 0; i < count; ++i) pixels[x++][channel] = code > 128 ? repeated : byte();
    }
  }

  std::string_view rest_;
  const std::string& name_;
};

// Encodes a colour like Radiance's own setcolr: all three channels share the exponent of the largest. RGBE
// has no NaN, negative numbers or infinity.
Rgbe to_rgbe(const float* color) {
  std::array<float, 3> held{};
  for (size_t c = 0; c < 3; ++c) held[c] = color[c] > 0 ? std::min(color[c], 1e38f) : 0.0f;
  const float largest = std::max({held[0], held[1], held[2]});
  if (largest < 1e-32f) return {};
  int exponent = 0;
  const float scale = std::frexp(largest, &exponent) * 256.0f / largest;
  Rgbe rgbe{0, 0, 0, (unsigned char)(exponent + 128)};
  for (size_t c = 0; c < 3; ++c) rgbe[c] = (unsigned char)(held[c] * scale);
  return rgbe;
}

// True if the chromaticities of red, green, blue and white are near Rec. 709's or Radiance's own.
bool usual_primaries(const std::string& line) {
  constexpr double usual[2][8] = {{0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329},
                                  {0.64, 0.33, 0.29, 0.6, 0.15, 0.06, 0.3333, 0.3333}};
  double v[8];
  if (std::sscanf(line.c_str(), "PRIMARIES=%lf %lf %lf %lf %lf %lf %lf %lf", v, v + 1, v + 2, v + 3, v + 4,
                  v + 5, v + 6, v + 7) != 8)
    return false;
  return std::ranges::any_of(usual, [&](const auto& row) {
    return std::equal(v, v + 8, row, [](double a, double b) { return std::abs(a - b) < 0.002; });
  });
}

// Writes rows in the new run-length encoding if the format allows it for this width, else plain.
class RadianceEncoder final : public RowEncoder {
 public:
  RadianceEncoder(AtomicFile& file, int width, int height)
      : file_(file), row_(size_t(width)), in_runs_(width >= 8 && width < 32768) {
    file_.write(fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", height, width));
  }

  void write(const Image& rows) override {
    bytes_.clear();
    for (int y = 0; y < rows.height(); ++y) {
      for (int x = 0; x < rows.width(); ++x) {
        const float* pixel = rows.pixel(x, y);
        const float grey[] = {*pixel, *pixel, *pixel};
        row_[size_t(x)] = to_rgbe(rows.channels() == 3 ? pixel : grey);
      }
      append_row();
    }
    file_.write(bytes_);
  }

 private:
  void append_row() {
    if (in_runs_) {
      bytes_ += {2, 2, char(row_.size() >> 8), char(row_.size() & 255)};
      for (size_t channel = 0; channel < 4; ++channel) append_runs(channel);
    } else {
      for (const Rgbe& pixel : row_) bytes_.append(reinterpret_cast<const char*>(pixel.data()), 4);
    }
  }
  // Appends one channel in the form that Reader::runs reads: runs of equal bytes, and the bytes between them.
  void append_runs(size_t channel) {
    constexpr size_t shortest_run = 4, longest_run = 127, longest_between = 128;
    const auto equal_from = [&](size_t x, size_t most) {
      size_t count = 1;
      while (count < most && x + count < row_.size() && row_[x + count][channel] == row_[x][channel]) ++count;
      return count;
    };
    for (size_t x = 0; x < row_.size();) {
      const size_t run = equal_from(x, longest_run);
      if (run >= shortest_run) {
        bytes_ += {char(128 + run), char(row_[x][channel])};
        x += run;
        continue;
      }
      size_t end = x + 1;
      while (end < row_.size() && end - x < longest_between && equal_from(end, shortest_run) < shortest_run)
        ++end;
      bytes_ += char(end - x);
      for (; x < end; ++x) bytes_ += char(row_[x][channel]);
    }
  }

  AtomicFile& file_;
  std::vector<Rgbe> row_;
  bool in_runs_;
  std::string bytes_;
};

}  // namespace

std::unique_ptr<RowEncoder> radiance_encoder(AtomicFile& file, int width, int height, int) {
  return std::make_unique<RadianceEncoder>(file, width, height);
}

Image decode_radiance(std::string_view bytes, const std::string& name, std::vector<std::string>& warnings) {
  // Read the header: lines up to an empty one, then the size.
  Reader reader(bytes, name);
  const std::string magic = reader.line();
  if (magic != "#?RADIANCE" && magic != "#?RGBE") reader.malformed("it does not begin with #?RADIANCE");
  bool rgbe = false;
  Vec3 scale(1);  // the factor from the file's numbers to light
  for (std::string line = reader.line(); !line.empty(); line = reader.line()) {
    rgbe = rgbe || line == "FORMAT=32-bit_rle_rgbe";
    // A number that is missing stays 0, which is refused below.
    double r = 0, g = 0, b = 0;
    if (line.starts_with("EXPOSURE=")) {
      std::sscanf(line.c_str(), "EXPOSURE=%lf", &r);
      scale /= Vec3(r);
    } else if (line.starts_with("COLORCORR=")) {
      std::sscanf(line.c_str(), "COLORCORR=%lf %lf %lf", &r, &g, &b);
      scale /= Vec3(r, g, b);
    } else if (line.starts_with("GAMMA=") && !(std::sscanf(line.c_str(), "GAMMA=%lf", &r) == 1 && r == 1)) {
      warnings.push_back(name + ": its GAMMA is not 1; its numbers are used unchanged");
    } else if (line.starts_with("PRIMARIES=") && !usual_primaries(line)) {
      warnings.push_back(name + ": its PRIMARIES are not those of Rec. 709; its numbers are used unchanged");
    } else if (std::sscanf(line.c_str(), "PIXASPECT=%lf", &r) == 1 && r != 1) {
      warnings.push_back(name + ": its PIXASPECT is not 1; pixels are read as squares");
    }
  }
  for (int c = 0; c < 3; ++c)
    if (!(scale[c] > 0) || !std::isfinite(scale[c]))
      reader.malformed("its EXPOSURE and COLORCORR must be numbers above 0");
  if (!rgbe) reader.malformed("its format is not 32-bit_rle_rgbe");
  int width = 0, height = 0, end = 0;
  const std::string size = reader.line();
  if (std::sscanf(size.c_str(), "-Y %9d +X %9d%n", &height, &width, &end) != 2 ||
      size_t(end) != size.size()) {
    reader.malformed("its size is not of the form -Y HEIGHT +X WIDTH");
  }
  if (!image_size_allowed(width, height)) reader.malformed("its size is out of range");
  // No row is shorter than this. The check prevents a file of a few bytes from requesting gigabytes.
  constexpr size_t least_of_runs = 8;
  if (reader.left() < size_t(height) * std::min(size_t(width) / 32, least_of_runs))
    reader.malformed("it ends too early");

  // Read the rows.
  Image image(width, height, 3);
  std::vector<Rgbe> row{size_t(width)};
  for (int y = 0; y < height; ++y) {
    reader.row(row);
    for (int x = 0; x < width; ++x) {
      const Rgbe& pixel = row[size_t(x)];
      if (pixel[3] == 0) continue;
      for (int c = 0; c < 3; ++c)
        image.pixel(x, y)[c] = float(scale[c] * std::ldexp(double(pixel[size_t(c)]), pixel[3] - 136));
    }
  }
  if (reader.left() > 0) reader.malformed("it has data after the last pixel");
  return image;
}

}  // namespace eyeray::engine::image
