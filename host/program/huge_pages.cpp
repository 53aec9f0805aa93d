#include "host/program/huge_pages.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace eyeray::engine::program {
namespace {

constexpr const char* variable = "GLIBC_TUNABLES";
constexpr std::string_view huge = "glibc.malloc.hugetlb=1";

std::string text_of(const char* path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

bool gives_who_asks() {
  return text_of("/sys/kernel/mm/transparent_hugepage/enabled").find("[madvise]") != std::string::npos;
}

bool is_watched() {
  return std::getenv("LD_PRELOAD") ||
         text_of("/proc/self/status").find("TracerPid:\t0\n") == std::string::npos;
}

}  // namespace

void use_huge_pages(char** argv) {
  if (const char* set = std::getenv(variable)) {
    if (set == huge) unsetenv(variable);
    return;
  }
  if (!gives_who_asks() || is_watched()) return;
  std::error_code failed;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", failed);
  if (failed) return;
  setenv(variable, huge.data(), 1);
  execv(program.c_str(), argv);
  unsetenv(variable);
}

}  // namespace eyeray::engine::program
