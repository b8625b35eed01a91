#include "saker/slam/slam.h"

#include <gtest/gtest.h>

#include <numbers>

#include "made_world.h"
#include "saker/core/error.h"
#include "saker/objects/map_io.h"

namespace saker::slam {
namespace {

using namespace made;

constexpr double kStepSeconds = 0.5;
const core::Budget kPlenty = core::Budget::iterations(20);

/// Drives all poses; returns the largest distance in x-y between estimated and true keyframe, and
/// of odometry.
struct Drive {
  Slam slam;
  Robot robot;
  double worst_estimate = 0, worst_odometry = 0;

  Drive(const SlamConfig& config, Robot the_robot, const objects::ClassTable& table = {})
      : slam(config, table), robot(std::move(the_robot)) {}

  void along(const std::vector<SE3>& poses) {
    std::vector<SE3> truth;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const auto input = robot.step(kStepSeconds * static_cast<double>(i), poses[i]);
      if (slam.update(input, kPlenty).keyframe_added)
        truth.push_back(robot.T_start().inverse() * poses[i]);
    }
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const Keyframe& keyframe = slam.keyframes()[k];
      worst_estimate = std::max(
          worst_estimate, (truth[k].translation() - keyframe.T_world_lidar.translation()).norm());
      worst_odometry = std::max(
          worst_odometry, (truth[k].translation() - keyframe.T_odom_lidar.translation()).norm());
    }
  }

  /// The true object in SLAM's world.
  [[nodiscard]] Model truth(std::size_t i) {
    return objects::transformed(robot.T_start().inverse(), robot.world()[i].model);
  }

  /// The mapped object nearest to a true one.
  [[nodiscard]] static const objects::MapObject* nearest(const objects::ObjectMap& map,
                                                         const Model& model) {
    const objects::MapObject* best = nullptr;
    double least = 1;
    for (const objects::MapObject& object : map.objects) {
      const double distance =
          (objects::place(object.model) - objects::place(model)).head<2>().norm();
      if (distance < least) best = &object, least = distance;
    }
    return best;
  }
};

TEST(Slam, MapsALoopBetterThanOdometry) {
  Drive drive(honest_config(), Robot(ring_of_objects(20, 10), {}, 1));
  drive.along(loop(20, 1, 2));
  const objects::ObjectMap map = drive.slam.map();
  ASSERT_EQ(map.objects.size(), 20U);
  for (std::size_t i = 0; i < 20; ++i) {
    const auto* object = Drive::nearest(map, drive.truth(i));
    ASSERT_NE(object, nullptr) << i;
    EXPECT_EQ(object->class_id, drive.robot.world()[i].class_id);
    EXPECT_LT((objects::place(object->model) - objects::place(drive.truth(i))).norm(), 0.3);
  }
  EXPECT_GT(drive.worst_odometry, 0.5);
  EXPECT_LT(drive.worst_estimate, 0.5 * drive.worst_odometry);
  EXPECT_LT(drive.worst_estimate, 0.3);
}

TEST(Slam, SizesConvergeToTheTruth) {
  Drive drive(honest_config(), Robot(ring_of_objects(20, 10), {}, 2));
  drive.along(loop(20, 1, 2));
  const objects::ObjectMap map = drive.slam.map();
  for (std::size_t i = 0; i < 20; i += 2) {
    const auto* object = Drive::nearest(map, drive.truth(i));
    ASSERT_NE(object, nullptr);
    const Eigen::VectorXd error = difference(object->model, drive.truth(i));
    EXPECT_LT(error.tail<3>().norm(), 0.15) << error.transpose();
    EXPECT_LT(error.head<3>().norm(), 0.05) << error.transpose();
  }
}

/// Normalised estimation error squared of all objects over several worlds: the covariances say what
/// the errors are.
TEST(Slam, CovarianceIsConsistentWithTheErrors) {
  double squared = 0, dimensions = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Drive drive(honest_config(), Robot(ring_of_objects(12, 5), {}, seed));
    drive.along(loop(12, 1, 1));
    const auto [map, marginal] = drive.slam.map_with_covariance();
    EXPECT_TRUE(marginal);
    for (std::size_t i = 0; i < drive.robot.world().size(); ++i) {
      const auto* object = Drive::nearest(map, drive.truth(i));
      ASSERT_NE(object, nullptr);
      const Eigen::VectorXd error = difference(drive.truth(i), object->model);
      squared += error.dot(object->covariance.llt().solve(error));
      dimensions += static_cast<double>(error.size());
    }
  }
  EXPECT_GT(squared / dimensions, 0.7);
  EXPECT_LT(squared / dimensions, 1.3);
}

