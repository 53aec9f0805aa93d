#include "host/reference/integrator.hpp"

namespace eyeray::engine::reference {

// Each integrator's .cpp defines its variable. If one is missing, the linker's error names it.
#define X(name, ...) extern const Integrator name##_integrator;
INTEGRATORS(X)
#undef X

const Integrator& integrator(IntegratorType type) {
#define X(name, ...) &name##_integrator,
  static constexpr const Integrator* integrators[] = {INTEGRATORS(X)};
#undef X
  return *integrators[uint32_t(type)];
}

}  // namespace eyeray::engine::reference
