#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <map>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "flight/executive/loop_faults.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A loop "planning" that does what a test says, and what is said of it.
class ExecutiveFaults : public testing::Test {
 protected:
  ExecutiveFaults() : before_(spdlog::default_logger()) {
    spdlog::set_default_logger(std::make_shared<spdlog::logger>(
        "test", std::make_shared<spdlog::sinks::ostream_sink_mt>(words_)));
    spdlog::set_pattern("%l %v");
    loops_.push_back(std::make_unique<Loop>(
        "planning", 100, 0,
        [this]() -> LoopStatus {
          ++runs_;
          while (held_) std::this_thread::sleep_for(milliseconds(1));
          if (throws_) throw std::runtime_error(second_ ? "another" : "no solution");
          return {};
        },
        50));
    loops_.front()->start();
  }
  ~ExecutiveFaults() override {
    held_ = false;
    loops_.clear();
    spdlog::set_default_logger(before_);
  }

  void pass(milliseconds time) {
    const int before = runs_;
    std::this_thread::sleep_for(time);
    while (!held_ && runs_ == before) std::this_thread::sleep_for(milliseconds(1));
  }
  /// What is said `later` than it is, since the last call.
  std::string said(seconds later = seconds(0)) {
    words_.str("");
    log_.say(loops_, Loop::Steady::now() + later);
    return words_.str();
  }
  std::map<std::string, long> counters() {
    const auto found = LoopFaultLog::counters(loops_, Loop::Steady::now());
    return {found.begin(), found.end()};
  }

  std::ostringstream words_;
  std::atomic<bool> held_ = false, throws_ = false, second_ = false;
  std::atomic<int> runs_ = 0;
  LoopFaultLog::Loops loops_;
  LoopFaultLog log_;

 private:
  std::shared_ptr<spdlog::logger> before_;
};

TEST_F(ExecutiveFaults, NothingIsSaidOfALoopThatRuns) {
  pass(milliseconds(50));
  EXPECT_EQ(said(), "");
  EXPECT_TRUE(counters().empty());
}

TEST_F(ExecutiveFaults, AnExceptionIsSaidOnceAndAgainAfterTenSecondsOrWhenItIsAnother) {
  throws_ = true;
  pass(milliseconds(50));
  EXPECT_NE(said().find("error planning threw, "), std::string::npos);
  pass(milliseconds(50));
  EXPECT_EQ(said(), "");
  second_ = true;
  pass(milliseconds(50));
  EXPECT_NE(said().find("times so far: another"), std::string::npos);
  pass(milliseconds(50));
  EXPECT_NE(said(seconds(11)).find("error planning threw, "), std::string::npos);
  EXPECT_GT(counters()["planning_threw"], 4);
}

TEST_F(ExecutiveFaults, WhatIsSwitchedOffIsSaidAndCounted) {
  throws_ = true;
  pass(milliseconds(1200));
  EXPECT_NE(said().find("critical planning is switched off"), std::string::npos);
  EXPECT_EQ(said(seconds(60)).find("threw"), std::string::npos);
  EXPECT_EQ(counters()["planning_threw"], 50);
  EXPECT_EQ(counters()["planning_off"], 1);
}

TEST_F(ExecutiveFaults, AHangIsSaidOnceAndWhenItEnds) {
  held_ = true;
  pass(milliseconds(100));
  EXPECT_EQ(said(), "");
  EXPECT_EQ(said(seconds(2)), "critical planning hangs: its run does not end\n");
  EXPECT_EQ(said(seconds(3)), "");
  pass(milliseconds(1100));
  EXPECT_EQ(counters()["planning_hangs"], 1);
  held_ = false;
  pass(milliseconds(50));
  EXPECT_EQ(said(), "warning planning runs again\n");
  EXPECT_TRUE(counters().empty());
}

}  // namespace
}  // namespace saker::flight
