#pragma once

#include <chrono>
#include <string>

namespace saker::core {

/// Progress of a long command on stderr: a bar where stderr is a terminal, otherwise a line every 5
/// s (none for what takes less). Tools own it; a library never does.
class Progress {
 public:
  /// \param total  of steps; 0: not known
  Progress(std::string what, long total);
  ~Progress();  ///< ends the bar's line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void update(long done);
  void update(long done, long total) {  ///< the total has become another
    total_ = total;
    update(done);
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] double seconds() const;
  void draw_bar(long done) const;
  void print_line(long done) const;

  std::string what_;
  long total_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point start_;
  Clock::time_point next_;
};

/// `replay ███████▌        47 %  72 of 154, 3 s left`: what the bar shows.
[[nodiscard]] std::string progress_text(const std::string& what, long done, long total,
                                        double elapsed_s);

}  // namespace saker::core
