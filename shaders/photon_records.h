// The part of the ABI that photons travel by (docs/photon-mapping.md); by the rules of records.h, which includes it.
#ifndef PHOTON_RECORDS_H
#define PHOTON_RECORDS_H

#include "language.h"

SHADER_BEGIN

// A photon where a surface has stopped it that scatters light widely, 64 bytes.
struct Photon {
  vec3 position;
  uint key;        // key of its cell (integrators/photon_cells.glsl)
  vec3 direction;  // unit, towards where it came from
  uint number;     // its number among the photons of its sample
  vec3 normal;     // unit, of the surface's shape, on the side that it came to
  uint depth;      // how often it was scattered before
  vec3 flux;       // flux of the photon, times the number of all
  uint unused;
};

// The result of a photon, 16 bytes.
struct PhotonResult {
  uint trail;  // as that of a sample
  uint flags;
  uint rays;
  uint stored;  // number of Photons that it stored
};

#define MOST_PHOTON_TARGETS 16

// The values that all photons of a sample share, 304 bytes.
struct PhotonPass {
  vec3 center;           // center of a sphere around all that has an end: lights from afar send their photons there
  float reach;           // its radius
  float radius_squared;  // squared radius of the disk that photons are gathered on
  float height;          // how far above and below it
  float cells;           // a unit of length: a cell is as wide as the disk
  float scale;           // 2 / (π radius²) / the number of photons
  uint key_mask;         // which bits of a cell's hash are its key
  uint capacity;         // how many photons there is room for
  uint target_count;     // number of objects that photons are aimed at
  uint unused;
  vec4 targets[MOST_PHOTON_TARGETS];  // center, radius
};

SHADER_END

#ifdef __cplusplus
static_assert(sizeof(eyeray::engine::shader::Photon) == 64);
static_assert(sizeof(eyeray::engine::shader::PhotonResult) == 16);
static_assert(sizeof(eyeray::engine::shader::PhotonPass) == 304);
#endif
#endif
