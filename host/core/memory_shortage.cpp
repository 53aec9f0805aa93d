#include "host/core/memory_shortage.hpp"

#include <signal.h>
#include <sys/mman.h>

#include <exception>
#include <new>

#include "host/core/error.hpp"
#include "host/core/termination.hpp"

namespace eyeray::engine {
namespace {

// Drivers take tens of megabytes at a time, and a thread's heap begins with 128 MiB of addresses.
constexpr size_t hardly_any = size_t{256} << 20;

std::terminate_handler usual_end;
struct sigaction usual_abort, usual_fault;

bool can_map(size_t bytes, int protection) {
  void* const address =
      ::mmap(nullptr, bytes, protection, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  return address != MAP_FAILED && ::munmap(address, bytes) == 0;
}

// Handles crashes of libraries that do not check malloc's result, or abort if it is null. Any other crash
// goes on as without this handler.
extern "C" void on_crash(int number) {
  if (!can_map(hardly_any, PROT_READ | PROT_WRITE)) end_for_want_of_memory();
  ::sigaction(number, number == SIGABRT ? &usual_abort : &usual_fault, nullptr);
}

void on_uncaught() {
  try {
    if (const std::exception_ptr uncaught = std::current_exception()) std::rethrow_exception(uncaught);
  } catch (const std::bad_alloc&) {
    end_for_want_of_memory();
  } catch (...) {
  }
  usual_end();
}

}  // namespace

bool address_space_left(size_t bytes) {
  return can_map(bytes, PROT_NONE);
}

void report_memory_shortage() {
  usual_end = std::set_terminate(on_uncaught);
  struct sigaction action{};
  action.sa_handler = on_crash;
  sigemptyset(&action.sa_mask);
  CHECK_EQ(::sigaction(SIGABRT, &action, &usual_abort), 0);
  CHECK_EQ(::sigaction(SIGSEGV, &action, &usual_fault), 0);
}

}  // namespace eyeray::engine
