#include "host/render/adaptive.hpp"

#include <algorithm>

#include "host/core/parallel_for.hpp"

namespace eyeray::engine::render {
namespace {

// The widest gap, in blocks of a row, that is filled between unfinished blocks: the blocks in it go on
// although they could finish, since a separate dispatch costs a device more.
constexpr int widest_filled_gap = 4;

int blocks_of(int pixels) {
  return (pixels + film::noise_block - 1) / film::noise_block;
}

}  // namespace

AdaptiveSampling::AdaptiveSampling(double target, const film::Film& sums)
    : target_(target),
      width_(sums.width()),
      height_(sums.height()),
      columns_(blocks_of(width_)),
      rows_(blocks_of(height_)),
      active_(size_t(columns_) * size_t(rows_)) {
  for (int y = 0; y < rows_; ++y)
    for (int x = 0; x < columns_; ++x)
      row_of_blocks(y)[x] = !sums.finished(x * film::noise_block, y * film::noise_block);
  left_ = std::ranges::count(active_, 1);
}

Rect AdaptiveSampling::block(int x, int y) const {
  const int left = x * film::noise_block, top = y * film::noise_block;
  return {left, top, std::min(film::noise_block, width_ - left), std::min(film::noise_block, height_ - top)};
}

void AdaptiveSampling::judge(film::Film& sums) {
  std::vector<char> noisy(active_.size());
  parallel_for(0, rows_, [&](int y) {
    for (int x = 0; x < columns_; ++x)
      noisy[size_t(y) * size_t(columns_) + size_t(x)] = !(sums.noise(block(x, y)) <= target_);
  });
  const auto noisy_around = [&](int x, int y) {
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, rows_ - 1); ++j)
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, columns_ - 1); ++i)
        if (noisy[size_t(j) * size_t(columns_) + size_t(i)]) return true;
    return false;
  };
  for (int y = 0; y < rows_; ++y) {
    char* const blocks = row_of_blocks(y);
    std::vector<char> stay(blocks, blocks + columns_);
    for (int x = 0; x < columns_; ++x) stay[size_t(x)] = blocks[x] && noisy_around(x, y);
    for (int x = 0, last = -1; x < columns_; ++x) {
      if (!stay[size_t(x)]) continue;
      const bool fill = last >= 0 && x - last - 1 <= widest_filled_gap &&
                        std::all_of(blocks + last, blocks + x, [](char active) { return active; });
      if (fill) std::fill(stay.begin() + last, stay.begin() + x, 1);
      last = x;
    }
    for (int x = 0; x < columns_; ++x)
      if (blocks[x] && !stay[size_t(x)]) sums.finish(block(x, y));
    std::ranges::copy(stay, blocks);
  }
  left_ = std::ranges::count(active_, 1);
}

std::vector<Rect> AdaptiveSampling::left(int row, int height) const {
  std::vector<Rect> parts;
  for (int y = row / film::noise_block; y * film::noise_block < row + height; ++y) {
    const int top = std::max(row, y * film::noise_block);
    const int bottom = std::min({row + height, (y + 1) * film::noise_block, height_});
    const char* const blocks = row_of_blocks(y);
    for (int x = 0; x < columns_;) {
      const int begin = x;
      while (x < columns_ && blocks[x]) ++x;
      if (x == begin) {
        ++x;
        continue;
      }
      const int first = begin * film::noise_block, last = std::min(x * film::noise_block, width_);
      // Merge with a rectangle right above that has the same columns.
      const auto above = std::ranges::find_if(parts, [&](const Rect& part) {
        return part.x == first && part.width == last - first && part.y + part.height == top;
      });
      if (above != parts.end())
        above->height += bottom - top;
      else
        parts.push_back({first, top, last - first, bottom - top});
    }
  }
  return parts;
}

double AdaptiveSampling::samples_to_go(const film::Film& sums, uint64_t samples, int most) const {
  double sum = 0;
  for (int y = 0; y < rows_; ++y) {
    for (int x = 0; x < columns_; ++x) {
      if (!row_of_blocks(y)[x]) continue;
      // The block goes on to the first judgement after `enough` samples.
      const double ratio = sums.noise(block(x, y)) / target_;
      const double enough = double(samples) * ratio * ratio;
      double judged = std::max(double(first_judgement), 2.0 * double(samples));
      while (judged < enough && judged < most) judged *= 2;
      sum += double(block(x, y).pixels()) * (std::min(judged, double(most)) - double(samples));
    }
  }
  return sum;
}

}  // namespace eyeray::engine::render
