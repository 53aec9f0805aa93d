// Lights built in code, by tests. Those of scene files are made by their LightType.
#pragma once

#include "host/scene/light.hpp"

namespace eyeray::engine::lights {

std::unique_ptr<Light> make_light(const PointLight& values);
std::unique_ptr<Light> make_light(const DirectionalLight& values);
std::unique_ptr<Light> make_light(const SpotLight& values);

}  // namespace eyeray::engine::lights