/// With fitted noise cells share it instead.
TEST(Slam, WhatWindowsShareWidensWhatIsReportedButNotByThePoses) {
  for (const NoiseSource source : {NoiseSource::fixed, NoiseSource::fitted}) {
    SlamConfig config = honest_config();
    config.measurement_noise = source;
    config.noise.shared_end_per_m = 0;
    Drive drive(config, Robot(ring_of_objects(12, 5), {.drawn = 0}, 1));
    drive.along(loop(12, 1, 1));
    const objects::ObjectMap own = drive.slam.map_with_covariance().map;
    const objects::ObjectMap reported = drive.slam.reported_map();
    const objects::ObjectMap given = drive.slam.map_given_poses();
    ASSERT_EQ(reported.objects.size(), own.objects.size());
    const bool all = source == NoiseSource::fixed;
    const MeasurementNoiseConfig& noise = config.noise;
    for (std::size_t i = 0; i < own.objects.size(); ++i) {
      const auto expect_widened = [&](int row, double windows) {
        const double measured = given.objects[i].covariance(row, row) / windows;
        EXPECT_NEAR(reported.objects[i].covariance(row, row) - own.objects[i].covariance(row, row),
                    (windows - 1) * measured, 1e-9);
      };
      if (is_cuboid(own.objects[i].model)) {
        expect_widened(3, all ? noise.shared_place : 1);
        expect_widened(6, all ? noise.shared_length : 1);
        if (all) expect_widened(7, noise.shared_width);
        expect_widened(8, 1);
      } else {
        expect_widened(0, all ? noise.shared_root : 1);
        expect_widened(5, all ? noise.shared_radius : noise.shared_radius_cells);
      }
    }
  }
}

TEST(Slam, WithFittedNoiseNoWidthIsReportedWorseThanItsClassKnowsIt) {
  SlamConfig config = honest_config();
  config.measurement_noise = NoiseSource::fitted;
  objects::ClassTable table;
  table.classes[kVehicle].width_sd_m = 0.01;
  Drive drive(config, Robot(ring_of_objects(12, 5), {.drawn = 0}, 1), table);
  drive.along(loop(12, 1, 1));
  int vehicles = 0;
  for (const objects::MapObject& object : drive.slam.map_given_poses().objects) {
    if (!is_cuboid(object.model)) continue;
    EXPECT_LE(std::sqrt(object.covariance(7, 7)), 0.01);
    ++vehicles;
  }
  EXPECT_EQ(vehicles, 5);
}

TEST(Slam, NoEndOfAnIncompleteObjectIsReportedBetterThanOneWindowSawIt) {
  SlamConfig config = honest_config();
  config.landmarks.most_length_sd_m = 0.01;  // no window states a length so well
  Drive drive(config, Robot(ring_of_objects(12, 5), {}, 1));
  drive.along(loop(12, 1, 1));
  const objects::ObjectMap reported = drive.slam.reported_map();
  const objects::ObjectMap given = drive.slam.map_given_poses();
  ASSERT_FALSE(reported.incomplete.empty());
  const double of_a_window = Noise{}.object_size * Noise{}.object_size;
  for (std::size_t i = 0; i < reported.incomplete.size(); ++i) {
    const Eigen::MatrixXd& covariance = reported.incomplete[i].covariance;
    const Eigen::MatrixXd& of_all = given.incomplete[i].covariance;
    ASSERT_EQ(covariance.rows(), 9);
    EXPECT_GT(covariance(6, 6), 0.99 * of_a_window);
    EXPECT_LT(of_all(6, 6), 0.5 * of_a_window);
    EXPECT_DOUBLE_EQ(covariance(7, 7), of_all(7, 7)) << "the width is seen";
  }
}

TEST(Slam, EndsAreReportedNoBetterKnownThanWhatTheirWindowsShare) {
  const double of_a_window = Noise{}.object_size * Noise{}.object_size;
  for (const double share_per_m : {0.0, 1000.0}) {
    SlamConfig config = honest_config();
    config.noise.shared_end_per_m = share_per_m;
    Drive drive(config, Robot(ring_of_objects(12, 5), {}, 1));
    drive.along(loop(12, 1, 1));
    for (const objects::ObjectMap& map :
         {drive.slam.reported_map(), drive.slam.map_given_poses()}) {
      for (const objects::MapObject& object : map.objects) {
        if (!is_cuboid(object.model)) continue;
        const double length = object.covariance(6, 6);
        if (share_per_m > 0) {
          EXPECT_GT(length, 0.8 * of_a_window);
        } else {
          EXPECT_LT(length, 0.5 * of_a_window);
        }
      }
    }
  }
}

