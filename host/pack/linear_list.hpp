// The choice of primitives that are tested one by one, outside the BVH.
#pragma once

#include "host/pack/blas_records.hpp"

namespace eyeray::engine::pack {

// Takes the bounds from primitives that are few, and have a large box or another kind than most, for example
// a floor and area lights around a mesh. The boxes of the BVH are then coded more finely, and its leaves may
// be of one kind.
void unbind_few(BlasRecords& items);

}  // namespace eyeray::engine::pack
