#include "host/film/film.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"
#include "host/film/outliers.hpp"
#include "host/scene/luminance.hpp"

namespace eyeray::engine::film {

namespace {

constexpr size_t values_of_groups = 3 * groups_of_pixel;
constexpr int outlier_block = 4;  // pixels each way; a divisor of noise_block, so bands do not cut blocks
// No group of samples whose mean is at most this share of the luminance shown as 1 is an outlier.
constexpr double outlier_floor = 0.05;

}  // namespace

static_assert(sizeof(PixelTotals) == 40, "checkpoints hold it as it lies in memory");

Rows::Rows(int from, int width, int count, Channels channels_of_samples)
    : first(from), color(width, count, 3), channels(std::move(channels_of_samples)) {
  for (const Channel each : channels) values.emplace_back(width, count, each->components);
}

const image::Image& Rows::operator[](Channel channel) const {
  const auto found = std::ranges::find(channels, channel);
  CHECK(found != channels.end());
  return values[size_t(found - channels.begin())];
}

image::Image with_alpha(const Rows& rows) {
  const std::vector<float>& coverage = rows[channel_named("coverage")].samples();
  image::Image result(rows.color.width(), rows.color.height(), 4);
  for (size_t i = 0; i < coverage.size(); ++i) {
    std::copy_n(&rows.color.samples()[3 * i], 3, &result.samples()[4 * i]);
    result.samples()[4 * i + 3] = coverage[i];
  }
  return result;
}

void Film::reset(int width, int height, const Channels& channels, double shown_as_one, bool finds_outliers) {
  width_ = width;
  height_ = height;
  shown_as_one_ = shown_as_one;
  channels_ = channels;
  std::erase_if(channels_, [](Channel each) { return !each->of_samples(); });
  pixels_.assign(size_t(width) * size_t(height), {});
  sums_.resize(channels_.size());
  for (size_t i = 0; i < channels_.size(); ++i)
    sums_[i].assign(size_t(channels_[i]->of_samples()->sums) * pixels_.size(), 0);
  groups_.assign(finds_outliers ? pixels_.size() * values_of_groups : 0, 0);
}

void Film::add(const Rect& part, std::span<const PixelSample> samples,
               std::span<const AuxiliarySample> auxiliaries) {
  CHECK_EQ(samples.size(), size_t(part.pixels()));
  CHECK(auxiliaries.empty() ? !any_needs(channels_, Needs::auxiliary) : auxiliaries.size() == samples.size());
  CHECK(part.x + part.width <= width_ && part.y + part.height <= height_);
  const AuxiliarySample none;
  parallel_for(0, int(samples.size()), [&](int i) {
    const PixelSample& sample = samples[size_t(i)];
    const AuxiliarySample& auxiliary = auxiliaries.empty() ? none : auxiliaries[size_t(i)];
    const size_t at = index(part.x + i % part.width, part.y + i / part.width);
    PixelTotals& pixel = pixels_[at];
    if (!groups_.empty()) {
      float* const group = &groups_[at * values_of_groups + 3 * size_t(group_of(pixel.samples))];
      for (int c = 0; c < 3; ++c) group[c] += float(sample.color[c]);
    }
    pixel.color += sample.color;
    pixel.hits += sample.hits;
    pixel.rays += sample.rays;
    pixel.flags |= sample.flags | auxiliary.flags;
    const AddedSample added{sample, auxiliary, pixel.samples++};
    for (size_t c = 0; c < channels_.size(); ++c) {
      const OfSamples& values = *channels_[c]->of_samples();
      if (values.add) values.add(added, &sums_[c][at * size_t(values.sums)]);
    }
  });
}

void Film::set_finished(const Rect& part, bool finished) {
  for (int y = part.y; y < part.y + part.height; ++y)
    for (int x = part.x; x < part.x + part.width; ++x) pixels_[index(x, y)].finished = finished;
}

Outliers Film::leave_out_outliers() {
  CHECK(!groups_.empty());
  const int rows = (height_ + outlier_block - 1) / outlier_block;
  std::vector<Outliers> found(static_cast<size_t>(rows));
  parallel_for(0, rows, [&](int row) {
    const int y = row * outlier_block;
    for (int x = 0; x < width_; x += outlier_block)
      found[size_t(row)] += leave_out_outliers(
          {x, y, std::min(outlier_block, width_ - x), std::min(outlier_block, height_ - y)});
  });
  return std::accumulate(found.begin(), found.end(), Outliers(),
                         [](Outliers sum, const Outliers& each) { return sum += each; });
}

Outliers Film::leave_out_outliers(const Rect& block) {
  std::vector<size_t> indices;
  std::vector<PixelGroups> groups;
  for (int y = block.y; y < block.y + block.height; ++y) {
    for (int x = block.x; x < block.x + block.width; ++x) {
      const size_t at = index(x, y);
      indices.push_back(at);
      groups.push_back(
          {std::span(groups_).subspan(at * values_of_groups, values_of_groups), pixels_[at].samples});
    }
  }
  const std::vector<uint32_t> outliers = outliers_of(groups, outlier_floor * shown_as_one_);
  Outliers found;
  for (size_t i = 0; i < indices.size(); ++i) {
    if (outliers[i] == 0) continue;
    PixelTotals& pixel = pixels_[indices[i]];
    const double before = luminance(pixel.color);
    Vec3 others = pixel.color;
    double samples = pixel.samples;
    for (int group = 0; group < groups_of_pixel; ++group) {
      if (!(outliers[i] >> group & 1)) continue;
      others -= groups[i].sum(group);
      samples -= groups[i].samples_in(group);
    }
    const Vec3 mean = glm::max(others, Vec3(0.0)) / samples;
    for (int group = 0; group < groups_of_pixel; ++group) {
      if (!(outliers[i] >> group & 1)) continue;
      const LeftOut left{.sum = groups[i].sum(group),
                         .mean = mean,
                         .samples = double(groups[i].samples_in(group)),
                         .others = samples,
                         .first_half = group_is_in_first_half(group)};
      for (size_t c = 0; c < channels_.size(); ++c) {
        const OfSamples& values = *channels_[c]->of_samples();
        if (values.leave_out) values.leave_out(left, &sums_[c][indices[i] * size_t(values.sums)]);
      }
    }
    pixel.color = mean * double(pixel.samples);
    ++found.pixels;
    found.luminance += (before - luminance(pixel.color)) / double(pixel.samples);
  }
  return found;
}

uint64_t Film::samples() const {
  uint64_t sum = 0;
  for (const PixelTotals& pixel : pixels_) sum += pixel.samples;
  return sum;
}

double Film::noise(const Rect& block) const {
  const auto channel = std::ranges::find(channels_, channel_named("noise"));
  CHECK(channel != channels_.end());
  const std::vector<double>& squares = sums_[size_t(channel - channels_.begin())];
  double variances = 0, brightness = 0, pixels = 0;
  for (int y = block.y; y < block.y + block.height; ++y) {
    for (int x = block.x; x < block.x + block.width; ++x) {
      const PixelTotals& one = pixel(x, y);
      const double n = one.samples, sum = luminance(one.color);
      if (n == 0) continue;  // beside or below a shard's tile
      if (n < 2) return std::numeric_limits<double>::quiet_NaN();
      ++pixels;
      variances += std::max(0.0, squares[index(x, y)] - sum * sum / n) / (n * (n - 1));
      brightness += sum / n;
    }
  }
  return noise_of(variances, brightness, pixels, shown_as_one_);
}

void Film::fill_noise(int first, image::Image& rows) const {
  const int end = first + rows.height();
  const NoiseBlocks blocks(width_, height_);
  for (int row = first / noise_block; row * noise_block < end; ++row) {
    for (int column = 0; column < blocks.columns; ++column) {
      const Rect block = blocks.block(column, row);
      const auto value = float(noise(block));
      for (int y = std::max(first, block.y); y < std::min(end, block.y + block.height); ++y)
        std::fill_n(rows.pixel(block.x, y - first), block.width, value);
    }
  }
}

Rows Film::rows(int first, int count) const {
  Rows rows(first, width_, count, channels_);
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < width_; ++x) {
      const PixelTotals& totals = pixel(x, first + y);
      const double divisor = std::max(1u, unsigned{totals.samples});
      for (int c = 0; c < 3; ++c) rows.color.pixel(x, y)[c] = float(totals.color[c] / divisor);
      rows.flags |= totals.flags;
      rows.flagged_pixels += totals.flags != 0;
    }
  }
  for (size_t c = 0; c < channels_.size(); ++c) {
    const OfSamples& values = *channels_[c]->of_samples();
    if (!values.mean) {
      fill_noise(first, rows.values[c]);
      continue;
    }
    for (int y = 0; y < count; ++y)
      for (int x = 0; x < width_; ++x)
        values.mean(pixel(x, first + y), sums_[c].data() + index(x, first + y) * size_t(values.sums),
                    rows.values[c].pixel(x, y));
  }
  return rows;
}

std::vector<std::span<std::byte>> Film::parts() {
  std::vector<std::span<std::byte>> all{std::as_writable_bytes(std::span(pixels_))};
  for (std::vector<double>& sums : sums_) all.push_back(std::as_writable_bytes(std::span(sums)));
  if (!groups_.empty()) all.push_back(std::as_writable_bytes(std::span(groups_)));
  return all;
}

std::vector<std::span<const std::byte>> Film::parts() const {
  std::vector<std::span<const std::byte>> all{std::as_bytes(std::span(pixels_))};
  for (const std::vector<double>& sums : sums_) all.push_back(std::as_bytes(std::span(sums)));
  if (!groups_.empty()) all.push_back(std::as_bytes(std::span(groups_)));
  return all;
}

}  // namespace eyeray::engine::film
