#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <functional>

namespace eyeray::engine {

// Calls body(i) for every i in [begin, end), on all cores, in no order. The first exception out of a body
// ends the others soon and goes to the caller.
template <typename Body>
void parallel_for(int begin, int end, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<int>(begin, end), [&](const tbb::blocked_range<int>& range) {
    for (int i = range.begin(); i != range.end(); ++i) body(i);
  });
}

// Like parallel_for(), but until all calls are done this thread takes on no other work: that might wait for a
// lock that this thread holds.
template <typename Body>
void parallel_for_alone(int begin, int end, const Body& body) {
  tbb::this_task_arena::isolate([&] { parallel_for(begin, end, body); });
}

// The sum of term(i) for every i in [begin, end), on all cores, in the same order of additions every time.
// term must not throw.
template <typename Term>
auto parallel_sum(int begin, int end, const Term& term) {
  using Sum = decltype(term(begin));
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<int>(begin, end, 4096), Sum(0),
      [&](const tbb::blocked_range<int>& range, Sum sum) {
        for (int i = range.begin(); i != range.end(); ++i) sum += term(i);
        return sum;
      },
      std::plus<>());
}

// Calls a and b, perhaps at the same time. They must not throw.
template <typename A, typename B>
void parallel_invoke(const A& a, const B& b) {
  tbb::parallel_invoke(a, b);
}

}  // namespace eyeray::engine
