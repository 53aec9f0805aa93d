// Adaptive sampling: which pixels of a band still need samples.
#pragma once

#include <bit>
#include <vector>

#include "host/core/rect.hpp"
#include "host/film/film.hpp"

namespace eyeray::engine::render {

// Blocks of `film::noise_block` × `film::noise_block` pixels leave when their noise and their neighbours'
// (Film::noise) is no more than the target. They are judged seldom, after 64, 128, 256, … samples a
// pixel: who stops as soon as the samples happen to agree is biased (Kirk and Arvo, "Unbiased sampling
// techniques for image synthesis", SIGGRAPH 1991).
class AdaptiveSampling {
 public:
  // Starts with the blocks of `sums` that are not finished.
  AdaptiveSampling(double target, const film::Film& sums);

  static constexpr uint64_t first_judgement = 64;
  static bool judges_after(uint64_t samples) {
    return samples >= first_judgement && std::has_single_bit(samples);
  }
  // Finishes the blocks that are good.
  void judge(film::Film& sums);
  bool finished() const { return left_ == 0; }
  // Rectangles, in pixels of the band, of the unfinished part of its rows [row, row + height). Gaps between
  // blocks of a row are filled where they are small, for a device's sake.
  std::vector<Rect> left(int row, int height) const;
  // About how many samples of pixels are still to be taken, where each may have `most`: noise falls as their
  // root.
  double samples_to_go(const film::Film& sums, uint64_t samples, int most) const;

 private:
  Rect block(int x, int y) const;
  char* row_of_blocks(int y) { return &active_[size_t(y) * size_t(columns_)]; }
  const char* row_of_blocks(int y) const { return &active_[size_t(y) * size_t(columns_)]; }

  double target_;
  int width_, height_;        // of the band, in pixels
  int columns_, rows_;        // of blocks
  std::vector<char> active_;  // blocks, row by row
  int64_t left_ = 0;
};

}  // namespace eyeray::engine::render
