// A clear sky over a spherical, matt ground, as light from all around, and its sun as a separate light.
// Hillaire: A Scalable and Production Ready Sky and Atmosphere Rendering Technique, EGSR 2020; its atmosphere
// is that of Bruneton and Neyret: Precomputed Atmospheric Scattering, EGSR 2008.
#pragma once

#include <memory>
#include <optional>

#include "host/scene/environment.hpp"
#include "host/scene/light.hpp"

namespace eyeray::engine::lights {

struct SkySettings {
  Vec3 to_sun{0, 1, 0};  // unit; may point below the horizon
  Vec3 ground{0.3};      // its albedo
  // Beyond the atmosphere, a surface perpendicular to the sun has the irradiance of intensity `scale`.
  Vec3 scale{1};
};

struct Sky {
  std::shared_ptr<EnvironmentMap> map;
  std::optional<DirectionalLight> sun;  // none below the horizon
};

// Takes one or two tenths of a second.
Sky make_sky(const SkySettings& settings);

}  // namespace eyeray::engine::lights
