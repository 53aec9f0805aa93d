#include "host/importers/zip_parts.hpp"

#include <fmt/format.h>
#include <unzip.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "host/importers/malformed.hpp"

namespace eyeray::engine::importers {

namespace {

// A file may unpack to so many bytes, and to so many more a byte of its own. Deflate could make 1032 of one;
// the XML of meshes has some ten.
constexpr uint64_t unpacked_bytes_of_any = uint64_t{64} << 20, unpacked_bytes_a_byte = 100;

}  // namespace

struct ZipParts::Source {
  std::string_view bytes;
  uint64_t at = 0;

  static Source& of(void* self) { return *static_cast<Source*>(self); }

  // The functions by which minizip reads a file. The file is the opaque value and the stream, both.
  static zlib_filefunc64_def functions(Source& source) {
    zlib_filefunc64_def all{};
    all.opaque = &source;
    all.zopen64_file = [](void* self, const void*, int) { return self; };
    all.zread_file = [](void*, void* self, void* to, uLong size) {
      Source& from = of(self);
      if (from.at >= from.bytes.size()) return uLong{0};
      const auto count = std::min<uLong>(size, uLong(from.bytes.size() - from.at));
      std::memcpy(to, from.bytes.data() + from.at, count);
      from.at += count;
      return count;
    };
    all.zwrite_file = [](void*, void*, const void*, uLong) { return uLong{0}; };
    all.ztell64_file = [](void*, void* self) { return ZPOS64_T{of(self).at}; };
    all.zseek64_file = [](void*, void* self, ZPOS64_T offset, int origin) {
      Source& from = of(self);
      const uint64_t start = origin == ZLIB_FILEFUNC_SEEK_CUR   ? from.at
                             : origin == ZLIB_FILEFUNC_SEEK_END ? from.bytes.size()
                                                                : 0;
      const uint64_t to = start + offset;
      if (to > from.bytes.size()) return -1L;
      from.at = to;
      return 0L;
    };
    all.zclose_file = [](void*, void*) { return 0; };
    all.zerror_file = [](void*, void*) { return 0; };
    return all;
  }
};

ZipParts::ZipParts(const std::string& bytes, const std::string& file)
    : file_(file),
      source_(new Source{bytes}),
      left_(unpacked_bytes_of_any + unpacked_bytes_a_byte * bytes.size()) {
  zlib_filefunc64_def functions = Source::functions(*source_);
  zip_ = unzOpen2_64("", &functions);
  if (!zip_) throw malformed(file, "it is no 3MF: it is not a ZIP archive");
  std::vector<char> name(size_t{1} << 16);  // lengths have 16 bits
  for (int status = unzGoToFirstFile(zip_); status == UNZ_OK; status = unzGoToNextFile(zip_)) {
    unz_file_info64 info;
    unz64_file_pos place;
    if (unzGetCurrentFileInfo64(zip_, &info, name.data(), uLong(name.size()), nullptr, 0, nullptr, 0) !=
            UNZ_OK ||
        unzGetFilePos64(zip_, &place) != UNZ_OK)
      break;
    const size_t length = std::min<size_t>(info.size_filename, name.size());
    const std::string written(name.data(), length);
    places_.try_emplace(key(written), Place{place.pos_in_zip_directory, place.num_of_file, written});
  }
}

ZipParts::~ZipParts() {
  if (zip_) unzClose(zip_);
}

std::string ZipParts::key(std::string_view part) {
  if (part.starts_with('/')) part.remove_prefix(1);
  std::string key(part);
  for (char& c : key)
    if (c >= 'A' && c <= 'Z') c = char(c + 32);
  return key;
}

bool ZipParts::has(std::string_view part) const {
  return places_.contains(key(part));
}

const std::string& ZipParts::name(std::string_view part) const {
  return find(part).name;
}

const ZipParts::Place& ZipParts::find(std::string_view part) const {
  const auto found = places_.find(key(part));
  if (found == places_.end()) throw malformed(file_, fmt::format("it has no part {}", part));
  return found->second;
}

void ZipParts::read(std::string_view part, const Take& take) {
  const Place& written = find(part);
  const auto fail = [&](const std::string& why) {
    return malformed(file_, fmt::format("cannot read its part {}: {}", written.name, why));
  };
  const unz64_file_pos place{written.directory, written.number};
  unz_file_info64 info;
  if (unzGoToFilePos64(zip_, &place) != UNZ_OK ||
      unzGetCurrentFileInfo64(zip_, &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK)
    throw fail("it is damaged");
  if (info.flag & 1) throw fail("it is encrypted");
  if (unzOpenCurrentFile(zip_) != UNZ_OK) throw fail("it is damaged, or not compressed by Deflate");

  // Whatever happens, the part is closed.
  struct Open {
    void* zip;
    ~Open() {
      if (zip) unzCloseCurrentFile(zip);
    }
    int close() {
      void* const closed = zip;
      zip = nullptr;
      return unzCloseCurrentFile(closed);
    }
  } open{zip_};
  std::vector<char> piece(size_t{1} << 18);
  for (;;) {
    const int count = unzReadCurrentFile(zip_, piece.data(), unsigned(piece.size()));
    if (count < 0) throw fail("it is damaged");
    if (count == 0) break;
    if (uint64_t(count) > left_)
      throw malformed(file_, "its parts unpack to more bytes than a file of this size may have");
    left_ -= uint64_t(count);
    take({piece.data(), size_t(count)}, false);
  }
  if (open.close() != UNZ_OK) throw fail("it is damaged: its checksum is that of other bytes");
  take({}, true);
}

std::string ZipParts::read(std::string_view part) {
  std::string whole;
  read(part, [&](std::string_view piece, bool) { whole += piece; });
  return whole;
}

}  // namespace eyeray::engine::importers
