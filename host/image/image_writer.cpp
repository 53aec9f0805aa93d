#include "host/image/image_writer.hpp"

#include "host/core/error.hpp"
#include "host/image/image_file.hpp"
#include "host/image/row_encoder.hpp"

namespace eyeray::engine::image {

namespace {

std::unique_ptr<RowEncoder> make_encoder(ImageFormat format, AtomicFile& file, int width, int height,
                                         int channels) {
  switch (format) {
    case ImageFormat::png:
      return png_encoder(file, width, height, channels);
    case ImageFormat::pfm:
      return pfm_encoder(file, width, height, channels);
    case ImageFormat::hdr:
      return radiance_encoder(file, width, height, channels);
    case ImageFormat::exr:
      return exr_encoder(file, width, height, exr_channels(channels, false));
  }
  CHECK(false);
}

}  // namespace

ImageWriter::ImageWriter(const std::filesystem::path& path, int width, int height, int channels)
    : width_(width), channels_(channels), rows_left_(height) {
  CHECK(image_size_allowed(width, height));
  CHECK(channels == 1 || channels == 3 || channels == 4);
  if (channels == 4) check_has_alpha(path);
  const ImageFormat format = image_format(path);
  file_ = std::make_unique<AtomicFile>(path);
  encoder_ = make_encoder(format, *file_, width, height, channels);
}

ImageWriter::ImageWriter(const std::filesystem::path& path, int width, int height,
                         std::vector<ExrChannel> channels)
    : width_(width), channels_(int(channels.size())), rows_left_(height) {
  CHECK(image_size_allowed(width, height));
  CHECK(image_format(path) == ImageFormat::exr);
  file_ = std::make_unique<AtomicFile>(path);
  encoder_ = exr_encoder(*file_, width, height, std::move(channels));
}

ImageWriter::~ImageWriter() = default;
ImageWriter::ImageWriter(ImageWriter&&) noexcept = default;

void ImageWriter::write(const Image& rows) {
  CHECK_EQ(rows.width(), width_);
  CHECK_EQ(rows.channels(), channels_);
  CHECK_LE(rows.height(), rows_left_);
  rows_left_ -= rows.height();
  encoder_->write(rows);
}

void ImageWriter::finish() {
  CHECK_EQ(rows_left_, 0);
  encoder_->finish();
  file_->commit();
}

}  // namespace eyeray::engine::image
