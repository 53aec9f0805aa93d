#include "host/film/row_store.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <vector>

#include "host/core/checksum.hpp"
#include "host/core/error.hpp"

namespace eyeray::engine::film {
namespace {

// The images that hold the stored values of a pixel, in this order.
template <typename AnyRows>
auto stored_images(AnyRows& rows) {
  std::vector images{&rows.color};
  for (auto& values : rows.values) images.push_back(&values);
  return images;
}

size_t floats_of(const Rows& rows) {
  size_t count = 0;
  for (const image::Image* image : stored_images(rows)) count += image->sample_count();
  return count;
}

[[noreturn]] void fail(const char* what, const std::filesystem::path& file, int error) {
  throw Error(ExitCode::file_io, "cannot {} {}: {}", what, file.string(),
              std::generic_category().message(error));
}

}  // namespace

RowStore::~RowStore() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Rows RowStore::read(int first, int count, int width, const Channels& channels) {
  if (descriptor_ < 0) descriptor_ = ::open(file_.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor_ < 0) fail("read", file_, errno);

  Rows rows(first, width, count, channels);
  std::vector<float> stored(floats_of(rows));
  const auto bytes = std::as_writable_bytes(std::span(stored));
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t got = ::pread(descriptor_, &bytes[done], bytes.size() - done, off_t(end_ + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("read", file_, errno);
    if (got == 0) throw Error(ExitCode::file_io, "cannot read {}: it ends too early", file_.string());
    done += size_t(got);
  }
  end_ += bytes.size();
  checksum_ = crc32(bytes, checksum_);

  const float* next = stored.data();
  const auto images = stored_images(rows);
  for (size_t i = 0; i < size_t(width) * size_t(count); ++i) {
    for (image::Image* image : images) {
      const auto components = size_t(image->channels());
      std::copy_n(next, components, &image->samples()[components * i]);
      next += components;
    }
  }
  return rows;
}

void RowStore::append(const Rows& rows) {
  if (descriptor_ < 0) descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("write", file_, errno);
  if (!dropped_rest_ && ::ftruncate(descriptor_, off_t(end_)) != 0) fail("write", file_, errno);
  dropped_rest_ = true;

  std::vector<float> stored;
  stored.reserve(floats_of(rows));
  const auto images = stored_images(rows);
  for (size_t i = 0; i < rows.color.sample_count() / 3; ++i) {
    for (const image::Image* image : images) {
      const float* first = &image->samples()[size_t(image->channels()) * i];
      stored.insert(stored.end(), first, first + image->channels());
    }
  }
  const auto bytes = std::as_bytes(std::span(stored));
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

}  // namespace eyeray::engine::film
