// Adaptive sampling: which pixels of a band still need samples.
#pragma once

#include <bit>
#include <vector>

#include "host/core/rect.hpp"
#include "host/film/film.hpp"

namespace eyeray::engine::render {

// Blocks (film/noise.hpp) finish when their noise and their neighbours' is no more than the target. They are
// judged seldom, when the number of samples a pixel is a power of two. To stop as soon as the samples happen
// to agree would bias the picture: Kirk and Arvo, "Unbiased sampling techniques for image synthesis"
// (SIGGRAPH 1991).
class AdaptiveSampling {
 public:
  // Starts with the blocks of `sums` that are not finished. `first_judgement`: the least samples a pixel at
  // which blocks finish, a power of two. `resumes`: whether finished blocks go on if they are found noisy
  // later.
  AdaptiveSampling(double target, uint64_t first_judgement, bool resumes, const film::Film& sums);

  bool judges_after(uint64_t samples) const {
    return samples >= first_judgement_ && std::has_single_bit(samples);
  }
  // Finishes the blocks that have little enough noise, and resumes others if it may. `noise`: that of each
  // block, row by row.
  void judge(film::Film& sums, const std::vector<double>& noise);
  bool finished() const { return left_ == 0; }
  // Rectangles, in pixels of the band, of the unfinished blocks in rows [row, row + height). judge() leaves
  // small gaps between blocks of a row unfinished, since each rectangle is a dispatch.
  std::vector<Rect> left(int row, int height) const;
  // An estimate of the samples that all pixels together still need, at most `most` for each pixel: noise
  // falls with the square root of the number of samples.
  double samples_to_go(const std::vector<double>& noise, uint64_t samples, int most) const;

 private:
  char* row_of_blocks(int y) { return &active_[blocks_.index(0, y)]; }
  const char* row_of_blocks(int y) const { return &active_[blocks_.index(0, y)]; }

  double target_;
  uint64_t first_judgement_;
  bool resumes_;
  film::NoiseBlocks blocks_;  // blocks of the band
  std::vector<char> active_;  // blocks, row by row
  int64_t left_ = 0;
};

}  // namespace eyeray::engine::render
