#include "saker/autonomy/team.h"

#include <gtest/gtest.h>

#include <numbers>

#include "saker/core/error.h"
#include "saker/core/rng.h"

namespace saker::autonomy {
namespace {

const objects::ClassTable kTable;
const slam::SlamConfig kSlam = [] {
  slam::SlamConfig config;
  config.measurement_noise = slam::NoiseSource::fixed;
  return config;
}();
const active::TargetsConfig kTargets;
const core::Budget kPlenty = core::Budget::iterations(kMergeIterations);
constexpr double kWell = 0.05, kBadly = 0.6;  // m: sd of a measured size

objects::Cuboid car(double x, double y) {
  objects::Cuboid cuboid;
  cuboid.pose.translation() = Eigen::Vector3d(x, y, 0.7);
  cuboid.size = {4.4, 1.8, 1.5};
  return cuboid;
}

objects::MapObject object(int id, const objects::Cuboid& cuboid) {
  objects::MapObject object;
  object.id = id;
  object.class_id = kTable.find("vehicle");
  object.model = cuboid;
  return object;
}

objects::Measurement measured(const SE3& T_lidar_base, const objects::Cuboid& car, double size_sd) {
  objects::Measurement measurement;
  measurement.class_id = kTable.find("vehicle");
  measurement.class_probability.assign(static_cast<std::size_t>(kTable.size()), 0);
  measurement.class_probability[static_cast<std::size_t>(measurement.class_id)] = 1;
  measurement.model = objects::transformed(T_lidar_base, objects::Model(car));
  Vector9d sd;
  sd << Eigen::Vector3d::Constant(0.02), Eigen::Vector3d::Constant(0.1),
      Eigen::Vector3d::Constant(size_sd);
  measurement.covariance = sd.cwiseAbs2().asDiagonal();
  return measurement;
}

SE3 pose(double x, double y, double yaw) {
  SE3 T = SE3::Identity();
  T.translation() = Eigen::Vector3d(x, y, 0);
  T.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  return T;
}

struct Seen {
  objects::Cuboid car;
  double size_sd;
};

/// A flight along x over cars in base, a keyframe a metre; every one sees every car.
exchange::UnpackedHistory flown(const std::string& robot, const SE3& T_base_odom,
                                const std::vector<Seen>& cars, bool surveyed) {
  exchange::UnpackedHistory told;
  told.history.robot = robot;
  told.history.flight = 1;
  if (surveyed) told.takeoff = slam::PosePrior{T_base_odom, covariance_of({})};
  for (int k = 0; k < 20; ++k) {
    slam::HistoryEntry entry;
    entry.stamp = from_seconds(10 + k);
    entry.T_odom_lidar.translation() = Eigen::Vector3d(k, 0, 3);
    entry.motion_covariance = 1e-6 * Matrix6d::Identity();
    const SE3 T_lidar_base = (T_base_odom * entry.T_odom_lidar).inverse();
    for (const Seen& seen : cars)
      entry.measurements.push_back(measured(T_lidar_base, seen.car, seen.size_sd));
    told.history.entries.push_back(std::move(entry));
  }
  return told;
}

TeamConfig at(std::vector<double> position_m, double yaw_deg = 0) {
  TeamConfig config;
  config.takeoff.position_m = std::move(position_m);
  config.takeoff.yaw_deg = yaw_deg;
  return config;
}

TEST(Team, WhatAnotherMappedWellNeedsNoVisitAndIsWhereItTrulyIs) {
  Team team(at({30, 4, 0}, 90), {}, kSlam, kTable);
  const SE3 T_base_world = pose(30, 4, std::numbers::pi / 2);
  const std::vector cars = {car(5, 6), car(15, -6), car(25, 6)};
  team.add(std::vector{flown("R2", pose(1, 2, 0.1), {{cars[0], kWell}, {cars[1], kWell}}, true)},
           kPlenty);
  objects::ObjectMap said;  // in world, half a metre off
  for (int i = 0; i < 3; ++i) {
    objects::Cuboid rough = cars[static_cast<std::size_t>(i)];
    rough.pose.translation().x() += 0.5;
    const objects::Model model =
        objects::transformed(T_base_world.inverse(), objects::Model(rough));
    said.objects.push_back(object(i, std::get<objects::Cuboid>(model)));
  }
  const TeamPrior told = team.prior(said, kTargets);
  EXPECT_EQ(told.prior.frame, "world");
  EXPECT_EQ(told.prior.objects.size(), 3U);
  EXPECT_EQ(told.known, 2);
  EXPECT_EQ(told.weak, 0);
  const Eigen::Vector3d place = objects::place(told.prior.objects[0].model);
  EXPECT_LT((T_base_world * place - cars[0].pose.translation()).norm(), 0.25);  // by the survey
}

TEST(Team, WhatAnotherMappedBadlyIsAmongTheTargetsThoughNobodySaidSo) {
  Team team(at({0, 0, 0}), {}, kSlam, kTable);
  team.add(std::vector{flown("R2", pose(1, 2, 0), {{car(5, 6), kBadly}}, true)}, kPlenty);
  const TeamPrior told = team.prior({}, kTargets);
  EXPECT_EQ(told.prior.objects.size(), 1U);
  EXPECT_EQ(told.known, 0);
  EXPECT_EQ(told.weak, 1);
}

TEST(Team, OutsideItsLotARobotLeavesTheRestToOthers) {
  TeamConfig config = at({0, 0, 0});
  config.lot_m = {0, -9, 10, -9, 10, 9, 0, 9};
  Team team(config, {}, kSlam, kTable);
  team.add(
      std::vector{flown("R2", pose(1, 2, 0), {{car(5, 6), kBadly}, {car(15, 6), kBadly}}, true)},
      kPlenty);
  EXPECT_EQ(team.prior({}, kTargets).prior.objects.size(), 1U);
}

TEST(Team, AFlightThatBeganNobodyKnowsWhereIsLeftOutAndNamed) {
  Team team(at({0, 0, 0}), {}, kSlam, kTable);
  team.add(std::vector{flown("R3", pose(1, 2, 0), {{car(5, 6), kWell}}, false)}, kPlenty);
  ASSERT_EQ(team.told().size(), 1U);
  EXPECT_EQ(team.text(), "R3 flight 1 (0 of 20 keyframes: nobody knows where it took off)");
  EXPECT_TRUE(team.map().objects.empty());
}

TEST(Team, WithoutASurveyOfItsOwnARobotMergesWhenItHasFlown) {
  Team team({}, {}, kSlam, kTable);
  std::vector<Seen> cars;  // as many as make a place unmistakable
  core::Rng rng(1);
  for (int i = 0; i < 20; ++i)
    cars.push_back({car(rng.uniform(-40, 40), rng.uniform(-40, 40)), kWell});
  const std::vector others = {flown("R2", pose(1, 2, 0), cars, true)};
  team.add(others, kPlenty);
  EXPECT_EQ(team.told()[0].merged, 0);
  team.add_own(flown("R1", pose(3, 1, 0), cars, false).history, kPlenty);
  team.add(others, kPlenty);
  EXPECT_EQ(team.told()[0].merged, 20) << team.text();
  EXPECT_EQ(team.map().frame, "world");
  EXPECT_EQ(team.map().objects.size(), cars.size());
}

TEST(Team, WhatDoesNotFitIntoTheTimeIsLeftOutAndTakenLater) {
  Team team(at({0, 0, 0}), {}, kSlam, kTable);
  const std::vector told = {flown("R2", pose(1, 2, 0), {{car(5, 6), kWell}}, true)};
  team.add(told, core::Budget::until(core::Budget::Clock::now(), kMergeIterations));
  EXPECT_EQ(team.text(), "R2 flight 1 (0 of 20 keyframes: no time was left)");
  team.add(told, kPlenty);
  EXPECT_EQ(team.text(), "R2 flight 1 (20 of 20 keyframes)");
}

TEST(Team, RefusesATakeOffThatIsNoPoint) {
  EXPECT_THROW(Team(at({1, 2}), {}, kSlam, kTable), Error);
}

}  // namespace
}  // namespace saker::autonomy
