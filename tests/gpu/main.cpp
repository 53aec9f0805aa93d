#include <cstdio>
#include <string_view>

#include "child.hpp"
#include "host/core/termination.hpp"
//
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

// doctest's tests; or, as `test_gpu child NAME`, one piece of work in a separate process that ends as eyeray
// would.
int main(int argc, char** argv) {
  if (argc == 3 && std::string_view(argv[1]) == "child") {
    try {
      eyeray::engine::test::child_work(argv[2]);
      return 0;
    } catch (const eyeray::engine::Error& error) {
      std::fprintf(stderr, "%s\n", error.what());
      return eyeray::engine::exit_status(error.code());
    }
  }
  return doctest::Context(argc, argv).run();
}
