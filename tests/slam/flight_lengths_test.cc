#include "slam/flight_lengths.h"

#include <gtest/gtest.h>

#include "made_world.h"
#include "slam/merge_config.h"

namespace saker::slam {
namespace {

using namespace made;

constexpr double kTrue = 4.5, kCut = 3.7;
constexpr double kNearEnd = 7.75;  // of a vehicle of that length at x = 10
const core::Budget kPlenty = core::Budget::iterations(50);

/// Flights that stand still, and what they measured of a vehicle ahead of them.
struct Flights {
  std::vector<std::vector<Keyframe>> keyframes;
  std::vector<Landmark> landmarks = std::vector<Landmark>(1);

  Flights() { landmarks[0].model = car(10, 0, 0, 4); }

  /// Windows that see its near end, and `length` of it. \param back_m  of the flight behind x = 0
  void add(int windows, double length, double back_m = 0) {
    const int chain = static_cast<int>(keyframes.size());
    const SE3 T_world_lidar = flat_pose(-back_m, 0, 0, 0);
    keyframes.emplace_back();
    const Cuboid seen = car(kNearEnd + length / 2 + back_m, 0, 0, length);
    const Eigen::MatrixXd covariance = 0.01 * Eigen::MatrixXd::Identity(9, 9);
    for (int k = 0; k < windows; ++k) {
      keyframes.back().push_back(
          {k, from_seconds(k), T_world_lidar, T_world_lidar, 1e-6 * Matrix6d::Identity()});
      landmarks[0].observations.push_back({k, {seen, covariance}, -1, 1, chain});
    }
  }

  Cuboid weighed() {
    std::vector<Chain> chains;
    for (auto& each : keyframes) {
      chains.push_back({&each, PosePrior{each.front().T_world_lidar, 1e-6 * Matrix6d::Identity()}});
    }
    GraphConfig config;
    config.iterations = 50;
    weigh_flights(landmarks, chains, config, MergeConfig{}, kPlenty);
    return std::get<Cuboid>(landmarks[0].model);
  }
};

double near_end(const Cuboid& cuboid) {
  return cuboid.pose.translation().x() - cuboid.size.x() / 2;
}

TEST(FlightLengths, AFlightsManyWindowsDoNotHideTheEndThatAnotherSaw) {
  Flights few, many;
  few.add(3, kTrue);
  few.add(3, kCut);
  many.add(3, kTrue);
  many.add(60, kCut);
  EXPECT_NEAR(few.weighed().size.x(), kTrue, 0.06);
  EXPECT_NEAR(many.weighed().size.x(), kTrue, 0.06);
}

TEST(FlightLengths, OfTwoFlightsAreTheirExpectile) {
  Flights flights;
  flights.add(5, kCut);
  flights.add(5, kTrue);
  const double shorter = MergeConfig{}.shorter_flight;
  EXPECT_NEAR(flights.weighed().size.x(), (kTrue + shorter * kCut) / (1 + shorter), 0.01);
}

TEST(FlightLengths, BothEndsMoveAsTheyWereSeen) {
  Flights flights;
  flights.add(5, kCut);
  flights.add(5, kTrue);
  EXPECT_NEAR(near_end(flights.weighed()), kNearEnd, 0.01);
}

TEST(FlightLengths, ALookFromAfarDoesNotCount) {
  Flights flights;
  flights.add(5, kTrue);
  flights.add(5, kTrue - 0.1);
  flights.add(5, kTrue + 1, 20);
  EXPECT_LT(flights.weighed().size.x(), kTrue + 0.01);
}

TEST(FlightLengths, WhatOneFlightSawFromNearByIsNotCutByALookFromAfar) {
  Flights flights;
  flights.add(5, kTrue);
  flights.add(50, kCut, 20);
  EXPECT_NEAR(flights.weighed().size.x(), kTrue, 0.01);
}

TEST(FlightLengths, OneFlightAloneIsLeftAsItIs) {
  Flights flights;
  flights.add(5, kTrue);
  EXPECT_DOUBLE_EQ(flights.weighed().size.x(), 4);
}

TEST(FlightLengths, PosesStayWhereTheyAre) {
  Flights flights;
  flights.add(3, kTrue);
  flights.add(3, kCut);
  const auto before = flights.keyframes;
  (void)flights.weighed();
  for (std::size_t c = 0; c < before.size(); ++c) {
    for (std::size_t k = 0; k < before[c].size(); ++k) {
      EXPECT_TRUE(before[c][k].T_world_lidar.isApprox(flights.keyframes[c][k].T_world_lidar));
    }
  }
}

}  // namespace
}  // namespace saker::slam
