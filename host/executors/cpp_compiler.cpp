#include "host/executors/cpp_compiler.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "host/core/error.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::executors {
namespace {

using Words = std::vector<std::string>;

Words words_of(const std::string& text) {
  std::istringstream stream(text);
  Words words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::string path_in_environment(const std::string& program) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path file = fs::path(folder) / program; ::access(file.c_str(), X_OK) == 0) return file;
  return "";
}

// The path of one of the compiler's own files; empty if it has none of that name.
std::string own_file(Words compiler, const std::string& name) {
  compiler.push_back("-print-file-name=" + name);
  std::string path = run_process(compiler, compiler_environment()).out;
  while (!path.empty() && path.back() == '\n') path.pop_back();
  return path.find('/') == std::string::npos ? "" : path;
}

// The path of a sanitizer's runtime, by Clang's name for it; empty for GCC, which has no file of that name.
std::string clang_runtime(const Words& compiler, const std::string& name) {
  utsname machine{};
  ::uname(&machine);
  return own_file(compiler, fmt::format("libclang_rt.{}-{}.so", name, machine.machine));
}

bool has_address(const std::string& sanitizers) {
  return sanitizers.find("address") != std::string::npos;
}

}  // namespace

std::vector<std::string> cpp_compiler() {
  if (const char* const chosen = std::getenv("CXX"); chosen && !words_of(chosen).empty()) {
    Words words = words_of(chosen);
    const std::string found =
        words[0].find('/') == std::string::npos ? path_in_environment(words[0]) : words[0];
    if (found.empty()) return {};
    words[0] = found;
    return words;
  }
  for (const char* name : {"c++", "g++", "clang++"})
    if (const std::string path = path_in_environment(name); !path.empty()) return {path};
  return {};
}

std::vector<std::string> require_cpp_compiler() {
  Words compiler = cpp_compiler();
  if (compiler.empty())
    throw Error(ExitCode::bad_input,
                "the twin of your shaders needs a C++ compiler: $CXX names none that exists, and $PATH has "
                "no c++, g++ or clang++");
  return compiler;
}

std::vector<std::string> module_flags(const Words& compiler, const std::string& sanitizers) {
  Words flags{"-std=c++20", "-shared", "-fPIC", "-fvisibility=hidden", "-w", "-g3", "-O0"};
  if (const char* const own = std::getenv("CXXFLAGS"))
    for (const std::string& word : words_of(own)) flags.push_back(word);
  // The flags of cmake/layers.cmake for our own code, so that the bits are the same.
  flags.insert(flags.end(),
               {"-fno-fast-math", "-ffp-contract=off", "-DEYERAY_USERS_TWIN", "-DGLM_FORCE_XYZW_ONLY"});
  if (sanitizers.empty()) return flags;
  flags.insert(flags.end(),
               {"-fsanitize=" + sanitizers, "-fno-sanitize-recover=all", "-fno-omit-frame-pointer"});
  if (const std::string runtime = clang_runtime(compiler, "asan"); !runtime.empty())
    flags.insert(flags.end(), {"-shared-libsan", "-Wl,-rpath," + fs::path(runtime).parent_path().string()});
  return flags;
}

Environment compiler_environment() {
  return {{"LC_ALL", "C"}, {"LD_PRELOAD", ""}};
}

Environment sanitizer_environment(const std::string& sanitizers) {
  const Words compiler = require_cpp_compiler();
  Environment environment;
  const auto add = [&](const char* name, const std::string& options) {
    const char* const own = std::getenv(name);
    environment.emplace_back(name, own ? options + ":" + own : options);
  };
  // Leaks of the driver and of this program are not the shaders'.
  add("ASAN_OPTIONS", "detect_leaks=0:exitcode=2");
  add("UBSAN_OPTIONS", "print_stacktrace=1:exitcode=2");
  if (!has_address(sanitizers)) return environment;
  std::string runtime = clang_runtime(compiler, "asan");
  if (runtime.empty()) runtime = own_file(compiler, "libasan.so");
  if (runtime.empty())
    throw Error(ExitCode::bad_input, "--sanitize {}: {} has no AddressSanitizer", sanitizers, compiler[0]);
  environment.emplace_back("LD_PRELOAD", runtime);
  return environment;
}

}  // namespace eyeray::engine::executors
