// The fuzzer's test of a part: it is refused, or read whole, and its header and totals stay the same when
// they are written again. The bytes are a file. If they begin with {, they are a header, a 0, totals, a 0 and
// pixels instead: a file with fitting lengths and checksums is made of these. Otherwise the data behind a
// length or a checksum would never be read.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

#include "host/core/checksum.hpp"
#include "host/core/error.hpp"
#include "host/shards/part_reader.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shards;

namespace {

// Parts with more pixels are written without them, and are refused too.
constexpr int64_t most_pixels = 1 << 12;

uint32_t sum_of(std::string_view bytes, uint32_t begin = 0) {
  return crc32(std::as_bytes(std::span(bytes)), begin);
}
std::string word(uint32_t value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

std::string planes_of(const std::string& text, std::string_view pixels) {
  PartHeader header;
  try {
    header = header_of(text);
  } catch (const Error&) {
    return "";
  }
  if (header.area.pixels() > most_pixels) return "";
  const render::ShardTiles tiles(header.area, header.shard);
  std::string planes;
  for (size_t plane = 0; plane < header.planes(); ++plane) {
    uint32_t sum = plane_checksum(sum_of(text), plane);
    for (const Rect& tile : tiles.tiles()) {
      std::string values(size_t(tile.pixels()) * size_t(header.channels(plane)) * sizeof(float), '\0');
      for (size_t i = 0; i < values.size() && !pixels.empty(); ++i) values[i] = pixels[i % pixels.size()];
      sum = sum_of(values, sum);
      planes += values + word(sum);
    }
  }
  return planes;
}

std::string file_of(std::string_view bytes) {
  const auto part = [&] {
    const std::string text(bytes.substr(0, bytes.find('\0')));
    bytes.remove_prefix(std::min(bytes.size(), text.size() + 1));
    return text;
  };
  const std::string header = part(), totals = part();
  const std::string prefix = std::string(part_magic) + word(part_version) + word(uint32_t(header.size()));
  const std::string end = word(uint32_t(totals.size())) + totals;
  return prefix + word(sum_of(prefix)) + header + word(sum_of(header)) + planes_of(header, bytes) + end +
         word(sum_of(end));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::string file = bytes.starts_with("{") ? file_of(bytes) : std::string(bytes);
  const int memory = ::memfd_create("part", MFD_CLOEXEC);
  if (memory < 0 || ::write(memory, file.data(), file.size()) != ssize_t(file.size())) std::abort();
  try {
    PartReader part("/proc/self/fd/" + std::to_string(memory));
    part.check();
    const std::string header = to_text(part.header());
    if (to_text(header_of(header)) != header) std::abort();
    const std::string totals = to_text(part.totals());
    if (to_text(totals_of(totals)) != totals) std::abort();
  } catch (const Error& error) {
    if (error.code() != ExitCode::file_io) std::abort();
  }
  ::close(memory);
  return 0;
}
