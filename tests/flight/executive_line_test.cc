#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <sstream>

#include "flight/executive/flight_line.h"
#include "terminal.h"

namespace saker::flight {
namespace {

TEST(FlightLine, SaysWhereTheFlightStands) {
  EXPECT_EQ(flight_line({.phase = "tour",
                         .target = 3,
                         .targets = 8,
                         .height_m = 3.42,
                         .battery_share = 0.871,
                         .clearance_m = 1.25,
                         .worst_loop = "mapping",
                         .lateness_ms = 4.06}),
            "tour  target 3 of 8  height 3.4 m  battery 87 %  clearance 1.2 m  worst loop mapping "
            "4.1 ms late");
}

TEST(FlightLine, WhatIsNotKnownIsADash) {
  EXPECT_EQ(flight_line({.phase = "preflight"}), "preflight  height -  battery -  clearance -");
}

TEST(FlightLine, FitsIntoATerminalOfOrdinaryWidth) {
  const std::string line = flight_line({.phase = "returning",
                                        .target = 12,
                                        .targets = 12,
                                        .height_m = 12.3,
                                        .battery_share = 1,
                                        .clearance_m = 3,
                                        .worst_loop = "segmentation",
                                        .lateness_ms = 104.2});
  EXPECT_LE(line.size(), 120U) << line;
}

/// The process's log, on stderr and in a file.
class LoggedFlight : public ::testing::Test {
 protected:
  void start_log(spdlog::level::level_enum level) {
    auto logger = std::make_shared<spdlog::logger>(
        "saker-flight", spdlog::sinks_init_list{
                            std::make_shared<spdlog::sinks::stderr_color_sink_mt>(), file_sink_});
    logger->set_level(level);
    spdlog::set_default_logger(std::move(logger));
  }
  void TearDown() override { spdlog::set_default_logger(before_); }

  std::ostringstream file_;
  spdlog::sink_ptr file_sink_ = std::make_shared<spdlog::sinks::ostream_sink_mt>(file_);
  std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
};

TEST_F(LoggedFlight, OnATerminalTheLineStandsAloneAndTheLogGoesToItsFile) {
  const made::Terminal terminal(120);
  start_log(spdlog::level::info);
  {
    FlightLine line;
    line.show({.phase = "tour"});
    EXPECT_EQ(terminal.text(), "\r\033[Ktour  height -  battery -  clearance -");
    spdlog::info("takeoff → tour");
    EXPECT_EQ(terminal.text(), "");
    spdlog::warn("the battery is low");
    const std::string text = terminal.text();
    EXPECT_EQ(text.find("\r\033[K"), 0U) << text;
    EXPECT_NE(text.find("the battery is low\r\n"), std::string::npos) << text;
  }
  EXPECT_EQ(terminal.text(), "\r\n");
  spdlog::info("the base has this flight");
  EXPECT_NE(terminal.text().find("the base has this flight"), std::string::npos);
  EXPECT_NE(file_.str().find("takeoff → tour"), std::string::npos);
}

TEST_F(LoggedFlight, WithVerboseEveryLineOfTheLogStandsAboveIt) {
  const made::Terminal terminal(120);
  start_log(spdlog::level::debug);
  FlightLine line;
  spdlog::debug("loops: planning 41 ms");
  EXPECT_NE(terminal.text().find("loops: planning 41 ms"), std::string::npos);
}

TEST_F(LoggedFlight, WithoutATerminalEveryEventIsALineAndThereIsNoOther) {
  start_log(spdlog::level::info);
  ::testing::internal::CaptureStderr();
  {
    FlightLine line;
    line.show({.phase = "tour"});
    spdlog::info("takeoff → tour");
  }
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("takeoff → tour\n"), std::string::npos) << text;
  EXPECT_EQ(text.find('\r'), std::string::npos) << text;
}

}  // namespace
}  // namespace saker::flight
