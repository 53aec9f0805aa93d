#include "host/reference/photon_traces.hpp"

#include "host/reference/path_sample.hpp"

namespace eyeray::engine::reference {

PhotonTrace PhotonTraces::trace(uint32_t index, uint32_t number,
                                const rounding::Displacement& displacement) const {
  PhotonTrace trace;
  std::vector<Photon> stopped;
  const Observer observer(trace.events);
  trace.way =
      PathSample(tracer_, {photons_of | index, number}, displacement, observer).photon(sources_, stopped);
  return trace;
}

}  // namespace eyeray::engine::reference
