#pragma once

#include <chrono>
#include <string>

namespace saker::core {

/// A line on stderr that is rewritten where stderr is a terminal; elsewhere nothing is written.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  [[nodiscard]] bool on_terminal() const { return terminal_; }
  /// Cut to the terminal's width, so that it stays one line.
  void show(const std::string& text);
  void clear();
  void keep();  ///< what it shows stays; what comes next begins below

 private:
  bool terminal_;
  bool shown_ = false;
};

/// Progress of a long command on stderr: a bar where stderr is a terminal, otherwise a line every 5
/// s (none for what takes less). Tools own it; a library never does.
class Progress {
 public:
  /// \param total  of steps; 0: not known
  Progress(std::string what, long total);

  void update(long done);
  void update(long done, long total) {  ///< the total has become another
    total_ = total;
    update(done);
  }

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] double seconds() const;
  void print_line(long done) const;

  std::string what_;
  long total_;
  StatusLine bar_;
  Clock::time_point start_;
  Clock::time_point next_;
};

/// The first `columns` characters of a text in UTF-8 without wide ones; all of it where `columns`
/// is 0.
[[nodiscard]] std::string first_columns(const std::string& text, int columns);

/// `replay ███████▌        47 %  72 of 154, 3 s left`: what the bar shows.
[[nodiscard]] std::string progress_text(const std::string& what, long done, long total,
                                        double elapsed_s);

}  // namespace saker::core
