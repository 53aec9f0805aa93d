#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace eyeray::engine {

// Seconds since construction, on the monotonic clock.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

// Seconds in which this process ran. Query it several times a second: it counts at most a quarter of a second
// between two queries, and so leaves out the hours for which the process was stopped (Ctrl-Z).
class WakefulStopwatch {
 public:
  double seconds() {
    const double now = watch_.seconds();
    counted_ += std::min(now - std::exchange(last_, now), 0.25);
    return counted_;
  }

 private:
  Stopwatch watch_;
  double last_ = 0;
  double counted_ = 0;
};

// Seconds spent in named stages, in the order of their first appearance; the same name adds up.
class StageTimes {
 public:
  void add(const std::string& stage, double seconds) {
    for (auto& [name, total] : stages_) {
      if (name == stage) {
        total += seconds;
        return;
      }
    }
    stages_.emplace_back(stage, seconds);
  }
  // Runs `work` and adds its time to `stage`.
  template <typename Work>
  auto measure(const std::string& stage, const Work& work) {
    struct Adder {
      StageTimes& times;
      const std::string& stage;
      Stopwatch watch;
      ~Adder() { times.add(stage, watch.seconds()); }
    } adder{*this, stage, {}};
    return work();
  }
  const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }

 private:
  std::vector<std::pair<std::string, double>> stages_;
};

}  // namespace eyeray::engine
