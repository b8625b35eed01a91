#include "saker/core/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace saker::core {
namespace {

using namespace std::chrono_literals;

constexpr auto kBarPeriod = 100ms;
constexpr auto kLinePeriod = 5s;
constexpr int kBarWidth = 30;

std::string bar(double ratio) {
  const int full = static_cast<int>(ratio * kBarWidth);
  std::string text;
  for (int i = 0; i < kBarWidth; ++i) text += i < full ? "█" : "░";
  return text;
}

/// Of the terminal; 0: not known.
int columns_of_stderr() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace

std::string first_columns(const std::string& text, int columns) {
  if (columns <= 0) return text;
  int seen = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U;
    if (begins && ++seen > columns) return text.substr(0, i);
  }
  return text;
}

StatusLine::StatusLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

void StatusLine::show(const std::string& text) {
  if (!terminal_) return;
  fmt::print(stderr, "\r\033[K{}", first_columns(text, columns_of_stderr()));
  std::fflush(stderr);
  shown_ = true;
}

void StatusLine::clear() {
  if (shown_) fmt::print(stderr, "\r\033[K");
  shown_ = false;
}

void StatusLine::keep() {
  if (shown_) fmt::print(stderr, "\n");
  shown_ = false;
}

std::string progress_text(const std::string& what, long done, long total, double elapsed_s) {
  if (total <= 0) return fmt::format("{} {}, {:.0f} s", what, done, elapsed_s);
  const double ratio = std::clamp(static_cast<double>(done) / static_cast<double>(total), 0.0, 1.0);
  const std::string left =
      ratio > 0 ? fmt::format(", {:.0f} s left", elapsed_s * (1 - ratio) / ratio) : "";
  return fmt::format("{} {} {:3.0f} %  {} of {}{}", what, bar(ratio), 100 * ratio, done, total,
                     left);
}

Progress::Progress(std::string what, long total)
    : what_(std::move(what)),
      total_(total),
      start_(Clock::now()),
      next_(start_ + (bar_.on_terminal() ? Clock::duration(0) : Clock::duration(kLinePeriod))) {}

void Progress::update(long done) {
  const auto now = Clock::now();
  if (now < next_) return;
  if (bar_.on_terminal()) {
    bar_.show(progress_text(what_, done, total_, seconds()));
    next_ = now + kBarPeriod;
  } else {
    print_line(done);
    next_ = now + kLinePeriod;
  }
}

double Progress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void Progress::print_line(long done) const {
  if (total_ > 0) {
    fmt::print(stderr, "{}: {} of {} after {:.0f} s\n", what_, done, total_, seconds());
  } else {
    fmt::print(stderr, "{}: {} after {:.0f} s\n", what_, done, seconds());
  }
}

}  // namespace saker::core
