// The fuzzer's test of a checkpoint: it is refused, or gives as many sums and rows as requested. The bytes
// are a file. If they begin with "size: ", they are an identity, a 0, and the bytes of the position, the sums
// and the rows instead: a file with fitting lengths and checksums is made of these. Otherwise the data behind
// a length or a checksum would never be read.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "host/core/checksum.hpp"
#include "host/core/error.hpp"
#include "host/render/checkpoint.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::render;

namespace {

constexpr int side = 4;

std::string word(uint32_t value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}
uint32_t sum_of(std::string_view bytes) {
  return crc32(std::as_bytes(std::span(bytes)));
}
void write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
}

// The channels of samples that the bits of `first` choose.
film::Channels channels_by(uint8_t first) {
  film::Channels channels;
  int bit = 0;
  for (const film::ChannelType& type : film::channel_types())
    if (type.of_samples() && type.of_samples()->sums > 0 && (first >> (bit++ % 8) & 1))
      channels.push_back(&type);
  return channels;
}

struct Folder {
  std::string path = (std::filesystem::temp_directory_path() / "eyeray-fuzz-XXXXXX").string();
  Folder() {
    if (!::mkdtemp(path.data())) std::abort();
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const Folder folder;
  const std::filesystem::path file = folder.path + "/a.checkpoint", rows = file.string() + ".rows";
  std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const film::Channels channels = channels_by(size > 0 ? data[size - 1] : 0);
  film::Film film;
  film.reset(side, side, channels);

  if (bytes.starts_with("size: ")) {
    const auto take = [&](size_t count) {
      std::string taken(bytes.substr(0, count));
      bytes.remove_prefix(std::min(bytes.size(), count));
      taken.resize(count, '\0');
      return taken;
    };
    const std::string identity = take(std::min(bytes.find('\0'), bytes.size()));
    take(1);
    std::string position = take(sizeof(RenderPosition)), all;
    for (const std::span<std::byte> part : film.parts()) all += take(part.size());
    const std::string stored(bytes);
    std::string header =
        "EYERAYCP" + word(7) + word(uint32_t(identity.size())) + identity + position + word(sum_of(stored));
    header += word(sum_of(header));
    write(file, header + all + word(sum_of(all)));
    write(rows, stored);
  } else {
    write(file, std::string(bytes));
    write(rows, std::string(bytes));
  }
  try {
    Checkpoint checkpoint = Checkpoint::resume(file, {{"size", "4x4"}}, 1);
    checkpoint.read_sums(film);
    (void)film.samples();
    if (film.rows(0, side).color.height() != side) std::abort();
    for (int row = 0; row < int(std::min<uint64_t>(checkpoint.position().finished_rows, side)); ++row)
      if (checkpoint.read_rows(row, 1, side, channels).color.sample_count() != 3 * side) std::abort();
    checkpoint.check_rows();
  } catch (const Error& error) {
    if (error.code() != ExitCode::cannot_resume) std::abort();
  }
  return 0;
}
