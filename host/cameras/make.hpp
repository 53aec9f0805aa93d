// Projections made in code, by tests. Those of scene files are made by their CameraType.
#pragma once

#include "host/scene/camera.hpp"

namespace eyeray::engine::cameras {

std::shared_ptr<const Projection> make_projection(const PerspectiveCamera& values);
std::shared_ptr<const Projection> make_projection(const OrthographicCamera& values);
std::shared_ptr<const Projection> make_projection(const FisheyeCamera& values);
std::shared_ptr<const Projection> make_projection(const PanoramaCamera& values);
std::shared_ptr<const Projection> make_projection(const CylindricalCamera& values);
// `formula`: the function of a camera.
std::shared_ptr<const Projection> make_projection(std::shared_ptr<const formula::Formula> formula);

}  // namespace eyeray::engine::cameras
