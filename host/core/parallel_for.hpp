#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace eyeray {

// Calls body(i) for every i in [begin, end), on all cores, in no order. body must not throw.
template <typename Body>
void parallel_for(int begin, int end, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<int>(begin, end), [&](const tbb::blocked_range<int>& range) {
    for (int i = range.begin(); i != range.end(); ++i) body(i);
  });
}

}  // namespace eyeray
