// A pseudoterminal whose width a test sets.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

namespace eyeray::engine::test {

inline const Environment xterm{{"TERM", "xterm"}, {"NO_COLOR", "1"}};

class Terminal {
 public:
  explicit Terminal(int columns) {
    REQUIRE(master_ >= 0);
    REQUIRE(grantpt(master_) == 0);
    REQUIRE(unlockpt(master_) == 0);
    name_ = ptsname(master_);
    slave_ = open(name_.c_str(), O_RDWR | O_NOCTTY);
    REQUIRE(slave_ >= 0);
    set_columns(columns);
  }
  ~Terminal() {
    close(slave_);
    close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  // The command that runs eyeray, or another program, with standard error at this terminal.
  std::vector<std::string> command(const std::string& arguments,
                                   const std::string& program = eyeray_binary()) const {
    return {"sh", "-c", "exec " + program + " " + arguments + " 2>" + name_};
  }
  void set_columns(int columns) {
    const winsize size{24, static_cast<unsigned short>(columns), 0, 0};
    REQUIRE(ioctl(master_, TIOCSWINSZ, &size) == 0);
  }
  // Reads until `text` was written after position `from`, or until nothing was written for ten minutes.
  bool wait_for(const std::string& text, size_t from = 0) {
    while (shown_.find(text, from) == std::string::npos)
      if (!read_some(600'000)) return false;
    return true;
  }
  // All that was written until now.
  const std::string& shown() {
    while (read_some(0)) continue;
    return shown_;
  }

 private:
  bool read_some(int milliseconds) {
    pollfd wanted{master_, POLLIN, 0};
    if (poll(&wanted, 1, milliseconds) != 1) return false;
    char bytes[4096];
    const ssize_t count = read(master_, bytes, sizeof bytes);
    if (count > 0) shown_.append(bytes, size_t(count));
    return count > 0;
  }

  int master_ = posix_openpt(O_RDWR | O_NOCTTY);
  int slave_ = -1;
  std::string name_;
  std::string shown_;
};

}  // namespace eyeray::engine::test
