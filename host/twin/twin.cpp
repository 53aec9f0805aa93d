#include "host/twin/shader_functions.hpp"

namespace eyeray::engine::twin {
namespace {

shader::SampleResult sample(const SceneView& scene, uint32_t x, uint32_t y, uint32_t index,
                            const Spectator* spectator) {
  const shader::Binding binding(scene, spectator);
  return shader::render_sample(*scene.frame, x, y, index);
}

shader::AuxiliaryResult auxiliary(const SceneView& scene, uint32_t x, uint32_t y, uint32_t index) {
  const shader::Binding binding(scene);
  return shader::render_auxiliary(*scene.frame, x, y, index);
}

shader::HitResult first_hit(const SceneView& scene, uint32_t x, uint32_t y) {
  const shader::Binding binding(scene);
  return shader::first_hit(*scene.frame, x, y);
}

shader::PhotonResult photon(const SceneView& scene, uint32_t index, uint32_t number, const PhotonSink& sink) {
  const shader::Binding binding(scene, nullptr, &sink);
  return shader::photon_way(*scene.frame, index, number);
}

shader::QueryHit query(const SceneView& scene, const shader::QueryRay& ray, bool any) {
  const shader::Binding binding(scene);
  return shader::query(ray, any);
}

}  // namespace

// executors/twin_module.cpp finds it by this name in a shared object of the user's shaders.
extern "C" [[gnu::visibility("default")]] const Functions eyeray_twin;
const Functions eyeray_twin{sample, auxiliary, first_hit, photon, query};

}  // namespace eyeray::engine::twin
