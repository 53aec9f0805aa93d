// Calls of the engine by a program that is not eyeray's.
#pragma once

#include <eyeray/eyeray.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/core/error.hpp"

namespace eyeray::engine::library {

std::vector<v0::Diagnostic> to_public(const std::vector<Diagnostic>& diagnostics);

// While an InsideCall is alive, its thread runs a call. So that thread must not wait for the call's end.
class InsideCall {
 public:
  InsideCall();
  ~InsideCall();
  InsideCall(const InsideCall&) = delete;
  InsideCall& operator=(const InsideCall&) = delete;

 private:
  bool before_;
};

// The same around a callback. Calls of other threads do not wait for it without end: they are refused after
// some seconds, since the callback may be waiting for them.
class InsideCallback {
 public:
  InsideCallback();
  ~InsideCallback();
  InsideCallback(const InsideCallback&) = delete;
  InsideCallback& operator=(const InsideCallback&) = delete;

 private:
  InsideCall inside_;
  std::atomic<uint64_t>& callbacks_;  // the counter of the process that began it; the callback may fork
};

// Runs `work`, alone in this process: the engine's device, signals and time-outs belong to the process. An
// exception of the engine becomes a v0::Error; an exception of a user's callback goes through. `stop`, unless
// null, ends the wait for other calls and the work: v0::Error (cancelled). Inside another call, for example
// in its `progress`: v0::Error (bad_input).
void call_engine(const std::function<void()>& work, const std::atomic<bool>* stop = nullptr);

// Runs `work` as call_engine does, and returns its result.
template <typename Work>
auto run_engine(const Work& work, const std::atomic<bool>* stop = nullptr) {
  std::optional<decltype(work())> answer;
  call_engine([&] { answer.emplace(work()); }, stop);
  return std::move(*answer);
}

}  // namespace eyeray::engine::library
