// Writes the values that shaders PROBE into the buffer of kernels/bindings.glsl: for a dispatch of one pixel, since every invocation
// begins at its start.
#ifndef PROBE_GLSL
#define PROBE_GLSL
#include "records.h"

uint probe_count = 0u;

void probe_record(uint name, uint line, uint type, uint size, uvec4 value) {
  probe_count += 1u;
  probe_records[0].name = probe_count;
  if (probe_count <= PROBE_CAPACITY) probe_records[probe_count] = ProbeRecord(name, line, type, size, value);
}

void probe_value(uint name, uint line, vec4 v) { probe_record(name, line, PROBE_FLOAT, 4u, floatBitsToUint(v)); }
void probe_value(uint name, uint line, vec3 v) { probe_record(name, line, PROBE_FLOAT, 3u, floatBitsToUint(vec4(v, 0.0f))); }
void probe_value(uint name, uint line, vec2 v) { probe_record(name, line, PROBE_FLOAT, 2u, floatBitsToUint(vec4(v, 0.0f, 0.0f))); }
void probe_value(uint name, uint line, float v) { probe_record(name, line, PROBE_FLOAT, 1u, uvec4(floatBitsToUint(v), 0u, 0u, 0u)); }
void probe_value(uint name, uint line, int v) { probe_record(name, line, PROBE_INT, 1u, uvec4(uint(v), 0u, 0u, 0u)); }
void probe_value(uint name, uint line, uint v) { probe_record(name, line, PROBE_UINT, 1u, uvec4(v, 0u, 0u, 0u)); }
void probe_value(uint name, uint line, bool v) { probe_record(name, line, PROBE_BOOL, 1u, uvec4(v ? 1u : 0u, 0u, 0u, 0u)); }

#undef PROBE
#undef PROBE_RAY
#undef PROBE_BACK
#define PROBE(name, value) probe_value(PROBED_##name, uint(__LINE__), value)
#define PROBE_RAY(kind, number, depth) probe_record(PROBE_OPENS_RAY, 0u, 0u, 3u, uvec4(kind, number, depth, 0u))
#define PROBE_BACK(depth) probe_record(PROBE_RETURNS, 0u, 0u, 1u, uvec4(depth, 0u, 0u, 0u))

#endif
