#include "saker/slam/association.h"

#include <gtest/gtest.h>

#include <cmath>

#include "made_world.h"
#include "saker/slam/duplicates.h"

namespace saker::slam {
namespace {

using namespace made;

const objects::ClassTable kTable;

Landmark landmark_at(int id, const Model& model, objects::ClassId class_id, int keyframe = 0) {
  objects::Measurement m;
  m.class_id = class_id;
  m.class_probability = probability(class_id);
  const Eigen::Index size = is_cuboid(model) ? 9 : 6;
  m.model = model;
  m.covariance = 0.01 * Eigen::MatrixXd::Identity(size, size);
  const Candidate candidate{
      &m, {model, 0.01 * Eigen::MatrixXd::Identity(size, size)}, model, 10, 0.8};
  return new_landmark(id, candidate, keyframe, {});
}

struct Scene {
  std::vector<objects::Measurement> measurements;
  std::vector<Landmark> landmarks;

  [[nodiscard]] std::vector<int> associated() const {
    std::vector<Candidate> candidates;
    for (const auto& m : measurements) candidates.push_back({&m, {m.model, {}}, m.model, 10});
    return associate(candidates, landmarks, kTable, {});
  }
  /// A window that measured these, each number to `sd`, and nothing else.
  void window(const std::vector<Cuboid>& cars, double sd = 0.3) {
    measurements.clear();
    for (const Cuboid& one : cars) measure(one, kVehicle);
    const Eigen::MatrixXd covariance = sd * sd * Eigen::MatrixXd::Identity(9, 9);
    std::vector<Candidate> candidates;
    for (const auto& m : measurements) {
      candidates.push_back({&m, {m.model, covariance}, m.model, 10});
    }
    count_on_ground(landmarks, candidates, {});
  }
  void measure(const Model& model, objects::ClassId id) {
    measurements.emplace_back().model = model;
    measurements.back().class_id = id;
  }
};

TEST(Association, NearestPairsFirstOneToOne) {
  Scene scene;
  scene.landmarks = {landmark_at(0, car(0, 0, 0), kVehicle),
                     landmark_at(1, car(0, 2.5, 0), kVehicle)};
  scene.measure(car(0, 1.2, 0), kVehicle);  // between both, nearer to the first
  scene.measure(car(0, 0.1, 0), kVehicle);
  scene.measure(car(20, 0, 0), kVehicle);
  EXPECT_EQ(scene.associated(), (std::vector<int>{1, 0, -1}));
}

TEST(Association, ShapesDoNotMixButTrunksAndPolesDo) {
  Scene scene;
  scene.landmarks = {landmark_at(0, car(0, 0, 0), kVehicle), landmark_at(1, trunk(9, 0), kTrunk)};
  scene.measure(trunk(0, 0), kTrunk);
  scene.measure(trunk(9.2, 0), kPole);
  scene.measure(trunk(9.7, 0), kPole);  // within the gate of a trunk, not of another class
  EXPECT_EQ(scene.associated(), (std::vector<int>{-1, 1, -1}));
}

TEST(Association, PartOfAVehicleBelongsToTheVehicleItLiesOn) {
  const AssociationConfig config;
  EXPECT_TRUE(std::isfinite(association_distance(car(1.9, 0, 0, 0.6), car(0, 0, 0), true, config)));
  EXPECT_FALSE(std::isfinite(association_distance(car(0, 2.2, 0), car(0, 0, 0), true, config)));
  Cuboid above = car(0, 0, 0);
  above.pose.translation().z() += 3;  // a storey up
  EXPECT_FALSE(std::isfinite(association_distance(above, car(0, 0, 0), true, config)));
}

TEST(Duplicates, OverlappingVehiclesAreOneAndKeepTheOlderId) {
  std::vector<Landmark> landmarks = {landmark_at(4, car(0, 0, 0), kVehicle, 0),
                                     landmark_at(6, car(30, 0, 0), kVehicle, 0),
                                     landmark_at(9, car(1, 0.2, 3.1), kVehicle, 1)};
  landmarks[2].seen = 5;  // the younger one is known better
  EXPECT_EQ(merge_duplicates(landmarks, {}, {}), 1);
  ASSERT_EQ(landmarks.size(), 2U);
  EXPECT_EQ(landmarks[0].id, 4);
  EXPECT_EQ(landmarks[0].observations.size(), 2U);
  EXPECT_EQ(landmarks[0].seen, 6);
  EXPECT_NEAR(objects::place(landmarks[0].model).x(), 1, 1e-9);
  const auto& turned_one = std::get<Cuboid>(landmarks[0].observations[0].measured.model);
  EXPECT_NEAR(std::abs(core::yaw(turned_one.pose.linear())), std::numbers::pi,
              0.1);  // named as the kept one
}

TEST(Duplicates, VehiclesThatCrossEachOtherAreOne) {
  std::vector<Landmark> landmarks = {landmark_at(0, car(0, 0, 0), kVehicle),
                                     landmark_at(1, car(0.6, 1.25, 0.6), kVehicle)};
  EXPECT_EQ(merge_duplicates(landmarks, {}, {}), 1);
}

TEST(Duplicates, BoxAboutPartsTellsNothingOfAVehicleWhoseEndsWereSeen) {
  std::vector<Landmark> landmarks = {landmark_at(0, car(0, 0.8, 0), kVehicle, 0),
                                     landmark_at(1, car(0, 0, 0), kVehicle, 1)};
  landmarks[0].seen = 100;
  Landmark& whole = landmarks[1];
  whole.seen = 10;
  whole.last_stamp += from_seconds(5);
  whole.log_odds = 20;
  whole.ends[0].next.setConstant(0.1);
  EXPECT_EQ(merge_duplicates(landmarks, {}, {}), 1);
  ASSERT_EQ(landmarks.size(), 1U);
  EXPECT_EQ(landmarks[0].id, 0);
  EXPECT_EQ(landmarks[0].seen, 10);
  EXPECT_EQ(landmarks[0].observations.size(), 1U);
  EXPECT_NEAR(objects::place(landmarks[0].model).y(), 0, 1e-9);
}

TEST(Duplicates, ABoxAcrossTwoNeighboursIsTwoOnceBothWereSeenInAShareOfItsWindows) {
  const Cuboid across = car(0, 0, std::numbers::pi / 2);
  const Cuboid left = car(0.8, 1.3, 0), right = car(0.8, -1.3, 0);
  Scene scene;
  scene.landmarks = {landmark_at(0, across, kVehicle)};
  for (int i = 0; i < 12; ++i) scene.window({across});
  for (int i = 0; i < 2; ++i) scene.window({left, right});
  EXPECT_FALSE(lies_across_two(scene.landmarks[0], {}));
  scene.window({right, left});
  EXPECT_TRUE(lies_across_two(scene.landmarks[0], {}));
  scene.window({across});
  EXPECT_FALSE(lies_across_two(scene.landmarks[0], {}));
}

TEST(Duplicates, AVehicleIsOneHoweverItsNeighbourIsMeasured) {
  Scene scene;
  scene.landmarks = {landmark_at(0, car(0, 0, 0), kVehicle)};
  const Cuboid neighbour = car(0, 2.5, 0), across = car(0, 1.2, std::numbers::pi / 2);
  for (int i = 0; i < 5; ++i) scene.window({car(0.2, 0.1, 0), neighbour});
  for (int i = 0; i < 5; ++i) scene.window({car(0.2, 0.1, 0), across});
  scene.window({across});
  EXPECT_EQ(scene.landmarks[0].seen_as_one, 11);
  EXPECT_EQ(scene.landmarks[0].seen_as_two, 0);
}

TEST(Duplicates, PiecesWhosePlaceNobodySawAreNoTwoVehicles) {
  Scene scene;
  scene.landmarks = {landmark_at(0, car(0, 0, 0), kVehicle)};
  const Cuboid front = car(1.6, 0, std::numbers::pi / 2),
               back = car(-1.5, -0.6, std::numbers::pi / 2);
  for (int i = 0; i < 5; ++i) scene.window({front, back}, 2);
  EXPECT_FALSE(lies_across_two(scene.landmarks[0], {}));
  for (int i = 0; i < 5; ++i) scene.window({front, back}, 0.5);
  EXPECT_TRUE(lies_across_two(scene.landmarks[0], {}));
}

TEST(Duplicates, AVehicleInPiecesIsOne) {
  Scene scene;
  scene.landmarks = {landmark_at(0, car(0, 0, 0), kVehicle)};
  Cuboid front = car(1.5, 0, 0), back = car(-1.2, 0, 0);
  front.size.x() = back.size.x() = 1.2;
  for (int i = 0; i < 5; ++i) scene.window({front, back});
  EXPECT_FALSE(lies_across_two(scene.landmarks[0], {}));
}

TEST(Duplicates, EndsThatEitherSawAreKnownHoweverEachNamesThem) {
  Landmark landmark = landmark_at(0, car(0, 0, 0), kVehicle);
  Cuboid named_across = car(0, 0, std::numbers::pi / 2);
  std::swap(named_across.size.x(), named_across.size.y());
  Landmark other = landmark_at(1, named_across, kVehicle, 1);
  landmark.ends[0].best = landmark.ends[0].next = {1, 0.1};
  other.ends[1].best = other.ends[1].next = {1, 0.1};  // its y axis points to the other's −x
  absorb(landmark, other);
  EXPECT_EQ(landmark.ends[0].best, Eigen::Vector2d(0.1, 0.1));
}

TEST(Duplicates, NeighboursAndOtherShapesStay) {
  std::vector<Landmark> landmarks = {
      landmark_at(0, car(0, 0, 0), kVehicle), landmark_at(1, car(0, 2.4, 0), kVehicle),
      landmark_at(2, trunk(0, 0.5), kTrunk), landmark_at(3, trunk(0, 1.2), kPole)};
  EXPECT_EQ(merge_duplicates(landmarks, {}, {}), 0);
  EXPECT_EQ(landmarks.size(), 4U);
}

TEST(Duplicates, APoleInsideATrunkIsOneObjectAndItsClassIsFused) {
  Cylinder bush = trunk(5.5, 0);
  bush.radius = 0.5;
  std::vector<Landmark> landmarks = {landmark_at(0, trunk(5, 0), kPole),
                                     landmark_at(1, bush, kTrunk)};
  for (int i = 0; i < 3; ++i) {
    Landmark again = landmark_at(2, trunk(5, 0), kPole);
    absorb(landmarks[0], again);
  }
  EXPECT_EQ(merge_duplicates(landmarks, {}, {}), 1);
  ASSERT_EQ(landmarks.size(), 1U);
  EXPECT_EQ(class_of(landmarks[0], {}), kPole);  // four windows against one
  EXPECT_NEAR(std::get<Cylinder>(landmarks[0].model).radius, 0.15, 1e-9);
}

TEST(Duplicates, TwoThinPolesBesideEachOtherStayTwo) {
  std::vector<Landmark> landmarks = {landmark_at(0, trunk(5, 0), kPole),
                                     landmark_at(1, trunk(5.6, 0), kPole)};
  EXPECT_EQ(merge_duplicates(landmarks, {}, {}), 0);
}

}  // namespace
}  // namespace saker::slam