TEST(Slam, GivenThePosesPlacesAreKnownBetterAndSizesAsWell) {
  Drive drive(honest_config(), Robot(ring_of_objects(12, 5), {}, 1));
  drive.along(loop(12, 1, 1));
  const objects::ObjectMap reported = drive.slam.reported_map();
  const objects::ObjectMap given = drive.slam.map_given_poses();
  ASSERT_EQ(given.objects.size(), reported.objects.size());
  for (std::size_t i = 0; i < given.objects.size(); ++i) {
    const bool cuboid = is_cuboid(given.objects[i].model);
    const Eigen::VectorXd ratio = given.objects[i].covariance.diagonal().cwiseQuotient(
        reported.objects[i].covariance.diagonal());
    EXPECT_LT(ratio[cuboid ? 3 : 0], 0.9);
    EXPECT_NEAR(ratio[cuboid ? 6 : 5], 1, 0.1);
  }
}

TEST(Slam, WhatWasSeenOnceIsTentativeUntilItIsInTheMap) {
  Drive drive({}, Robot(ring_of_objects(15, 6), {}, 7));
  const auto poses = loop(15, 1);
  drive.along({poses.begin(), poses.begin() + 1});
  EXPECT_TRUE(drive.slam.map().objects.empty());
  const auto once = drive.slam.tentative();
  ASSERT_FALSE(once.empty());
  for (const objects::MapObject& object : once) EXPECT_EQ(object.observations, 1);
  Drive whole({}, Robot(ring_of_objects(15, 6), {}, 7));
  whole.along(poses);
  const objects::ObjectMap map = whole.slam.map();
  ASSERT_FALSE(map.objects.empty());
  for (const objects::MapObject& object : whole.slam.tentative()) {
    EXPECT_TRUE(std::ranges::none_of(
        map.objects, [&](const objects::MapObject& mapped) { return mapped.id == object.id; }));
  }
}

TEST(Slam, TwoRunsAreIdentical) {
  std::string maps[2];
  for (std::string& bytes : maps) {
    Drive drive({}, Robot(ring_of_objects(15, 6), {}, 7));
    drive.along(loop(15, 1));
    bytes = objects::to_json(drive.slam.map_with_covariance().map, {});
    for (const Keyframe& k : drive.slam.keyframes()) {
      bytes.append(reinterpret_cast<const char*>(k.T_world_lidar.data()), 16 * sizeof(double));
    }
  }
  EXPECT_EQ(maps[0], maps[1]);
}

TEST(Slam, NoBudgetLeavesThePosesWhereOdometryPutThem) {
  Slam slam({}, {});
  Robot robot(ring_of_objects(10, 5), {}, 3);
  double seconds = 0;
  for (const SE3& pose : loop(10, 1)) {
    const SlamUpdate update =
        slam.update(robot.step(seconds += 0.5, pose), core::Budget::iterations(0));
    EXPECT_EQ(update.solve.iterations, 0);
  }
  for (const Keyframe& k : slam.keyframes()) {
    EXPECT_TRUE(k.T_world_lidar.isApprox(k.T_odom_lidar, 1e-9));
  }
}

TEST(Slam, CorrectedPosesPassThroughTheKeyframes) {
  Drive drive(honest_config(), Robot(ring_of_objects(15, 6), {}, 4));
  drive.along(loop(15, 1));
  const auto& keyframes = drive.slam.keyframes();
  for (const Keyframe& k : keyframes) {
    EXPECT_TRUE(drive.slam.corrected(k.stamp, k.T_odom_lidar).isApprox(k.T_world_lidar, 1e-9));
  }
  const Keyframe &a = keyframes[3], &b = keyframes[4];
  const SE3 nearly_b = drive.slam.corrected(b.stamp - 1, b.T_odom_lidar);
  EXPECT_LT((nearly_b.translation() - b.T_world_lidar.translation()).norm(), 1e-6);
  const SE3 nearly_a = drive.slam.corrected(a.stamp + 1, a.T_odom_lidar);
  EXPECT_LT((nearly_a.translation() - a.T_world_lidar.translation()).norm(), 1e-6);
}

