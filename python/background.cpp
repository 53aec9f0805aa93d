#include "background.hpp"

#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace eyeray_python {
// A thread that does one piece of work after the other, and ends with the process.
class Worker {
 public:
  Worker() { std::thread(&Worker::serve, this).detach(); }

  void start(std::function<void()> work) {
    const std::lock_guard lock(mutex_);
    work_ = std::move(work);
    busy_ = true;
    change_.notify_all();
  }
  bool done_within(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return change_.wait_for(lock, time, [this] { return !busy_; });
  }
  void wait() {
    std::unique_lock lock(mutex_);
    change_.wait(lock, [this] { return !busy_; });
  }
  // The exception that the last work threw, if any.
  std::exception_ptr thrown() const { return thrown_; }
  // False in a forked child, which has no threads of its parent.
  bool is_here() const { return process_ == ::getpid(); }

 private:
  [[noreturn]] void serve() {
    std::unique_lock lock(mutex_);
    while (true) {
      change_.wait(lock, [this] { return busy_; });
      lock.unlock();
      std::exception_ptr thrown;
      try {
        std::exchange(work_, nullptr)();
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      thrown_ = std::move(thrown);
      busy_ = false;
      change_.notify_all();
    }
  }

  const pid_t process_ = ::getpid();
  std::mutex mutex_;
  std::condition_variable change_;
  std::function<void()> work_;
  bool busy_ = false;
  std::exception_ptr thrown_;
};

namespace {

// The workers that nobody waits for: they are idle, or were abandoned.
struct FreeWorkers {
  std::mutex mutex;
  std::vector<Worker*> workers;
};

FreeWorkers& free_workers() {
  static FreeWorkers& free = *new FreeWorkers;  // never destroyed: nor are they
  return free;
}

void give_back(Worker* worker) {
  FreeWorkers& free = free_workers();
  const std::lock_guard lock(free.mutex);
  free.workers.push_back(worker);
}

void wait_for_all() {
  FreeWorkers& free = free_workers();
  const std::lock_guard lock(free.mutex);
  for (Worker* const worker : free.workers)
    if (worker->is_here()) worker->wait();
}

}  // namespace

Background::Background(std::function<void()> work) {
  FreeWorkers& free = free_workers();
  {
    const std::lock_guard lock(free.mutex);
    const auto found = std::find_if(free.workers.rbegin(), free.workers.rend(), [](Worker* worker) {
      return worker->is_here() && worker->done_within(std::chrono::milliseconds(0));
    });
    if (found != free.workers.rend()) {
      worker_ = *found;
      free.workers.erase(std::next(found).base());
    }
  }
  if (!worker_) worker_ = new Worker;
  worker_->start(std::move(work));
}

Background::~Background() {
  if (!worker_) return;
  worker_->wait();
  give_back(worker_);
}

bool Background::done_within(std::chrono::milliseconds time) {
  return worker_->done_within(time);
}

std::exception_ptr Background::thrown() const {
  return worker_->thrown();
}

void Background::abandon() {
  // Registered last, it is called first: before the driver's own.
  static const bool waits = std::atexit(wait_for_all) == 0;
  static_cast<void>(waits);
  give_back(std::exchange(worker_, nullptr));
}

}  // namespace eyeray_python
