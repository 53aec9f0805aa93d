// The facts that decide a picture's bits, as the identity of its checkpoint and of its parts.
#pragma once

#include <vector>

#include "host/render/checkpoint.hpp"
#include "host/session/output.hpp"

namespace eyeray::engine::session {

// The identity of a checkpoint. Error (file_io) if a file of the scene or a shader can no longer be read.
std::vector<render::IdentityPart> identity_of_checkpoint(const Plan& plan);
// The identity of a part, which must match those of other machines: it names only the device's properties
// that decide bits.
std::vector<render::IdentityPart> identity_of_part(const Plan& plan);

}  // namespace eyeray::engine::session
