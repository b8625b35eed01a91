#pragma once

#include <fcntl.h>
#include <pty.h>
#include <unistd.h>

#include <cstdio>
#include <stdexcept>
#include <string>

namespace saker::made {

/// While it lives, stderr is a terminal of so many columns, of which the text can be read.
class Terminal {
 public:
  explicit Terminal(unsigned short columns) : stderr_(dup(STDERR_FILENO)) {
    const winsize size{.ws_row = 24, .ws_col = columns, .ws_xpixel = 0, .ws_ypixel = 0};
    int slave = -1;
    if (openpty(&master_, &slave, nullptr, nullptr, &size) != 0)
      throw std::runtime_error("no pseudo-terminal");
    std::fflush(stderr);
    dup2(slave, STDERR_FILENO);
    close(slave);
    fcntl(master_, F_SETFL, O_NONBLOCK);
  }
  ~Terminal() {
    std::fflush(stderr);
    dup2(stderr_, STDERR_FILENO);
    close(stderr_);
    close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  /// What was written since the last call.
  [[nodiscard]] std::string text() const {
    std::fflush(stderr);
    std::string all;
    char part[4096];
    for (ssize_t n = read(master_, part, sizeof part); n > 0; n = read(master_, part, sizeof part))
      all.append(part, static_cast<std::size_t>(n));
    return all;
  }

 private:
  int stderr_;
  int master_ = -1;
};

}  // namespace saker::made
