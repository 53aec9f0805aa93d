#include "host/image/color_fields.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>

#include "host/image/bitmap_rows.hpp"
#include "host/image/exif.hpp"

namespace eyeray::engine::image {

namespace {

// A big-endian number; 0 beyond the end.
uint32_t number(std::string_view bytes, size_t at, size_t size) {
  if (at > bytes.size() || size > bytes.size() - at) return 0;
  uint32_t value = 0;
  for (size_t i = 0; i < size; ++i) value = value << 8 | uint8_t(bytes[at + i]);
  return value;
}

// True if an ICC profile describes itself as sRGB, in ASCII or in UTF-16.
bool is_srgb_profile(std::string_view profile) {
  using namespace std::string_view_literals;
  return std::ranges::any_of(
      std::array{"sRGB"sv, "s\0R\0G\0B"sv, "uRGB"sv, "u\0R\0G\0B"sv},
      [&](std::string_view name) { return profile.find(name) != std::string_view::npos; });
}

// The profile in an iCCP chunk, as far as it can be read. The chunk is a name, a zero, the method 0, then
// zlib's data.
std::string inflated(std::string_view chunk) {
  constexpr size_t most = size_t{1} << 22;
  const size_t name = chunk.find('\0');
  if (name == std::string_view::npos || name + 2 > chunk.size()) return "";
  z_stream stream{};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(chunk.data() + name + 2));
  stream.avail_in = uInt(chunk.size() - name - 2);
  if (inflateInit(&stream) != Z_OK) return "";
  std::string profile(most, '\0');
  stream.next_out = reinterpret_cast<Bytef*>(profile.data());
  stream.avail_out = uInt(most);
  inflate(&stream, Z_FINISH);
  profile.resize(most - stream.avail_out);
  inflateEnd(&stream);
  return profile;
}

constexpr std::string_view taken_as_srgb = " is ignored: its colours are read as sRGB";

// A clause on the chunk that decides on a PNG's colours; "" if the codes are sRGB.
std::string png_colors(const std::map<std::string_view, std::string_view>& chunks) {
  const auto chunk = [&](std::string_view name) {
    const auto found = chunks.find(name);
    return found == chunks.end() ? std::string_view() : found->second;
  };
  if (const std::string_view code = chunk("cICP"); code.size() == 4) {
    constexpr uint8_t rec709 = 1, srgb = 13;
    if (uint8_t(code[0]) == rec709 && uint8_t(code[1]) == srgb) return "";
    return fmt::format("its colour space (cICP {}, {}){}", uint8_t(code[0]), uint8_t(code[1]), taken_as_srgb);
  }
  if (const std::string_view profile = chunk("iCCP"); !profile.empty())
    return is_srgb_profile(profile) || is_srgb_profile(inflated(profile))
               ? ""
               : fmt::format("its colour profile (iCCP){}", taken_as_srgb);
  if (chunks.contains("sRGB")) return "";
  // In units of 1/100000. A gamma of 1/2.2 is how sRGB is written without an sRGB chunk.
  constexpr int64_t gamma = 45455, gamma_apart = 500, chromaticity_apart = 300;
  constexpr int64_t chromaticities[] = {31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000};
  if (const std::string_view written = chunk("gAMA"); written.size() == 4)
    if (std::abs(int64_t(number(written, 0, 4)) - gamma) > gamma_apart)
      return fmt::format("its gamma (gAMA) of {:.4g}{}", number(written, 0, 4) / 1e5, taken_as_srgb);
  if (const std::string_view written = chunk("cHRM"); written.size() == 32)
    for (size_t i = 0; i < 8; ++i)
      if (std::abs(int64_t(number(written, 4 * i, 4)) - chromaticities[i]) > chromaticity_apart)
        return fmt::format("its primaries (cHRM){}", taken_as_srgb);
  return "";
}

}  // namespace

std::vector<std::string> png_color_fields(std::string_view bytes) {
  std::map<std::string_view, std::string_view> chunks;
  // Each chunk is a length, a name, that many bytes and a checksum. Pixels begin at IDAT.
  constexpr size_t signature = 8, around = 12;
  for (size_t at = signature; at + around <= bytes.size();) {
    const size_t length = number(bytes, at, 4);
    const std::string_view name = bytes.substr(at + 4, 4);
    if (name == "IDAT" || length > bytes.size() - at - around) break;
    chunks.try_emplace(name, bytes.substr(at + 8, length));
    at += around + length;
  }
  std::vector<std::string> clauses;
  if (std::string colors = png_colors(chunks); !colors.empty()) clauses.push_back(std::move(colors));
  if (const auto size = chunks.find("pHYs"); size != chunks.end() && size->second.size() == 9)
    if (number(size->second, 0, 4) != number(size->second, 4, 4))
      clauses.emplace_back("its pixels are not square (pHYs), which is ignored");
  if (const auto exif = chunks.find("eXIf"); exif != chunks.end())
    if (const int orientation = tiff_orientation(exif->second); orientation != 1)
      clauses.push_back(fmt::format("its EXIF orientation (eXIf) of {} is ignored", orientation));
  return clauses;
}

std::vector<std::string> webp_color_fields(std::string_view bytes) {
  // Chunks of a name, a little-endian length and that many bytes, to an even number. VP8X and ICCP come
  // first.
  constexpr size_t start = 12;
  for (size_t at = start; at + 8 <= bytes.size();) {
    const size_t length = number_at(bytes, at + 4, 4);
    const std::string_view name = bytes.substr(at, 4);
    if ((name != "VP8X" && name != "ICCP") || length > bytes.size() - at - 8) break;
    if (name == "ICCP" && !is_srgb_profile(bytes.substr(at + 8, length)))
      return {fmt::format("its colour profile (ICCP){}", taken_as_srgb)};
    at += 8 + length + length % 2;
  }
  return {};
}

std::vector<std::string> jpeg_color_fields(std::string_view bytes) {
  constexpr std::string_view icc("ICC_PROFILE\0", 12), jfif("JFIF\0", 5);
  constexpr uint32_t app0 = 0xe0, app2 = 0xe2;
  std::vector<std::string> clauses;
  std::string profile;
  for_each_jpeg_segment(bytes, [&](uint32_t marker, std::string_view segment) {
    if (marker == app2 && segment.starts_with(icc))
      profile += segment.substr(std::min(segment.size(), icc.size() + 2));
    const uint32_t across = number(segment, 8, 2), down = number(segment, 10, 2);
    if (marker == app0 && segment.starts_with(jfif) && across != down)
      clauses.emplace_back("its pixels are not square (JFIF's densities), which is ignored");
  });
  if (std::string clause = profile_clause(profile); !clause.empty()) clauses.push_back(std::move(clause));
  return clauses;
}

std::string profile_clause(std::string_view profile) {
  if (profile.empty() || is_srgb_profile(profile)) return "";
  return fmt::format("its colour profile{}", taken_as_srgb);
}

}  // namespace eyeray::engine::image
