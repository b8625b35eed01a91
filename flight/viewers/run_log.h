#pragma once

#include <lcm/lcm-cpp.hpp>
#include <optional>

#include "flight/viewers/run.h"

namespace saker::flight::viewers {

/// A log of lcm-logger, by the times at which it was heard. Cost: a jump back reads it from its
/// beginning, about 2 µs a message.
class LogRun : public Run {
 public:
  /// Throws Error when it cannot be read or holds no message of a robot.
  explicit LogRun(const std::filesystem::path& file);

  [[nodiscard]] double begin_s() const override { return begin_s_; }
  [[nodiscard]] double end_s() const override { return end_s_; }
  void advance(double t, RobotViews& views) override;
  void rewind(RobotViews& views) override;

 private:
  std::string file_;
  std::optional<lcm::LogFile> log_;
  const lcm::LogEvent* next_ = nullptr;
  double begin_s_ = 0, end_s_ = 0;
};

}  // namespace saker::flight::viewers
