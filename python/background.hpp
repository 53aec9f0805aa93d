// Calls that take long: Python goes on meanwhile, and Ctrl-C ends them.
#pragma once

#include <pybind11/pybind11.h>
#include <eyeray/eyeray.hpp>

#include <chrono>
#include <exception>
#include <functional>
#include <optional>
#include <utility>

namespace eyeray_python {

namespace py = pybind11;

class Worker;

// Work in another thread, which one such call after the other uses: while other programs are busy, TBB never
// frees the 16 KiB that it took for a thread which has ended.
class Background {
 public:
  // Neither needs the GIL. `work` must outlive this.
  explicit Background(const std::function<void()>& work);
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  bool done_within(std::chrono::milliseconds time);
  // Once it is done.
  std::exception_ptr thrown() const;

 private:
  Worker* worker_ = nullptr;
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
    const std::function<void()> keep_answer = [&] { answer.emplace(work()); };
    Background background(keep_answer);
    while (!background.done_within(between_looks)) {
      if (raised) continue;
      const py::gil_scoped_acquire acquired;
      if (PyErr_CheckSignals() == 0) continue;
      raised.emplace();
      cancellation.request();
    }
    thrown = background.thrown();
  }
  if (raised) throw std::move(*raised);
  if (thrown) std::rethrow_exception(thrown);
  return std::move(*answer);
}

}  // namespace eyeray_python
