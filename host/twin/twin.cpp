#include "host/twin/twin.hpp"

#include "host/twin/shader_functions.hpp"

namespace eyeray::twin {

shader::SampleResult sample(const records::PackedScene& scene, uint32_t x, uint32_t y, uint32_t index,
                            RayRecorder* recorder) {
  const shader::Binding binding(scene, recorder);
  return shader::render_sample(scene.frame, x, y, index);
}

shader::HitResult first_hit(const records::PackedScene& scene, uint32_t x, uint32_t y) {
  const shader::Binding binding(scene);
  return shader::first_hit(scene.frame, x, y);
}

shader::QueryHit query(const records::PackedScene& scene, const shader::QueryRay& ray, bool any) {
  const shader::Binding binding(scene);
  return shader::query(ray, any);
}

}  // namespace eyeray::twin
