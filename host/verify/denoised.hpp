// Gates A and B of denoising.
#pragma once

#include <string>
#include <vector>

#include "host/compare/denoised_result.hpp"
#include "host/executors/executor.hpp"
#include "host/image/noisy_picture.hpp"

namespace eyeray::engine::verify {

// The picture of one executor, with the noise and without.
struct DenoisedFrame {
  image::NoisyPicture noisy;
  image::DenoisedPicture denoised;
};

// Removes the picture's noise as the executor does: by the kernels of its device, unless
// ProfileOptions::denoise has another way, or by the processor.
DenoisedFrame denoised_frame(image::NoisyPicture noisy, const executors::Executor& executor,
                             executors::ExecutorOptions options);

// Compares each picture with the first one, and with the reference's. `names`: the executors. `area`: the
// part of the whole picture that they show.
std::vector<compare::DenoisedResult> compare_denoised(const std::vector<DenoisedFrame>& frames,
                                                      const std::vector<std::string>& names,
                                                      const Rect& area);

}  // namespace eyeray::engine::verify
