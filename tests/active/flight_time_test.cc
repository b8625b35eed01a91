#include "saker/active/views/flight_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "saker/core/rng.h"

namespace saker::active {
namespace {

const motion::LimitsConfig kLimits;

TEST(FlightTime, OfALongWayIsAtTopSpeedAndTheRampsBeside) {
  const double expected =
      50 / kLimits.max_speed + kLimits.max_speed / kLimits.max_acceleration + kLimits.smoothing_s();
  EXPECT_NEAR(flight_time_s({50, 0, 0}, 0, kLimits), expected, 1e-12);
}

TEST(FlightTime, OfAShortWayIsHalfSpeedingUpHalfSlowingDown) {
  const double expected = 2 * std::sqrt(1.0 / kLimits.max_acceleration) + kLimits.smoothing_s();
  EXPECT_NEAR(flight_time_s({0.6, 0.8, 0}, 0, kLimits), expected, 1e-12);
}

TEST(FlightTime, OfATurnOnTheSpotIsTheTurns) {
  const double rate = kLimits.max_yaw_rate_deg * std::numbers::pi / 180;
  const double ramp = kLimits.max_yaw_rate_deg / kLimits.max_yaw_acceleration_deg;
  const double expected = std::numbers::pi / rate + ramp + kLimits.smoothing_s();
  EXPECT_NEAR(flight_time_s({0, 0, 0}, -std::numbers::pi, kLimits), expected, 1e-12);
}

TEST(FlightTime, OfAClimbIsSlower) {
  EXPECT_GT(flight_time_s({0, 0, 10}, 0, kLimits), flight_time_s({10, 0, 0}, 0, kLimits));
}

TEST(FlightTime, OfAWayInTwoPartsIsNoLess) {
  core::Rng rng(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const Eigen::Vector3d a(9 * rng.normal(), 9 * rng.normal(), rng.normal());
    const Eigen::Vector3d b(3 * rng.normal(), 3 * rng.normal(), rng.normal());
    const double turn_a = rng.normal(), turn_b = rng.normal();
    EXPECT_LE(flight_time_s(a + b, turn_a + turn_b, kLimits),
              flight_time_s(a, turn_a, kLimits) + flight_time_s(b, turn_b, kLimits) + 1e-12);
  }
}

}  // namespace
}  // namespace saker::active
