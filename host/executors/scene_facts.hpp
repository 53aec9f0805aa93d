// The facts about a packed scene that decide which code its kernels need.
#pragma once

#include <set>

#include "host/records/packer.hpp"

namespace eyeray::engine::executors {

// True if any texture of the material varies over a surface.
bool varies(const records::PackedScene& scene, const shader::Material& material);
// True if any triangle has normals at its corners.
bool any_smooth(const records::PackedScene& scene);
bool any_emits(const records::PackedScene& scene);
// True if a surface that a path may choose has a texture for its light.
bool any_emission_texture(const records::PackedScene& scene);
bool any_emits_in_front(const records::PackedScene& scene);
bool any_blends(const records::PackedScene& scene);
bool any_front_only(const records::PackedScene& scene);
// True if a coat's normal may be another than its surface's.
bool any_bent_coat(const records::PackedScene& scene);
// True if any material's microfacets are wider along one direction.
bool any_anisotropic(const records::PackedScene& scene);
// True if any diffuse material is not Lambert's.
bool any_rough_diffuse(const records::PackedScene& scene);
// True if light passes through any principled material, and for `transmits`, through any material.
bool any_principled_transmits(const records::PackedScene& scene);
bool transmits(const records::PackedScene& scene);
// True if `specular` or `specular_color` of any principled material is not the same everywhere.
bool any_specular_varies(const records::PackedScene& scene);
bool any_disperses(const records::PackedScene& scene);
bool any_dims(const records::PackedScene& scene);
bool any_scatters(const records::PackedScene& scene);
// True if any light has an angular size.
bool any_light_disk(const records::PackedScene& scene);
// The largest number of bounces of a path. It is 0 if the integrator follows none, or if it follows only
// reflections and refractions and no material has any.
uint32_t most_bounces(const records::PackedScene& scene);
// True if a path may split in two at a hit.
bool splits(const records::PackedScene& scene);
// The number of shadow rays at each hit.
uint32_t shadow_rays(const records::PackedScene& scene);
// True if paths draw random numbers on their way.
bool walks_at_random(const records::PackedScene& scene);

}  // namespace eyeray::engine::executors
