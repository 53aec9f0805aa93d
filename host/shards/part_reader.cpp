#include "host/shards/part_reader.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "host/core/checksum.hpp"
#include "host/core/error.hpp"

namespace eyeray::engine::shards {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ExitCode::file_io, why);
}

[[noreturn]] void refuse_for(int error) {
  refuse("it cannot be read: " + std::generic_category().message(error));
}

uint32_t word_at(std::string_view bytes, size_t offset) {
  uint32_t word = 0;
  std::memcpy(&word, &bytes[offset], sizeof word);
  return word;
}

uint32_t sum_of(std::string_view bytes) {
  return crc32(std::as_bytes(std::span(bytes)));
}

}  // namespace

PartReader::PartReader(std::filesystem::path file) : file_(std::move(file)) {
  // O_NONBLOCK: if the file is a pipe, open() must not wait for a writer.
  descriptor_ = ::open(file_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) refuse_for(errno);
  try {
    read_header();
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

PartReader::~PartReader() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

PartReader::PartReader(PartReader&& other) noexcept
    : file_(std::move(other.file_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      bytes_(other.bytes_),
      header_(std::move(other.header_)),
      totals_(std::move(other.totals_)),
      planes_begin_(other.planes_begin_),
      header_checksum_(other.header_checksum_),
      tile_pixels_(std::move(other.tile_pixels_)),
      planes_(std::move(other.planes_)) {}

void PartReader::read_at(uint64_t offset, std::span<std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t count = ::pread(descriptor_, bytes.data(), bytes.size(), off_t(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse_for(errno);
    if (count == 0) refuse("it is damaged: it ends too early");
    bytes = bytes.subspan(size_t(count));
    offset += uint64_t(count);
  }
}

void PartReader::read_header() {
  struct stat status{};
  if (::fstat(descriptor_, &status) != 0) refuse_for(errno);
  if (!S_ISREG(status.st_mode)) refuse("it is not a regular file");
  bytes_ = uint64_t(status.st_size);
  // The `size` bytes at `offset`; refuses a file that ends earlier.
  const auto text_at = [&](uint64_t offset, uint64_t size) {
    if (offset > bytes_ || size > bytes_ - offset) refuse("it is damaged: it ends too early");
    std::string text(size, '\0');
    read_at(offset, std::as_writable_bytes(std::span(text)));
    return text;
  };

  const std::string prefix = text_at(0, std::min<uint64_t>(bytes_, part_prefix_bytes));
  const bool named = prefix.starts_with(part_magic);
  if (prefix.size() < part_prefix_bytes)
    refuse(named ? "it is damaged: it ends too early" : "it is not a part of a picture");
  const bool sound = sum_of(std::string_view(prefix).substr(0, 16)) == word_at(prefix, 16);
  if (!sound) refuse(named ? "it is damaged: its checksum is wrong" : "it is not a part of a picture");
  if (const uint32_t version = word_at(prefix, 8); version != part_version)
    refuse(fmt::format("its layout has version {}, but this eyeray's has {}", version, part_version));
  const uint32_t length = word_at(prefix, 12);
  if (length > longest_part_header) refuse("it is damaged: its header is too long");
  const std::string text = text_at(part_prefix_bytes, length);
  header_checksum_ = sum_of(text);
  if (word_at(text_at(part_prefix_bytes + length, 4), 0) != header_checksum_)
    refuse("it is damaged: its checksum is wrong");
  header_ = header_of(text);

  // The header determines the planes' size. Only the totals state their own length.
  const render::ShardTiles tiles(header_.area, header_.shard);
  for (const Rect& tile : tiles.tiles()) tile_pixels_.push_back(tile.pixels());
  planes_begin_ = part_prefix_bytes + length + 4;
  begin_planes();
  uint64_t end = planes_begin_;
  for (size_t i = 0; i < header_.planes(); ++i)
    end += uint64_t(tiles.pixels()) * uint64_t(header_.channels(i)) * sizeof(float) +
           tile_pixels_.size() * sizeof(uint32_t);
  const uint32_t totals_length = word_at(text_at(end, 4), 0);
  const uint64_t whole = end + 4 + totals_length + 4;
  if (bytes_ > whole) refuse("it is damaged: it has data after its end");
  const std::string totals = text_at(end, 4 + uint64_t{totals_length});
  if (word_at(text_at(whole - 4, 4), 0) != sum_of(totals)) refuse("it is damaged: its checksum is wrong");
  totals_ = totals.substr(4);
  if (totals_of(totals_).legends.size() != header_.aovs.size())
    refuse("it is damaged: its totals are invalid");
}

void PartReader::begin_planes() {
  planes_.clear();
  uint64_t begin = planes_begin_;
  int64_t pixels = 0;
  for (const int64_t tile : tile_pixels_) pixels += tile;
  for (size_t i = 0; i < header_.planes(); ++i) {
    planes_.push_back({begin, 0, plane_checksum(header_checksum_, i)});
    begin += uint64_t(pixels) * uint64_t(header_.channels(i)) * sizeof(float) +
             tile_pixels_.size() * sizeof(uint32_t);
  }
}

void PartReader::read_tile(size_t number, std::vector<float>& pixels) {
  Plane& plane = planes_[number];
  CHECK_LT(plane.tile, tile_pixels_.size());
  const size_t values = size_t(tile_pixels_[plane.tile]) * size_t(header_.channels(number));
  pixels.resize(values + 1);  // the last one receives the checksum
  const auto bytes = std::as_writable_bytes(std::span(pixels));
  read_at(plane.end, bytes);
  plane.end += bytes.size();
  ++plane.tile;
  plane.checksum = crc32(bytes.first(values * sizeof(float)), plane.checksum);
  if (std::bit_cast<uint32_t>(pixels.back()) != plane.checksum)
    refuse("it is damaged: its checksum is wrong");
  pixels.pop_back();
}

void PartReader::check() {
  std::vector<float> pixels;
  for (size_t plane = 0; plane < planes_.size(); ++plane)
    for (size_t i = 0; i < tile_pixels_.size(); ++i) read_tile(plane, pixels);
  begin_planes();
}

}  // namespace eyeray::engine::shards
