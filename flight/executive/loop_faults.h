#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "flight/executive/loop.h"

namespace saker::flight {

/// Says what goes wrong in loops: in the log, and for `_HEALTH`. To be called by one thread, none
/// that flies, since a log may wait for a disk or a pipe.
///
/// A loop that hangs, or runs again, is a line each time. An exception is a line when it says
/// something new, else every ten seconds, with how often it was thrown.
class LoopFaultLog {
 public:
  using Loops = std::vector<std::unique_ptr<Loop>>;

  void say(const Loops& loops, Loop::Steady::time_point now);

  /// Of the loops in which something went wrong: planning_threw, planning_off, planning_hangs.
  [[nodiscard]] static std::vector<std::pair<std::string, long>> counters(
      const Loops& loops, Loop::Steady::time_point now);

 private:
  struct Said {
    bool hangs = false, off = false;
    long throws = 0;
    core::Text what;
    Loop::Steady::time_point at;
  };
  static void say_hang(const Loop& loop, Loop::Steady::time_point now, Said& said);
  static void say_throws(const Loop& loop, Loop::Steady::time_point now, Said& said);

  std::vector<Said> said_;  // as many as loops
};

}  // namespace saker::flight
