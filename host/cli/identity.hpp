// What decides a picture's bits, for its checkpoint and for its parts.
#pragma once

#include <vector>

#include "host/cli/picture.hpp"
#include "host/render/checkpoint.hpp"

namespace eyeray::cli {

// Error (file_io) when a file of the scene or a shader cannot be read any more.
std::vector<render::IdentityPart> identity_of(const PictureRequest& request, const Scene& scene,
                                              const executors::Executor& executor);
// The same for a part, which other machines' are to go with: of the device only what decides bits.
std::vector<render::IdentityPart> identity_of_parts(const PictureRequest& request, const Scene& scene,
                                                    const executors::Executor& executor);

}  // namespace eyeray::cli
