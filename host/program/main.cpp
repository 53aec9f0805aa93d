#include "host/program/main.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/core/disk_cache.hpp"
#include "host/core/memory_shortage.hpp"
#include "host/core/standard_streams.hpp"
#include "host/core/termination.hpp"
#include "host/gpu/vector_width.hpp"
#include "host/program/huge_pages.hpp"
#include "host/program/json.hpp"

namespace eyeray::engine::program {
namespace {

struct Reporter {
  std::string name;  // name of the program
  bool json;

  // Reports once why the program ends, since the cause and its consequence may both call this.
  void operator()(const Error& error) const {
    static std::atomic_flag reported;
    if (reported.test_and_set()) return;
    if (json) print_json({{"error", to_json(error)}});
    if (const auto* input = dynamic_cast<const InputError*>(&error)) {
      const size_t count = input->diagnostics().size();
      print_lines(stderr, "{}\n{} error{}\n", input->what(), count, count == 1 ? "" : "s");
    } else {
      print_lines(stderr, "{}: error: {}\n", name, error.what());
    }
  }
};

int run_reported(const Reporter& report, int argc, char** argv,
                 const std::function<int(int, char**)>& command_line) {
  try {
    watch_for_termination(report);
    report_memory_shortage();
    const int code = command_line(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
      throw Error(ExitCode::file_io, "cannot write to standard output: {}", strerror(errno));
    return code;
  } catch (const Error& error) {
    report(error);
    return exit_status(error.code());
  } catch (const std::bad_alloc&) {
    report(out_of_memory());
    return int(out_of_memory().code());
  } catch (const std::filesystem::filesystem_error& error) {
    report({ExitCode::file_io, "cannot make or read {}: {}", error.path1().string(), error.code().message()});
    return int(ExitCode::file_io);
  } catch (const std::system_error& error) {
    // fmt's error does not name the stream.
    if (std::ferror(stdout))
      report({ExitCode::file_io, "cannot write to standard output: {}", error.code().message()});
    else
      report({ExitCode::file_io, "{}", error.what()});
    return int(ExitCode::file_io);
  } catch (const std::exception& error) {
    report(own_fault(error.what()));
    return int(ExitCode::internal);
  }
}

// True under --sanitize address. AddressSanitizer reports a fault when it happens, so nothing is left to
// report at exit.
bool sanitizer_is_preloaded() {
  const char* const preloaded = std::getenv("LD_PRELOAD");
  return preloaded && std::string_view(preloaded).find("asan") != std::string_view::npos;
}

}  // namespace

int run_main(int argc, char** argv, const std::string& name,
             const std::function<int(int, char**)>& command_line) {
  use_huge_pages(argv);
  make_standard_streams_safe();
  const Reporter report{
      name, std::any_of(argv + 1, argv + argc, [](std::string_view word) { return word == "--json"; })};
  const int code = run_reported(report, argc, argv, command_line);
  // Under a preloaded AddressSanitizer the destructor of Debian 12's p11-kit waits forever for a lock of the
  // C library. (GnuTLS needs that library, and libmicrohttpd needs GnuTLS.)
  if (sanitizer_is_preloaded()) {
    std::fflush(nullptr);
    ::_exit(code);
  }
  return code;
}

void warn_of_caches() {
  std::vector<std::string> warnings = DiskCache::of_user().warnings();
  if (std::string warning = gpu::driver_cache_warning(); !warning.empty())
    warnings.push_back(std::move(warning));
  for (const std::string& warning : warnings) print_lines(stderr, "eyeray: warning: {}\n", warning);
}

}  // namespace eyeray::engine::program
