#include "host/dev/board.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "host/core/escaped_text.hpp"
#include "host/image/image_file.hpp"

namespace eyeray::engine::dev {

namespace {

// The tone in a message; none if it has none, or no valid one.
image::Tone tone_of(const Json& message) {
  const auto found = message.find("tone");
  if (found == message.end() || !found->is_object()) return {};
  const auto curve = found->value("curve", size_t{0});
  if (curve >= std::size(image::tone_curves)) return {};
  return {found->value("exposure", 0.0), image::ToneCurve(curve), found->value("white_balance", 0.0)};
}

}  // namespace

void Board::publish() {
  ++version_;
  changed_.notify_all();
}

void Board::put_rows(const Message& message) {
  const auto number = [&](const char* key) { return message.json.value(key, int64_t{-1}); };
  const int64_t width = number("width"), height = number("height"), stride = number("stride");
  const int64_t row = number("row"), rows = number("rows"), channels = number("channels");
  if (!image::image_size_allowed(width, height) || stride < 1 || row < 0 || rows < 1) return;
  if (stride > std::max(width, int64_t{64}) || row > height || rows > height) return;
  const int64_t shown_as = number("shown_as");
  const bool has_alpha = channels == 4 && shown_as < 0;
  if (channels != 1 && channels != 3 && !has_alpha) return;
  if (shown_as > int64_t(image::FalseColor::position)) return;
  const image::Tone tone = tone_of(message.json);
  const int64_t columns = (width + stride - 1) / stride;
  if (row + rows > (height + stride - 1) / stride) return;
  if (message.bytes.size() != size_t(columns * rows * channels) * sizeof(float)) return;

  const std::lock_guard lock(mutex_);
  const std::string view = message.json.value("view", "");
  image::Image& image = pictures_[view].image;
  if (image.width() != width || image.height() != height || image.channels() != channels) {
    image = image::Image(int(width), int(height), int(channels));
    std::ranges::fill(image.samples(), std::numeric_limits<float>::quiet_NaN());  // not rendered yet
    pictures_[view].rows.assign(size_t(height), Row());
  }
  const int64_t last = std::min(height, (row + rows) * stride);
  for (int64_t y = row * stride; y < last; ++y) {
    pictures_[view].rows[size_t(y)] = {number("generation"), number("sample"), stride};
    for (int64_t x = 0; x < width; ++x) {
      const int64_t from = (y / stride - row) * columns + x / stride;
      const size_t pixel = size_t(channels) * sizeof(float);
      std::memcpy(image.pixel(int(x), int(y)), &message.bytes[size_t(from) * pixel], pixel);
    }
  }
  pictures_[view].tone = tone;
  if (shown_as >= 0) pictures_[view].shown_as = image::FalseColor(shown_as);
  Json& version = status_["pictures"][view];
  version = version.is_number() ? version.get<uint64_t>() + 1 : 1;
  publish();
}

std::optional<Board::Picture> Board::picture(const std::string& view) const {
  const std::lock_guard lock(mutex_);
  const auto found = pictures_.find(view);
  return found == pictures_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<Board::Picture> Board::difference() const {
  std::optional<Picture> gpu = picture("gpu");
  const std::optional<Picture> reference = picture("reference");
  if (!gpu || !reference || !reference->image.same_size(gpu->image)) return std::nullopt;
  const size_t row_floats = size_t(gpu->image.width()) * size_t(gpu->image.channels());
  for (int y = 0; y < gpu->image.height(); ++y) {
    const bool comparable = gpu->rows[size_t(y)] == reference->rows[size_t(y)];
    const std::span<float> a(gpu->image.pixel(0, y), row_floats);
    const std::span<const float> b(reference->image.pixel(0, y), a.size());
    for (size_t i = 0; i < a.size(); ++i) {
      if (!comparable)
        a[i] = std::numeric_limits<float>::quiet_NaN();
      else if (a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i])))
        a[i] = 0;
      else if (a[i] = std::abs(a[i] - b[i]); std::isnan(a[i]))
        a[i] = std::numeric_limits<float>::infinity();
    }
  }
  if (gpu->image.channels() == 4)  // only colours show
    for (size_t i = 3; i < gpu->image.sample_count(); i += 4) gpu->image.samples()[i] = 1;
  gpu->tone = {};
  return gpu;
}

void Board::put_probe(Json answer) {
  const std::lock_guard lock(mutex_);
  probe_ = std::move(answer);
  status_["probes"] = status_.value("probes", 0) + 1;
  publish();
}

Json Board::probe() const {
  const std::lock_guard lock(mutex_);
  return probe_;
}

std::optional<std::string> Board::next_status(uint64_t& seen, double seconds) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                    [&] { return closed_ || version_ != seen; });
  if (closed_ || version_ == seen) return std::nullopt;
  seen = version_;
  return json_text(status_);
}

void Board::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

bool Board::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

}  // namespace eyeray::engine::dev
