// The media that a ray is in.
#pragma once

#include <array>

#include "host/reference/tracer.hpp"

namespace eyeray::engine::reference {

// The materials whose media surround a point, outermost first: indices in Scene::materials. There may be more
// than four, though no ray keeps more.
std::vector<int> media_at(const Tracer& tracer, const Vec3& point);
// The materials whose media surround a single point, by brute force: building a BVH for one point does not
// pay.
std::vector<int> media_at(const Scene& scene, const Vec3& point);

// The media that a ray is in, the last entered on top; four at most.
class MediaStack {
 public:
  // The material on top; −1 outside of all materials, in the scene's own medium.
  int top() const { return size_ == 0 ? -1 : materials_[size_ - 1]; }
  // Returns false, and leaves the stack as it is, when it is full.
  bool push(int material);
  // Takes out the last occurrence of `material`, if there is one.
  void remove(int material);

 private:
  std::array<int, 4> materials_{};
  size_t size_ = 0;
};

}  // namespace eyeray::engine::reference
