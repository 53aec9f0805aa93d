#include "host/session/layered_file.hpp"

#include <algorithm>

#include "host/image/image_writer.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::session {
namespace {

// The number of values assembled at a time.
constexpr int assembled_samples = 1 << 22;

}  // namespace

LayeredFile::LayeredFile(fs::path path, const film::Channels& aovs, int width, int height,
                         std::vector<image::ExrChannel> color)
    : path_(std::move(path)), width_(width), height_(height), waiting_(path_) {
  add(std::move(color));
  for (const film::Channel aov : aovs) {
    std::vector<image::ExrChannel> channels;
    for (std::string& name : film::layer_components(aov)) channels.push_back({std::move(name)});
    add(std::move(channels));
  }
}

uint64_t LayeredFile::row_bytes(const Layer& layer) const {
  return uint64_t(width_) * layer.channels.size() * sizeof(float);
}

void LayeredFile::add(std::vector<image::ExrChannel> channels) {
  const uint64_t begin =
      layers_.empty() ? 0 : layers_.back().begin + row_bytes(layers_.back()) * uint64_t(height_);
  layers_.push_back({std::move(channels), begin});
}

void LayeredFile::write(Layer& layer, const image::Image& rows) {
  // Only the first channels of the image are kept.
  const size_t kept = layer.channels.size(), channels = size_t(rows.channels());
  std::vector<float> samples(size_t(width_) * size_t(rows.height()) * kept);
  for (size_t i = 0; i < samples.size(); ++i) samples[i] = rows.samples()[i / kept * channels + i % kept];
  waiting_.write_at(layer.begin + uint64_t(layer.rows) * row_bytes(layer), std::as_bytes(std::span(samples)));
  layer.rows += rows.height();
}

// Reads the layer's rows from `first` on into the channels of `rows` from `channel` on.
void LayeredFile::read(const Layer& layer, int first, image::Image& rows, size_t channel) const {
  const size_t kept = layer.channels.size(), channels = size_t(rows.channels());
  std::vector<float> samples(size_t(width_) * size_t(rows.height()) * kept);
  waiting_.read_at(layer.begin + uint64_t(first) * row_bytes(layer),
                   std::as_writable_bytes(std::span(samples)));
  for (size_t i = 0; i < samples.size(); ++i)
    rows.samples()[i / kept * channels + channel + i % kept] = samples[i];
}

void LayeredFile::finish(std::vector<fs::path>& files, bool with_aovs) {
  const std::span layers = std::span(layers_).first(with_aovs ? layers_.size() : 1);
  std::vector<image::ExrChannel> channels;
  for (const Layer& layer : layers) {
    CHECK_EQ(layer.rows, height_);
    channels.insert(channels.end(), layer.channels.begin(), layer.channels.end());
  }

  image::ImageWriter writer(path_, width_, height_, channels);
  for (int row = 0; row < height_;) {
    const int some = std::max(1, assembled_samples / (width_ * int(channels.size())));
    image::Image rows(width_, std::min(some, height_ - row), int(channels.size()));
    size_t channel = 0;
    for (const Layer& layer : layers) {
      read(layer, row, rows, channel);
      channel += layer.channels.size();
    }
    writer.write(rows);
    row += rows.height();
  }
  writer.finish();
  files.push_back(path_);
}

}  // namespace eyeray::engine::session
