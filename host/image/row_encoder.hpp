// The encoders behind ImageWriter: each writes rows of a picture, as they arrive, to a file of its format.
// Used only in host/image.
#pragma once

#include <memory>

#include "host/core/atomic_file.hpp"
#include "host/image/exr_file.hpp"
#include "host/image/image.hpp"

namespace eyeray::engine::image {

class RowEncoder {
 public:
  virtual ~RowEncoder() = default;

  // The next rows, from the top down.
  virtual void write(const Image& rows) = 0;
  // Writes the data behind the last row.
  virtual void finish() {}
};

// Each encoder writes a picture of 1 or 3 channels, and .png and .exr also one of 4, header included, to
// `file`, which must outlive it.
std::unique_ptr<RowEncoder> png_encoder(AtomicFile& file, int width, int height, int channels);
std::unique_ptr<RowEncoder> pfm_encoder(AtomicFile& file, int width, int height, int channels);
std::unique_ptr<RowEncoder> radiance_encoder(AtomicFile& file, int width, int height, int channels);
// `channels`: the names and types of the file's channels.
std::unique_ptr<RowEncoder> exr_encoder(AtomicFile& file, int width, int height,
                                        std::vector<ExrChannel> channels);

}  // namespace eyeray::engine::image
