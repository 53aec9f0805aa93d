// Calls that take long: Python goes on meanwhile, and Ctrl-C ends the wait for them.
#pragma once

#include <pybind11/pybind11.h>
#include <eyeray/eyeray.hpp>

#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace eyeray_python {

namespace py = pybind11;

class Worker;

// Work in another thread, which one such call after the other uses: while other programs are busy, TBB never
// frees the 16 KiB that it took for a thread which has ended.
class Background {
 public:
  // `work` needs the GIL neither to run nor to be destroyed.
  explicit Background(std::function<void()> work);
  ~Background();
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  bool done_within(std::chrono::milliseconds time);
  // Once it is done.
  std::exception_ptr thrown() const;
  // Nobody waits for the work any more, but the process does before it tears itself down: a driver may be
  // compiling.
  void abandon();

 private:
  Worker* worker_ = nullptr;
};

// While one is alive this thread runs a callback of such a call.
class InsideCallback {
 public:
  InsideCallback() : before_(std::exchange(here, true)) {}
  ~InsideCallback() { here = before_; }
  InsideCallback(const InsideCallback&) = delete;
  InsideCallback& operator=(const InsideCallback&) = delete;

  static inline thread_local bool here = false;

 private:
  bool before_;
};

// Runs `work` in another thread without the GIL. This one looks for signals, which Python handles in its main
// thread alone; an exception of a handler, such as KeyboardInterrupt, cancels the work and goes on to the
// caller. Work that does not end then within 0.3 s, since a driver compiles a kernel, is left alone. It must
// own all that it uses, and ask for the GIL no more once it is cancelled. Called from a callback it runs in
// the callback's thread, where the library refuses it.
template <typename Answer>
Answer in_background(eyeray::Cancellation cancellation, std::function<Answer()> work) {
  constexpr std::chrono::milliseconds between_looks(50);
  constexpr int most_looks_after = 6;
  const auto answer = std::make_shared<std::optional<Answer>>();
  std::optional<py::error_already_set> raised;
  std::exception_ptr thrown;
  {
    const py::gil_scoped_release released;
    if (InsideCallback::here) return work();
    Background background([answer, work = std::move(work)] { answer->emplace(work()); });
    for (int looks_after = 0; !background.done_within(between_looks);) {
      if (raised) {
        if (++looks_after < most_looks_after) continue;
        background.abandon();
        break;
      }
      const py::gil_scoped_acquire acquired;
      if (PyErr_CheckSignals() == 0) continue;
      raised.emplace();
      cancellation.request();
    }
    if (!raised) thrown = background.thrown();
  }
  if (raised) throw std::move(*raised);
  if (thrown) std::rethrow_exception(thrown);
  return std::move(**answer);
}

}  // namespace eyeray_python
