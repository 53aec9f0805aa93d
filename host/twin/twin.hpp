// The twin: the shaders compiled as C++, float32, uncontracted. Where it differs from the GPU, the driver,
// the compiler, the upload or the packing is at fault; where it differs from the reference, the algorithm or
// its numerics.
#pragma once

#include "host/core/ray_tree.hpp"
#include "host/records/packer.hpp"
#include "host/twin/scene_view.hpp"

namespace eyeray::engine::twin {

// The twin of eyeray's own shaders.
extern "C" const Functions eyeray_twin;

// The results must not outlive the scene or the recorder.
SceneView view_of(const records::PackedScene& scene);
Spectator spectator_for(RayRecorder& recorder);
// Records only the decisions of random paths: each `event` that is PROBEd.
Spectator spectator_for(std::vector<uint32_t>& events);

}  // namespace eyeray::engine::twin
