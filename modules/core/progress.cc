#include "saker/core/progress.h"

#include <fmt/format.h>
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

}  // namespace

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
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      next_(start_ + (terminal_ ? Clock::duration(0) : Clock::duration(kLinePeriod))) {}

Progress::~Progress() {
  if (terminal_ && drawn_) std::fputs("\r\033[K", stderr);
}

void Progress::update(long done) {
  const auto now = Clock::now();
  if (now < next_) return;
  drawn_ = true;
  if (terminal_) {
    draw_bar(done);
    next_ = now + kBarPeriod;
  } else {
    print_line(done);
    next_ = now + kLinePeriod;
  }
}

double Progress::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void Progress::draw_bar(long done) const {
  fmt::print(stderr, "\r\033[K{}", progress_text(what_, done, total_, seconds()));
  std::fflush(stderr);
}

void Progress::print_line(long done) const {
  if (total_ > 0) {
    fmt::print(stderr, "{}: {} of {} after {:.0f} s\n", what_, done, total_, seconds());
  } else {
    fmt::print(stderr, "{}: {} after {:.0f} s\n", what_, done, seconds());
  }
}

}  // namespace saker::core
