#pragma once

#include <ctime>

namespace eyeray::engine {

// Seconds that all threads of this process, those of drivers included, have spent on processors until now.
inline double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

}  // namespace eyeray::engine
