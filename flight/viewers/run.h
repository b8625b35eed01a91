#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "flight/viewers/robot_views.h"

/// Finished runs: what a folder or a log holds, as it would have been heard.
namespace saker::flight::viewers {

/// A run along its own clock, s.
class Run {
 public:
  virtual ~Run() = default;

  [[nodiscard]] virtual double begin_s() const = 0;
  [[nodiscard]] virtual double end_s() const = 0;

  /// What was said after the last call and until `t`, to the views. The first call begins with the
  /// run's beginning; a time before the last one begins anew, with views that have been cleared.
  virtual void advance(double t, RobotViews& views) = 0;
  virtual void rewind(RobotViews& views) = 0;

  /// What could not be read of it, a line; empty when all was well.
  [[nodiscard]] virtual std::string amiss() const { return {}; }
};

/// A folder of `saker replay`, `experiment`, `mission` or `saker-flight`, or a log of lcm-logger:
/// what it is, its content tells. Throws Error where it is none of these or cannot be read.
[[nodiscard]] std::unique_ptr<Run> open_run(const std::filesystem::path& path, const Site& site);

}  // namespace saker::flight::viewers
