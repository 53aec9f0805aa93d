// Adaptive sampling: which pixels of a band still need samples.
#pragma once

#include <bit>
#include <vector>

#include "host/core/rect.hpp"
#include "host/film/film.hpp"

namespace eyeray::engine::render {

// Blocks of `film::noise_block` × `film::noise_block` pixels finish when their noise and their neighbours'
// (Film::noise) is no more than the target. They are judged seldom, after 64, 128, 256, … samples a pixel:
// stopping as soon as the samples happen to agree would bias the picture (Kirk and Arvo, "Unbiased sampling
// techniques for image synthesis", SIGGRAPH 1991).
class AdaptiveSampling {
 public:
  // Starts with the blocks of `sums` that are not finished.
  AdaptiveSampling(double target, const film::Film& sums);

  static constexpr uint64_t first_judgement = 64;
  static bool judges_after(uint64_t samples) {
    return samples >= first_judgement && std::has_single_bit(samples);
  }
  // Finishes the blocks that have little enough noise.
  void judge(film::Film& sums);
  bool finished() const { return left_ == 0; }
  // Rectangles, in pixels of the band, of the unfinished blocks in rows [row, row + height). judge() leaves
  // small gaps between blocks of a row unfinished, since each rectangle is a dispatch.
  std::vector<Rect> left(int row, int height) const;
  // An estimate of the samples that all pixels together still need, at most `most` for each pixel: noise
  // falls with the square root of the number of samples.
  double samples_to_go(const film::Film& sums, uint64_t samples, int most) const;

 private:
  Rect block(int x, int y) const;
  char* row_of_blocks(int y) { return &active_[size_t(y) * size_t(columns_)]; }
  const char* row_of_blocks(int y) const { return &active_[size_t(y) * size_t(columns_)]; }

  double target_;
  int width_, height_;        // the size of the band, in pixels
  int columns_, rows_;        // the numbers of blocks
  std::vector<char> active_;  // blocks, row by row
  int64_t left_ = 0;
};

}  // namespace eyeray::engine::render
