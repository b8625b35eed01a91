#include "saker/slam/history.h"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "made_world.h"

namespace saker::slam {
namespace {

using namespace made;

const core::Budget kPlenty = core::Budget::iterations(4);

void fly(Slam& slam, Robot& robot, const std::vector<SE3>& poses, double& seconds) {
  for (const SE3& pose : poses) (void)slam.update(robot.step(seconds += 0.5, pose), kPlenty);
}

double measurements_an_entry(const History& history) {
  double sum = 0;
  for (const HistoryEntry& entry : history.entries)
    sum += static_cast<double>(entry.measurements.size());
  return sum / static_cast<double>(history.entries.size());
}

/// Which of the world's objects a measurement is of, by the true pose; −1 for none.
int object_of(const Measurement& measured, const SE3& T_world_lidar,
              const std::vector<TrueObject>& world) {
  const Eigen::Vector3d at = T_world_lidar * objects::place(measured.model);
  for (std::size_t i = 0; i < world.size(); ++i) {
    if ((objects::place(world[i].model) - at).head<2>().norm() < 1) return static_cast<int>(i);
  }
  return -1;
}

TEST(History, HoldsEveryKeyframeButTheNewestAndEachObjectOnceAKeyframe) {
  Slam slam(honest_config(), {});
  Robot robot(ring_of_objects(20, 10), {}, 1);
  const std::vector<SE3> poses = loop(20, 1.1, 2);
  double seconds = 0;
  fly(slam, robot, poses, seconds);
  const History& history = slam.history();
  ASSERT_EQ(history.entries.size() + 1, slam.keyframes().size());
  for (std::size_t k = 0; k < history.entries.size(); ++k) {
    const HistoryEntry& entry = history.entries[k];
    EXPECT_EQ(entry.stamp, slam.keyframes()[k].stamp);
    EXPECT_TRUE(entry.T_odom_lidar.isApprox(slam.keyframes()[k].T_odom_lidar));
    std::set<int> objects;
    for (const Measurement& m : entry.measurements) {
      const int object = object_of(m, poses[k], robot.world());
      EXPECT_GE(object, 0);
      EXPECT_TRUE(objects.insert(object).second) << "twice in entry " << k;
      EXPECT_TRUE(valid({m.model, m.covariance}));
    }
  }
}

TEST(History, WhatWasWrittenNeverChanges) {
  Slam slam(honest_config(), {});
  Robot robot(ring_of_objects(20, 10), {}, 2);
  double seconds = 0;
  fly(slam, robot, loop(20, 1.1, 0.5), seconds);
  const History before = slam.history();
  fly(slam, robot, loop(20, 1.1, 1), seconds);
  ASSERT_GT(slam.history().entries.size(), before.entries.size());
  for (std::size_t k = 0; k < before.entries.size(); ++k) {
    const HistoryEntry &was = before.entries[k], &is = slam.history().entries[k];
    EXPECT_EQ(was.T_odom_lidar.matrix(), is.T_odom_lidar.matrix());
    ASSERT_EQ(was.measurements.size(), is.measurements.size());
    for (std::size_t i = 0; i < was.measurements.size(); ++i) {
      EXPECT_EQ(objects::place(was.measurements[i].model),
                objects::place(is.measurements[i].model));
      EXPECT_EQ(was.measurements[i].covariance, is.measurements[i].covariance);
    }
  }
}

TEST(History, TenMinutesAreSixHundredEntriesWithFourMeasurementsEach) {
  Slam slam(honest_config(), {});
  const double radius = 600 / (6 * std::numbers::pi);  // a hundred objects on three rounds of 200 m
  Robot robot(ring_of_objects(radius, 50), {}, 1);
  double seconds = 0;
  for (const SE3& pose : loop(radius, 0.5, 3))
    (void)slam.update(robot.step(seconds += 0.5, pose), core::Budget::iterations(0));
  EXPECT_NEAR(seconds, 600, 1);
  EXPECT_LE(slam.history().entries.size(), 610U);
  EXPECT_LT(measurements_an_entry(slam.history()), 4.5);
  EXPECT_GT(measurements_an_entry(slam.history()), 2);
}

TEST(History, LeavesOutWhatIsNotBelieved) {
  Slam slam(honest_config(), {});
  Robot robot({{car(5, 6, 0), kVehicle}}, {}, 3);
  for (int i = 0; i < 20; ++i) {
    SlamInput input = robot.step(0.5 * i, flat_pose(i, 0, 1.5, 0));
    if (i % 5 == 0) {  // a trunk that is there in one window only
      input.detections.measurements.push_back(
          robot.measure({trunk(i, -5), kTrunk}, input.detections.stamp));
    }
    (void)slam.update(input, kPlenty);
  }
  int vehicles = 0, trunks = 0;
  for (const HistoryEntry& entry : slam.history().entries) {
    for (const Measurement& m : entry.measurements) ++(is_cuboid(m.model) ? vehicles : trunks);
  }
  EXPECT_GT(vehicles, 0);
  EXPECT_EQ(trunks, 0);
}

TEST(History, TakesBackWhatTurnsOutToMove) {
  Slam slam(honest_config(), {});
  Robot robot({{car(0, 0, 0, 4.8), kVehicle}}, {}, 4);
  int told = 0, taken_back = 0;
  for (int i = 0; i < 40; ++i) {
    const double ahead = std::max(0, i - 20) * 0.3;  // it stands for 10 s, then rolls away
    robot.world()[0].model = car(ahead, 0, 0, 4.8);
    (void)slam.update(robot.step(0.5 * i, flat_pose(0, -8, 1.5, 0)), kPlenty);
  }
  for (const HistoryEntry& entry : slam.history().entries) {
    for (const Measurement& m : entry.measurements) ++(m.moving ? taken_back : told);
  }
  EXPECT_GT(told, 0);
  EXPECT_EQ(taken_back, 1);
  EXPECT_TRUE(slam.map().objects.empty());
}

TEST(History, GathersEvidenceOfTheClass) {
  Slam slam(honest_config(), {});
  Robot robot({{car(8, 5, 0), kVehicle}}, {}, 5);
  double seconds = 0;
  for (int i = 0; i < 14; ++i)
    (void)slam.update(robot.step(seconds += 0.5, flat_pose(0.5 * i, 0, 1.5, 0)), kPlenty);
  const auto& entries = slam.history().entries;
  const auto first =
      std::ranges::find_if(entries, [](const HistoryEntry& e) { return !e.measurements.empty(); });
  ASSERT_NE(first, entries.end());
  const Measurement& m = first->measurements[0];
  EXPECT_EQ(m.class_id, kVehicle);
  EXPECT_GT(m.class_probability[kVehicle], 0.999);  // five windows that say 0.8
  EXPECT_GE(m.points, 5 * 200);
}

}  // namespace
}  // namespace saker::slam
