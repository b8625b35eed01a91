#include <gtest/gtest.h>

#include <algorithm>

#include "flight/executive/health_counters.h"
#include "saker/health_t.hpp"

namespace saker::flight {
namespace {

/// As in a flight with an exchange in which the sensor's gate refuses.
class ExecutiveHealth : public testing::Test {
 protected:
  ExecutiveHealth() {
    figures.orders = {{"orders_refused", 0}};
    figures.sensor = {{"sensor_refused", 9}, {"sensor_source", 5}, {"sensor_ahead", 3}};
    figures.drops = {{"packets_dropped", 0}, {"imu_dropped", 0}};
    figures.exchange = several("exchange_", 12);
    figures.team = several("team_", 3);
  }

  static Counters several(const std::string& name, int many) {
    Counters counters;
    for (int i = 0; i < many; ++i) counters.emplace_back(name + std::to_string(i), i);
    return counters;
  }
  [[nodiscard]] bool says(const std::string& name) const {
    const std::vector<counter_t> counters = health_counters(figures);
    EXPECT_LE(counters.size(), static_cast<std::size_t>(health_t::MAX_COUNTERS));
    return std::ranges::any_of(counters, [&](const counter_t& c) { return c.name == name; });
  }

  HealthFigures figures;
};

TEST_F(ExecutiveHealth, WithAnExchangeTheSensorsGateIsOnItAndTheTeamsFiguresToo) {
  EXPECT_TRUE(says("sensor_refused"));
  EXPECT_TRUE(says("sensor_source"));
  EXPECT_TRUE(says("orders_refused"));
  EXPECT_TRUE(says("exchange_11"));
  EXPECT_TRUE(says("team_2"));
}

TEST_F(ExecutiveHealth, WhereLoopsFailTheLeastImportantGivesWay) {
  figures.faults = several("mapping_threw", 5);
  EXPECT_TRUE(says("mapping_threw4"));
  EXPECT_TRUE(says("sensor_refused"));
  EXPECT_TRUE(says("orders_refused"));
  EXPECT_FALSE(says("team_2"));
}

TEST_F(ExecutiveHealth, AQueueIsOnItOnceItDropped) {
  EXPECT_FALSE(says("packets_dropped"));
  figures.drops.front().second = 1;
  EXPECT_TRUE(says("packets_dropped"));
  EXPECT_FALSE(says("imu_dropped"));
}

TEST_F(ExecutiveHealth, TheMostImportantComesFirst) {
  figures.faults = {{"pose_hangs", 1}};
  const std::vector<counter_t> counters = health_counters(figures);
  EXPECT_EQ(counters[0].name, "pose_hangs");
  EXPECT_EQ(counters[1].name, "orders_refused");
  EXPECT_EQ(counters[2].name, "sensor_refused");
  EXPECT_EQ(counters[2].value, 9);
}

}  // namespace
}  // namespace saker::flight
