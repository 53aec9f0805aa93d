// Traces single photons, also with their rays displaced as float32 may round them.
#pragma once

#include <cstdint>
#include <vector>

#include "host/reference/integrator.hpp"
#include "host/reference/photon_source.hpp"

namespace eyeray::engine::reference {

struct PhotonTrace {
  std::vector<uint32_t> events;  // the photon's decisions (trail.hpp)
  PhotonWay way;
};

class PhotonTraces {
 public:
  // `tracer` must outlive it.
  explicit PhotonTraces(const Tracer& tracer) : tracer_(tracer), sources_(tracer) {}

  // Photon `number` of sample `index`, with its rays rounded by `displacement`. May be called from many
  // threads at once.
  PhotonTrace trace(uint32_t index, uint32_t number, const rounding::Displacement& displacement) const;

 private:
  const Tracer& tracer_;
  PhotonSources sources_;
};

}  // namespace eyeray::engine::reference
