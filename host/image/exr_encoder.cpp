#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfThreading.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <thread>

#include "host/core/error.hpp"
#include "host/image/row_encoder.hpp"

namespace eyeray::engine::image {

namespace {

// The library writes its table of offsets in a destructor and drops any error there: this stream keeps the
// error.
class FileStream final : public Imf::OStream {
 public:
  explicit FileStream(AtomicFile& file) : Imf::OStream("picture"), file_(file) {}

  void write(const char bytes[], int count) override {
    try {
      file_.write_at(at_, std::as_bytes(std::span(bytes, size_t(count))));
    } catch (...) {
      failure_ = std::current_exception();
      throw;
    }
    at_ += uint64_t(count);
  }
  uint64_t tellp() override { return at_; }
  void seekp(uint64_t at) override { at_ = at; }

  void check() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  AtomicFile& file_;
  uint64_t at_ = 0;
  std::exception_ptr failure_;
};

Imf::Header header_of(int width, int height, const std::vector<ExrChannel>& channels) {
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const ExrChannel& channel : channels)
    header.channels().insert(channel.name, Imf::Channel(channel.half ? Imf::HALF : Imf::FLOAT));
  return header;
}

// Converts to half: finite values stay finite.
half to_half(float value) {
  constexpr float most = HALF_MAX;
  return half(std::isfinite(value) ? std::clamp(value, -most, most) : value);
}

// The number of threads with which the library compresses blocks of 16 rows in parallel, if it gets several
// blocks at a time.
int compressing_threads() {
  static const int threads = [] {
    const unsigned cores = std::thread::hardware_concurrency();
    const int count = cores > 1 ? int(std::min(cores, 16u)) : 0;
    Imf::setGlobalThreadCount(count);
    return count;
  }();
  return threads;
}

class ExrEncoder final : public RowEncoder {
 public:
  ExrEncoder(AtomicFile& file, int width, int height, std::vector<ExrChannel> channels)
      : channels_(std::move(channels)),
        stream_(file),
        file_(std::make_unique<Imf::OutputFile>(stream_, header_of(width, height, channels_),
                                                compressing_threads())) {}

  void write(const Image& rows) override {
    const auto in_row = size_t(rows.width()), pixels = in_row * size_t(rows.height());
    std::vector<std::vector<half>> halves(channels_.size());
    const auto slice = [&](Imf::PixelType type, const void* first, size_t stride) {
      // The library only reads from the slice, and counts rows from the picture's top.
      return Imf::Slice::Make(type, const_cast<void*>(first), Imath::V2i(0, file_->currentScanLine()),
                              rows.width(), rows.height(), stride, stride * in_row);
    };
    Imf::FrameBuffer buffer;
    for (size_t c = 0; c < channels_.size(); ++c) {
      const float* samples = rows.samples().data() + c;
      if (channels_[c].half) {
        halves[c].resize(pixels);
        for (size_t i = 0; i < pixels; ++i) halves[c][i] = to_half(samples[i * channels_.size()]);
        buffer.insert(channels_[c].name, slice(Imf::HALF, halves[c].data(), sizeof(half)));
      } else {
        buffer.insert(channels_[c].name, slice(Imf::FLOAT, samples, channels_.size() * sizeof(float)));
      }
    }
    file_->setFrameBuffer(buffer);
    file_->writePixels(rows.height());
  }

  void finish() override {
    file_.reset();
    stream_.check();
  }

 private:
  std::vector<ExrChannel> channels_;
  FileStream stream_;
  std::unique_ptr<Imf::OutputFile> file_;
};

}  // namespace

std::vector<ExrChannel> exr_channels(int channels, bool half) {
  if (channels == 1) return {{"Y", half}};
  std::vector<ExrChannel> all{{"R", half}, {"G", half}, {"B", half}};
  if (channels == 4) all.push_back({"A", half});
  return all;
}

std::unique_ptr<RowEncoder> exr_encoder(AtomicFile& file, int width, int height,
                                        std::vector<ExrChannel> channels) {
  return std::make_unique<ExrEncoder>(file, width, height, std::move(channels));
}

}  // namespace eyeray::engine::image
