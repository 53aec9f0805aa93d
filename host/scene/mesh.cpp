#include "host/scene/mesh.hpp"

namespace eyeray::engine {

Bounds bounds(const Mesh& mesh) {
  Bounds bounds;
  for (const Vec3& position : mesh.positions) bounds.include(position);
  return bounds;
}

}  // namespace eyeray::engine
