// Embree 3 or 4 (Wald et al.: Embree, a Kernel Framework for Efficient CPU Ray Tracing, SIGGRAPH 2014) on our
// scenes, to be measured beside our executors on the same rays.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "host/scene/query.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::contenders {

class EmbreeWorld;

// The way in which rays are passed to Embree.
enum class EmbreeCalls { one, packets_of_8, packets_of_16 };
std::string_view name(EmbreeCalls calls);

class Embree {
 public:
  // Commits the scene with Embree's default quality, on all cores. A mesh with one instance is put into the
  // world; a mesh with more instances is instanced. The scene must outlive this. Error (bad_input) for shapes
  // that Embree has no primitive for; planes, which have no bounds, are tested beside Embree.
  explicit Embree(const Scene& scene);
  ~Embree();
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  // Writes the hit of each ray, and returns the seconds that tracing took on all cores: from float32 rays in
  // memory to hits in memory. `coherent` is Embree's own hint.
  double query(std::span<const Query> rays, QueryKind kind, std::span<QueryHit> hits, EmbreeCalls calls,
               bool coherent) const;

  double build_seconds() const;
  // The bytes that Embree has allocated: its copy of the geometry and its BVH.
  uint64_t bytes() const;
  // "Embree 3.13.5".
  static std::string version();

 private:
  std::unique_ptr<EmbreeWorld> world_;
};

}  // namespace eyeray::engine::contenders
