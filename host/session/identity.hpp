// The facts that decide a picture's bits, for its checkpoint and for its parts.
#pragma once

#include <vector>

#include "host/render/checkpoint.hpp"
#include "host/session/output.hpp"

namespace eyeray::engine::session {

// Error (file_io) when a file of the scene or a shader cannot be read any more.
std::vector<render::IdentityPart> identity_of_checkpoint(const Plan& plan);
// The identity of a part, which must match those of other machines: it names only the device's properties
// that decide bits.
std::vector<render::IdentityPart> identity_of_part(const Plan& plan);

}  // namespace eyeray::engine::session
