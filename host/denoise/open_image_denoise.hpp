// Open Image Denoise, a library of Intel's, where it is installed.
#pragma once

#include "host/denoise/denoise.hpp"

namespace eyeray::engine::denoise {

// Removes the noise of a picture by the CPU device of Open Image Denoise, from colour, albedo and normal.
// Pixels that are not finite stay as they are. The result has no `errors`: the library estimates none. It
// depends on the library's version and on the processor.
//
// The library is loaded at run time, version 2 or 1: libOpenImageDenoise.so.2 and so on, or the file that the
// environment variable EYERAY_OPEN_IMAGE_DENOISE names. Error (bad_input) if it is not there, or if it fails.
DenoisedPicture denoise_by_oidn(const NoisyPicture& picture);

// Error as for denoise_by_oidn if the library cannot be used; to be called before a picture is rendered for
// it.
void check_for_oidn();

}  // namespace eyeray::engine::denoise
