// Runs the real program in tests, each in a separate folder.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include "host/core/process.hpp"

namespace eyeray::engine::test {

// The eyeray under test: $EYERAY_BINARY, which ctest sets.
inline std::string eyeray_binary() {
  const char* path = std::getenv("EYERAY_BINARY");
  return path ? path : "eyeray";
}

// Runs eyeray with `arguments`. The time limit only ensures that the program ends at all, however busy the
// machine is.
inline ProcessResult run_eyeray(std::vector<std::string> arguments, const Environment& environment = {},
                                double timeout_seconds = 3600, int signal_after_ms = -1) {
  arguments.insert(arguments.begin(), eyeray_binary());
  return run_process(arguments, environment, timeout_seconds, signal_after_ms);
}

// An empty folder, removed with everything in it at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "eyeray-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("mkdtemp failed");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  // The names of the files in the folder, sorted.
  std::set<std::string> names() const {
    std::set<std::string> result;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      result.insert(entry.path().filename());
    return result;
  }

 private:
  std::filesystem::path path_;
};

inline void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string read_text(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

// Waits until a process and all its threads have ended: it is gone, or a zombie that its parent has not
// reaped yet.
inline bool wait_until_ended(pid_t pid, double seconds = 600) {
  const Stopwatch watch;
  while (watch.seconds() < seconds) {
    const std::filesystem::path process = "/proc/" + std::to_string(pid);
    const std::string stat = read_text(process / "stat");
    std::error_code gone;
    const auto threads = std::distance(std::filesystem::directory_iterator(process / "task", gone),
                                       std::filesystem::directory_iterator());
    if (stat.empty() || (stat.find(") Z ") != std::string::npos && threads <= 1)) return true;
    usleep(1000);
  }
  return false;
}

}  // namespace eyeray::engine::test
