// Calls that take long: Python goes on meanwhile, and Ctrl-C ends them.
#pragma once

#include <pybind11/pybind11.h>
#include <eyeray/eyeray.hpp>

#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace eyeray_python {

namespace py = pybind11;

// A thread that ends before this does.
class Worker {
 public:
  explicit Worker(std::function<void()> work)
      : work_(std::move(work)), thread_([this] {
          try {
            work_();
          } catch (...) {
            thrown_ = std::current_exception();
          }
          const std::lock_guard lock(mutex_);
          done_ = true;
          change_.notify_one();
        }) {}
  ~Worker() { thread_.join(); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  bool done_within(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return change_.wait_for(lock, time, [this] { return done_; });
  }
  // Once it is done.
  std::exception_ptr thrown() const { return thrown_; }

 private:
  std::function<void()> work_;
  std::mutex mutex_;
  std::condition_variable change_;
  bool done_ = false;
  std::exception_ptr thrown_;
  std::thread thread_;  // the last member: it uses the others
};

// Runs `work` in another thread without the GIL. This one looks for signals, which Python handles in its main
// thread alone; what a handler raises, KeyboardInterrupt say, cancels the work and goes on to the caller.
template <typename Answer>
Answer in_background(eyeray::Cancellation cancellation, const std::function<Answer()>& work) {
  constexpr std::chrono::milliseconds between_looks(50);
  std::optional<Answer> answer;
  std::optional<py::error_already_set> raised;
  std::exception_ptr thrown;
  {
    const py::gil_scoped_release released;
    Worker worker([&] { answer.emplace(work()); });
    while (!worker.done_within(between_looks)) {
      if (raised) continue;
      const py::gil_scoped_acquire acquired;
      if (PyErr_CheckSignals() == 0) continue;
      raised.emplace();
      cancellation.request();
    }
    thrown = worker.thrown();
  }
  if (raised) throw std::move(*raised);
  if (thrown) std::rethrow_exception(thrown);
  return std::move(*answer);
}

}  // namespace eyeray_python
