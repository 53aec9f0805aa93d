#include "host/render/adaptive.hpp"

#include <algorithm>

namespace eyeray::engine::render {
namespace {

// The widest gap, in blocks of a row, that is filled between unfinished blocks: the blocks in it go on
// although they could finish, since a separate dispatch costs a device more.
constexpr int widest_filled_gap = 4;

}  // namespace

AdaptiveSampling::AdaptiveSampling(double target, uint64_t first_judgement, bool resumes,
                                   const film::Film& sums)
    : target_(target),
      first_judgement_(first_judgement),
      resumes_(resumes),
      blocks_(sums.width(), sums.height()),
      active_(size_t(blocks_.columns) * size_t(blocks_.rows)) {
  for (int y = 0; y < blocks_.rows; ++y)
    for (int x = 0; x < blocks_.columns; ++x)
      row_of_blocks(y)[x] = !sums.finished(x * film::noise_block, y * film::noise_block);
  left_ = std::ranges::count(active_, 1);
}

void AdaptiveSampling::judge(film::Film& sums, const std::vector<double>& noise) {
  const int columns = blocks_.columns, rows = blocks_.rows;
  const auto noisy_around = [&](int x, int y) {
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, rows - 1); ++j)
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, columns - 1); ++i)
        if (!(noise[blocks_.index(i, j)] <= target_)) return true;
    return false;
  };
  for (int y = 0; y < rows; ++y) {
    char* const blocks = row_of_blocks(y);
    std::vector<char> stay(blocks, blocks + columns);
    for (int x = 0; x < columns; ++x) stay[size_t(x)] = (blocks[x] || resumes_) && noisy_around(x, y);
    for (int x = 0, last = -1; x < columns; ++x) {
      if (!stay[size_t(x)]) continue;
      const bool fill = last >= 0 && x - last - 1 <= widest_filled_gap &&
                        std::all_of(blocks + last, blocks + x, [](char active) { return active; });
      if (fill) std::fill(stay.begin() + last, stay.begin() + x, 1);
      last = x;
    }
    for (int x = 0; x < columns; ++x)
      if (blocks[x] != stay[size_t(x)]) sums.set_finished(blocks_.block(x, y), !stay[size_t(x)]);
    std::ranges::copy(stay, blocks);
  }
  left_ = std::ranges::count(active_, 1);
}

std::vector<Rect> AdaptiveSampling::left(int row, int height) const {
  std::vector<Rect> parts;
  for (int y = row / film::noise_block; y * film::noise_block < row + height; ++y) {
    const int top = std::max(row, y * film::noise_block);
    const int bottom = std::min({row + height, (y + 1) * film::noise_block, blocks_.height});
    const char* const blocks = row_of_blocks(y);
    for (int x = 0; x < blocks_.columns;) {
      const int begin = x;
      while (x < blocks_.columns && blocks[x]) ++x;
      if (x == begin) {
        ++x;
        continue;
      }
      const int first = begin * film::noise_block, last = std::min(x * film::noise_block, blocks_.width);
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

double AdaptiveSampling::samples_to_go(const std::vector<double>& noise, uint64_t samples, int most) const {
  double sum = 0;
  for (int y = 0; y < blocks_.rows; ++y) {
    for (int x = 0; x < blocks_.columns; ++x) {
      if (!row_of_blocks(y)[x]) continue;
      // The block goes on to the first judgement after `enough` samples.
      const double ratio = noise[blocks_.index(x, y)] / target_;
      const double enough = double(samples) * ratio * ratio;
      double judged = std::max(double(first_judgement_), 2.0 * double(samples));
      while (judged < enough && judged < most) judged *= 2;
      sum += double(blocks_.block(x, y).pixels()) * (std::min(judged, double(most)) - double(samples));
    }
  }
  return sum;
}

}  // namespace eyeray::engine::render
