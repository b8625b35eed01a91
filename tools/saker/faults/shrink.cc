#include "tools/saker/faults/shrink.h"

#include <cmath>

namespace saker::tools {
namespace {

constexpr double kEndless_s = 64;  // what an endless one is tried with first
constexpr double kShortest_s = 0.1;
constexpr int kHalvings = 4;

class Shrinking {
 public:
  Shrinking(FaultSchedule schedule, const std::function<bool(const FaultSchedule&)>& breaks,
            int most_calls)
      : schedule_(std::move(schedule)), breaks_(breaks), calls_left_(most_calls) {}

  void leave_out() {
    for (std::size_t i = 0; i < schedule_.size() && schedule_.size() > 1;) {
      FaultSchedule fewer = schedule_;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      if (!take(std::move(fewer))) ++i;
    }
  }

  void make_less(double Fault::*what, double least) {
    for (std::size_t i = 0; i < schedule_.size(); ++i) {
      for (int n = 0; n < kHalvings && std::abs(schedule_[i].*what) > least; ++n) {
        FaultSchedule less = schedule_;
        double& value = less[i].*what;
        value = std::isinf(value) ? kEndless_s : value / 2;
        if (!take(std::move(less))) break;
      }
    }
  }

  [[nodiscard]] FaultSchedule result() && { return std::move(schedule_); }

 private:
  bool take(FaultSchedule tried) {
    if (calls_left_ <= 0) return false;
    --calls_left_;
    if (!breaks_(tried)) return false;
    schedule_ = std::move(tried);
    return true;
  }

  FaultSchedule schedule_;
  const std::function<bool(const FaultSchedule&)>& breaks_;
  int calls_left_;
};

}  // namespace

FaultSchedule shrunk(FaultSchedule schedule,
                     const std::function<bool(const FaultSchedule&)>& breaks, int most_calls) {
  Shrinking shrinking(std::move(schedule), breaks, most_calls);
  shrinking.leave_out();
  shrinking.make_less(&Fault::lasts_s, kShortest_s);
  shrinking.make_less(&Fault::strength, 0);
  return std::move(shrinking).result();
}

}  // namespace saker::tools
