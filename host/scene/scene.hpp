// The scene: checked float64 values, as in the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "host/core/vec.hpp"
#include "host/image/tone.hpp"
#include "host/scene/camera.hpp"
#include "host/scene/group.hpp"
#include "host/scene/light.hpp"
#include "host/scene/material.hpp"
#include "host/scene/medium_extent.hpp"
#include "host/scene/mesh.hpp"
#include "host/scene/shape.hpp"

namespace eyeray::engine {

// The rows of registries (scene/sampler.hpp, scene/integrator.hpp). Only their numbers are declared here, so
// that code that only uses a scene is not recompiled for a new row.
enum class SamplePattern : uint32_t;
enum class IntegratorType : uint32_t;

class EnvironmentMap;  // scene/environment.hpp
struct Scene;

// The part of the picture around its middle that a pixel shows. Samples are drawn from the filter, and all
// have the same weight.
enum class PixelFilter : uint32_t { box, gaussian, blackman_harris };

struct ImageSettings {
  int width = 640;
  int height = 480;
  int samples = 1;           // per pixel; for some patterns a square number n², laid out n × n
  SamplePattern pattern{0};  // regular
  PixelFilter filter = PixelFilter::box;
  double filter_width = 1;  // in pixels, from end to end; 1 for a box
  image::Tone tone = {};    // tone of .png pictures
  bool meters = false;  // the exposure is measured before the picture is rendered (render/light_meter.hpp)
  bool transparent = false;  // the picture has an alpha in place of its background

  Vec2 size() const { return {width, height}; }  // in pixels
  int64_t all_samples() const { return int64_t{width} * height * samples; }
};

// The method of choosing one light at each vertex of a path, for integrators that choose one; automatic: it
// depends on the number of lights.
enum class LightSampler { automatic, uniform, power, bvh };
enum class TriangleMethod { woop, moller_trumbore };
enum class GroupStorage { automatic, instanced, flat };

struct RenderSettings {
  IntegratorType integrator{1};   // whitted
  int max_depth = 8;              // reflections and refractions in a row; 0: eye and shadow rays only
  double min_throughput = 0.001;  // a reflected or refracted ray that would count for less is not traced
  uint32_t seed = 0;
  TriangleMethod triangle_method = TriangleMethod::woop;
  LightSampler light_sampler = LightSampler::automatic;
  GroupStorage groups = GroupStorage::automatic;  // which groups are instanced
  int photons = 1 << 17;                          // photons of `sppm`, emitted for each sample
  bool denoise = false;      // remove noise from the finished picture; `verify` never does
  double photon_radius = 0;  // within which the first sample gathers photons; 0: see scene/photons.hpp
  Vec3 background{0.0};      // the light of a ray that hits nothing
  Vec3 ambient{0.0};         // light that reaches every point from everywhere
};

// A scene's settings for `eyeray verify`.
struct VerifySettings {
  double max_explained = 0.005;  // the share of pixels that may differ for a reason
};

// The scene's animation, and the moment that the scene shows: it contains only this moment. Frames are
// counted from 0.
struct Animation {
  double frame = 0;               // the frame shown
  double frames_per_second = 24;  // frames per second of a video
  int tracks = 0;                 // number of values that move
  double first = 0, last = 0;     // the frames between which values move
  // Motion blur: the shutter is open for `shutter` frames around `frame`, and a picture shows `shutter_steps`
  // moments of that time.
  double shutter = 0;
  int shutter_steps = 16;
  // Returns the scene at another frame, with the errors of its file; null if the shutter shows only one
  // moment.
  std::function<Scene(double frame)> at = nullptr;
};
inline constexpr double most_frames = 1e6;

// True if the material fills the shapes that are made of it. For paths it does not if it is a pane, which has
// no inside.
bool fills(const Material& material, IntegratorType integrator);

struct Scene {
  std::filesystem::path file;
  std::vector<std::filesystem::path> files;  // every file read, the scene first: for a watcher

  ImageSettings image;
  Camera camera;
  RenderSettings render;
  VerifySettings verify;
  Animation animation;
  Medium medium;               // around all shapes, for paths; of ior 1
  MediumExtent medium_extent;  // extent of that medium
  bool is_mesh_alone = false;  // a mesh file in place of a scene, in eyeray's own light
  std::shared_ptr<const EnvironmentMap> environment;  // in place of the background; null where there is none
  std::vector<std::unique_ptr<Light>> lights;
  std::vector<std::unique_ptr<Material>> materials;
  // Shapes in registry order, and within a kind in file order, with an included file's where its name stands.
  // The shapes of each group follow in turn.
  std::vector<std::unique_ptr<Shape>> shapes;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Group> groups;  // those that are instanced
  std::vector<GroupInstance> group_instances;
  Names names;  // names of shapes and instances

  // The number of primitives for rays; scene/primitive_ids.hpp has their order.
  uint64_t primitive_count() const;

  std::vector<Diagnostic> warnings;
};

// Calls visit(shape) for each shape as it is kept: the scene's own, then those of its groups.
template <typename Visit>
void for_each_shape(const Scene& scene, const Visit& visit) {
  for (const auto& shape : scene.shapes) visit(*shape);
  for (const Group& group : scene.groups)
    for (const auto& shape : group.shapes) visit(*shape);
}

// Calls visit(shape) as for_each_shape does, but for the parts of a CSG object in place of the object.
template <typename Visit>
void for_each_leaf(const Scene& scene, const Visit& visit) {
  for_each_shape(scene, [&](const Shape& shape) { for_each_leaf(shape, visit); });
}

}  // namespace eyeray::engine
