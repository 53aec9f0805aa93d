#include "background.hpp"

#include <unistd.h>

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace eyeray_python {

// A thread that does one piece of work after the other, and ends with the process.
class Worker {
 public:
  Worker() { std::thread(&Worker::serve, this).detach(); }

  void start(const std::function<void()>& work) {
    const std::lock_guard lock(mutex_);
    work_ = &work;
    thrown_ = nullptr;
    change_.notify_all();
  }
  void wait() {
    std::unique_lock lock(mutex_);
    change_.wait(lock, [this] { return !work_; });
  }
  bool done_within(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return change_.wait_for(lock, time, [this] { return !work_; });
  }
  std::exception_ptr thrown() const { return thrown_; }
  // False in a forked child, which has no threads of its parent.
  bool is_here() const { return process_ == ::getpid(); }

 private:
  [[noreturn]] void serve() {
    std::unique_lock lock(mutex_);
    while (true) {
      change_.wait(lock, [this] { return work_; });
      lock.unlock();
      std::exception_ptr thrown;
      try {
        (*work_)();
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      thrown_ = std::move(thrown);
      work_ = nullptr;
      change_.notify_all();
    }
  }

  const pid_t process_ = ::getpid();
  std::mutex mutex_;
  std::condition_variable change_;
  const std::function<void()>* work_ = nullptr;  // null when it is done
  std::exception_ptr thrown_;
};

namespace {

// Those that nobody uses.
struct IdleWorkers {
  std::mutex mutex;
  std::vector<Worker*> workers;
};

IdleWorkers& idle_workers() {
  static IdleWorkers& idle = *new IdleWorkers;  // never destroyed: nor are they
  return idle;
}

}  // namespace

Background::Background(const std::function<void()>& work) {
  IdleWorkers& idle = idle_workers();
  {
    const std::lock_guard lock(idle.mutex);
    while (!worker_ && !idle.workers.empty()) {
      if (idle.workers.back()->is_here()) worker_ = idle.workers.back();
      idle.workers.pop_back();
    }
  }
  if (!worker_) worker_ = new Worker;
  worker_->start(work);
}

Background::~Background() {
  worker_->wait();
  IdleWorkers& idle = idle_workers();
  const std::lock_guard lock(idle.mutex);
  idle.workers.push_back(worker_);
}

bool Background::done_within(std::chrono::milliseconds time) {
  return worker_->done_within(time);
}

std::exception_ptr Background::thrown() const {
  return worker_->thrown();
}

}  // namespace eyeray_python
