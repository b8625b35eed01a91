#pragma once

#include <chrono>
#include <limits>

namespace saker::core {

/// How long work that may stop early may go on: a number of iterations in lockstep (the same result
/// on every machine), a deadline in real time.
class Budget {
 public:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] static Budget iterations(int count) {
    return Budget(count, Clock::time_point::max());
  }
  [[nodiscard]] static Budget until(Clock::time_point deadline, int most_iterations) {
    return Budget(most_iterations, deadline);
  }

  [[nodiscard]] int most_iterations() const { return iterations_; }

  /// Seconds left; infinite in lockstep.
  [[nodiscard]] double seconds_left() const {
    if (deadline_ == Clock::time_point::max()) return std::numeric_limits<double>::infinity();
    return std::chrono::duration<double>(deadline_ - Clock::now()).count();
  }

  [[nodiscard]] bool used_up(int iterations_done) const {
    return iterations_done >= iterations_ || seconds_left() <= 0;
  }

 private:
  Budget(int iterations, Clock::time_point deadline)
      : iterations_(iterations), deadline_(deadline) {}

  int iterations_;
  Clock::time_point deadline_;
};

}  // namespace saker::core