TEST(Slam, RefusesOldAndInvalidInputsUnchanged) {
  Slam slam({}, {});
  Robot robot(ring_of_objects(10, 5), {}, 5);
  const SlamInput input = robot.step(1, flat_pose(10, 0, 1, 0));
  EXPECT_EQ(slam.update(input, kPlenty).status, SlamStatus::updated);
  EXPECT_EQ(slam.update(input, kPlenty).status, SlamStatus::old_input);
  SlamInput broken = robot.step(2, flat_pose(12, 0, 1, 0));
  broken.T_odom_lidar.translation().x() = NAN;
  EXPECT_EQ(slam.update(broken, kPlenty).status, SlamStatus::invalid_input);
  EXPECT_EQ(slam.keyframes().size(), 1U);
}

TEST(Slam, CountsMeasurementsThatAreNotUsable) {
  Slam slam({}, {});
  Robot robot({{car(5, 0, 0), kVehicle}}, {}, 6);
  SlamInput input = robot.step(1, flat_pose(0, 0, 1, 0));
  input.detections.measurements.push_back(input.detections.measurements[0]);
  input.detections.measurements[1].covariance.setConstant(NAN);
  input.detections.measurements.push_back(input.detections.measurements[0]);
  input.detections.measurements[2].class_probability.clear();
  const SlamUpdate update = slam.update(input, kPlenty);
  EXPECT_EQ(update.refused, 2);
  EXPECT_EQ(update.created, 1);
}

TEST(Slam, KeepsWithinItsCeilings) {
  SlamConfig config;
  config.keyframes.most = 20;
  config.landmarks.most = 6;
  config.ground.most_cells = 5;
  Drive drive(config, Robot(ring_of_objects(20, 10), {}, 1));
  double seconds = 0;
  for (const SE3& pose : loop(20, 1))
    (void)drive.slam.update(drive.robot.step(seconds += 0.5, pose), kPlenty);
  EXPECT_LE(drive.slam.keyframes().size(), 20U);
  EXPECT_LE(drive.slam.map().objects.size(), 6U);
  EXPECT_LE(drive.slam.map().ground.size(), 5U);
}

TEST(Slam, KeyframesTooOldToMoveStayWhereTheyAre) {
  SlamConfig config = honest_config();
  config.graph.movable_keyframes = 10;
  Drive drive(config, Robot(ring_of_objects(20, 10), {}, 1));
  double seconds = 0;
  std::vector<Keyframe> before;
  int moved = 0;
  for (const SE3& pose : loop(20, 1, 0.5)) {
    (void)drive.slam.update(drive.robot.step(seconds += 0.5, pose), kPlenty);
    const std::vector<Keyframe>& now = drive.slam.keyframes();
    for (std::size_t k = 0; k < before.size(); ++k) {
      const bool same = before[k].T_world_lidar.matrix() == now[k].T_world_lidar.matrix();
      EXPECT_TRUE(same || k + 10 >= now.size());
      moved += same ? 0 : 1;
    }
    before = now;
  }
  EXPECT_GT(before.size(), 30U);
  EXPECT_GT(moved, 30);
}

TEST(Slam, WhatWasMeasuredLongAgoStillCounts) {
  const SlamConfig whole = honest_config();
  SlamConfig held = whole;
  held.graph.movable_keyframes = 10;
  Drive a(whole, Robot(ring_of_objects(10, 5), {}, 1));
  Drive b(held, Robot(ring_of_objects(10, 5), {}, 1));
  a.along(loop(10, 1));
  b.along(loop(10, 1));
  const objects::ObjectMap map_a = a.slam.map(), map_b = b.slam.map();
  for (std::size_t i = 0; i < a.robot.world().size(); ++i) {
    const auto* in_a = Drive::nearest(map_a, a.truth(i));
    const auto* in_b = Drive::nearest(map_b, a.truth(i));
    ASSERT_TRUE(in_a != nullptr && in_b != nullptr);
    EXPECT_LT((objects::place(in_a->model) - objects::place(in_b->model)).norm(), 0.05);
  }
}

TEST(Slam, WrongConfigurationIsNamed) {
  SlamConfig config;
  config.keyframes.distance_m = -1;
  try {
    const Slam slam(config, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("slam.keyframes.distance_m"), std::string::npos);
  }
}

}  // namespace
}  // namespace saker::slam
