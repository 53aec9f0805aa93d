// The brightness of a picture's blocks.
#pragma once

#include "host/denoise/planes.hpp"
#include "host/image/image.hpp"

namespace eyeray::engine::denoise {

constexpr int block_size = 64;  // pixels each way; the last ones of a row or column may be smaller

// Scales `picture` smoothly so that the mean of each channel in each block is that of `noisy`, to 0.1 %.
// `valid`: one plane, 0 for pixels that do not count and are not scaled. Blocks in which one of the two is
// black stay as they are.
void keep_block_means(const image::Image& noisy, const Planes& valid, image::Image& picture);

}  // namespace eyeray::engine::denoise
