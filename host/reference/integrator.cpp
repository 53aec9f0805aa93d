#include "host/reference/integrator.hpp"

namespace eyeray::engine::reference {

// Each integrator's .cpp defines its own; one that is missing is a link error that bears its name.
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
