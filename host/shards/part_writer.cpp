#include "host/shards/part_writer.hpp"

#include <span>

#include "host/core/checksum.hpp"
#include "host/core/error.hpp"

namespace eyeray::engine::shards {
namespace {

// Bytes of a plane to gather before they are written.
constexpr size_t gathered = 1 << 18;

std::string raw_bytes(uint32_t value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}

uint32_t checksum_of(std::string_view text) {
  return crc32(std::as_bytes(std::span(text)));
}

}  // namespace

PartWriter::PartWriter(std::filesystem::path file, const PartHeader& header, const render::ShardTiles& tiles)
    : tiles_(tiles), file_(std::move(file)) {
  const std::string text = to_text(header);
  if (text.size() > longest_part_header)
    throw Error(ExitCode::bad_input, "the header of this part has {} bytes; at most {} are allowed",
                text.size(), longest_part_header);
  std::string begin(part_magic);
  begin += raw_bytes(part_version);
  begin += raw_bytes(uint32_t(text.size()));
  begin += raw_bytes(checksum_of(begin));
  CHECK_EQ(begin.size(), size_t{part_prefix_bytes});
  const uint32_t checksum = checksum_of(text);
  begin += text + raw_bytes(checksum);
  file_.write(begin);

  end_ = begin.size();
  for (size_t i = 0; i < header.planes(); ++i) {
    const auto channels = size_t(header.channels(i));
    planes_.push_back({channels, end_, 0, plane_checksum(checksum, i), {}});
    end_ += uint64_t(tiles.pixels()) * channels * sizeof(float) + tiles.tiles().size() * sizeof(uint32_t);
  }
}

void PartWriter::flush(Plane& plane) {
  file_.write_at(plane.end, std::as_bytes(std::span(plane.waiting)));
  plane.end += plane.waiting.size();
  plane.waiting.clear();
}

void PartWriter::write_row(Plane& plane, const float* row) {
  const Rect& tile = tiles_.tiles().at(size_t(plane.row / render::Tiling::tile_height));
  const int y = plane.row % render::Tiling::tile_height;
  ++plane.row;
  if (y >= tile.height) return;
  const auto bytes = std::as_bytes(std::span(row, size_t(tile.width) * plane.channels));
  plane.checksum = crc32(bytes, plane.checksum);
  plane.waiting.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (y == tile.height - 1) plane.waiting += raw_bytes(plane.checksum);
  if (plane.waiting.size() >= gathered) flush(plane);
}

void PartWriter::write(size_t plane, const image::Image& rows) {
  for (int y = 0; y < rows.height(); ++y) write_row(planes_[plane], rows.pixel(0, y));
}

void PartWriter::write_tile(size_t plane, const image::Image& tile) {
  for (int y = 0; y < render::Tiling::tile_height; ++y)
    write_row(planes_[plane], y < tile.height() ? tile.pixel(0, y) : nullptr);
}

void PartWriter::finish(const PartTotals& totals) {
  for (Plane& plane : planes_) {
    CHECK_EQ(plane.row, tiles_.height());
    flush(plane);
  }
  const std::string text = to_text(totals);
  std::string end = raw_bytes(uint32_t(text.size())) + text;
  end += raw_bytes(checksum_of(end));
  file_.write_at(end_, std::as_bytes(std::span(end)));
  file_.commit();
}

}  // namespace eyeray::engine::shards
