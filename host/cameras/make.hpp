// Projections made in code, by tests; a scene file's go through their CameraType.
#pragma once

#include "host/scene/camera.hpp"

namespace eyeray::engine::cameras {

std::shared_ptr<const Projection> make_projection(const PerspectiveCamera& values);
std::shared_ptr<const Projection> make_projection(const OrthographicCamera& values);
std::shared_ptr<const Projection> make_projection(const FisheyeCamera& values);
std::shared_ptr<const Projection> make_projection(const PanoramaCamera& values);
std::shared_ptr<const Projection> make_projection(const CylindricalCamera& values);
// `formula`: a camera's.
std::shared_ptr<const Projection> make_projection(std::shared_ptr<const formula::Formula> formula);

}  // namespace eyeray::engine::cameras
