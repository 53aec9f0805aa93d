#include "host/render/row_store.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "host/core/checksum.hpp"
#include "host/core/error.hpp"

namespace eyeray::render {
namespace {

using StoredPixel = std::array<float, 6>;

[[noreturn]] void fail(const char* what, const std::filesystem::path& file, int error) {
  throw Error(ExitCode::file_io, "cannot {} {}: {}", what, file.string(),
              std::generic_category().message(error));
}

}  // namespace

RowStore::~RowStore() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FinishedRows RowStore::read(int first, int count, int width) {
  if (descriptor_ < 0) descriptor_ = ::open(file_.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor_ < 0) fail("read", file_, errno);

  std::vector<StoredPixel> pixels(size_t(count) * size_t(width));
  const auto bytes = std::as_writable_bytes(std::span(pixels));
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t got = ::pread(descriptor_, &bytes[done], bytes.size() - done, off_t(end_ + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("read", file_, errno);
    if (got == 0) throw Error(ExitCode::file_io, "cannot read {}: it ends too early", file_.string());
    done += size_t(got);
  }
  end_ += bytes.size();
  checksum_ = crc32(bytes, checksum_);

  FinishedRows rows(first, width, count);
  for (size_t i = 0; i < pixels.size(); ++i) {
    std::copy_n(pixels[i].begin(), 3, &rows.color.samples()[3 * i]);
    rows.hits.samples()[i] = pixels[i][3];
    rows.rays_traced.samples()[i] = pixels[i][4];
    rows.flagged.samples()[i] = pixels[i][5];
  }
  return rows;
}

void RowStore::append(const FinishedRows& rows) {
  if (descriptor_ < 0) descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("write", file_, errno);
  if (!dropped_rest_ && ::ftruncate(descriptor_, off_t(end_)) != 0) fail("write", file_, errno);
  dropped_rest_ = true;

  std::vector<StoredPixel> pixels(rows.hits.sample_count());
  for (size_t i = 0; i < pixels.size(); ++i) {
    std::copy_n(&rows.color.samples()[3 * i], 3, pixels[i].begin());
    pixels[i][3] = rows.hits.samples()[i];
    pixels[i][4] = rows.rays_traced.samples()[i];
    pixels[i][5] = rows.flagged.samples()[i];
  }
  const auto bytes = std::as_bytes(std::span(pixels));
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t put = ::pwrite(descriptor_, &bytes[done], bytes.size() - done, off_t(end_ + done));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) fail("write", file_, errno);
    done += size_t(put);
  }
  end_ += bytes.size();
  checksum_ = crc32(bytes, checksum_);
}

void RowStore::sync() {
  if (descriptor_ >= 0 && ::fsync(descriptor_) != 0) fail("write", file_, errno);
}

void RowStore::remove() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

}  // namespace eyeray::render
