#include "saker/slam/landmark.h"

#include <gtest/gtest.h>

#include <numbers>

#include "made_world.h"

namespace saker::slam {
namespace {

using namespace made;

const objects::ClassTable kTable;
const LandmarkConfig kConfig;
constexpr double kFootprint = 5;  // m
constexpr double kPi = std::numbers::pi;

/// Feeds measurements of one object, made in the world's frame, to one landmark.
class Feed {
 public:
  Landmark& operator()(const Model& model, objects::ClassId id, double front = 1) {
    measurement_.stamp += from_seconds(0.5);
    measurement_.class_id = id;
    measurement_.class_probability = probability(id);
    measurement_.model = model;
    measurement_.front_log_odds = front;
    const Eigen::Index size = is_cuboid(model) ? 9 : 6;
    measurement_.covariance = 0.01 * Eigen::MatrixXd::Identity(size, size);
    if (is_cuboid(model)) set_ends(measurement_.covariance);
    const Candidate candidate{
        &measurement_, {model, measurement_.covariance}, model, 10, id == 0 ? 0.2 : 0.95};
    if (landmark_.id < 0) {
      landmark_ = new_landmark(7, candidate, keyframe_++, kConfig);
    } else {
      observe(landmark_, candidate, keyframe_++, kConfig);
    }
    return landmark_;
  }

  /// Standard deviations from now on.
  void see_ends(double low, double high) { end_variances_ = {low * low, high * high}; }

 private:
  void set_ends(Eigen::MatrixXd& covariance) const {
    const double low = end_variances_[0], high = end_variances_[1];
    covariance(3, 3) = 0.25 * (low + high);
    covariance(3, 6) = covariance(6, 3) = 0.5 * (high - low);
    covariance(6, 6) = low + high;
  }

  objects::Measurement measurement_;
  Eigen::Vector2d end_variances_{0.01, 0.01};
  Landmark landmark_;
  int keyframe_ = 0;
};

double heading(const Landmark& landmark) {
  return core::yaw(turned(std::get<Cuboid>(landmark.model), naming_turn(landmark)).pose.linear());
}

TEST(Landmark, TrunkBecomesAPoleWhenMoreIsSeen) {
  Feed feed;
  feed(trunk(5, 0), kTrunk);
  EXPECT_EQ(kTable[class_of(feed(trunk(5, 0), kTrunk), kTable)].name, "trunk");
  for (int i = 0; i < 3; ++i) feed(trunk(5, 0), kPole);
  EXPECT_EQ(kTable[class_of(feed(trunk(5, 0), kPole), kTable)].name, "pole");
}

TEST(Landmark, ClassIsFusedByBayesRule) {
  Feed feed;
  feed(trunk(5, 0), kTrunk);
  const std::vector<double> p = class_probability(feed(trunk(5, 0), kPole));
  EXPECT_NEAR(p[kTrunk], p[kPole], 1e-12);  // the same evidence for both
  EXPECT_NEAR(p[kTrunk] / p[kVehicle], 0.8 / 0.05, 1e-9);
  EXPECT_NEAR(p[0] + p[1] + p[2] + p[3] + p[4], 1, 1e-12);
}

TEST(Landmark, MeasuredHeadingIsTurnedToTheNearest) {
  Feed feed;
  feed(car(5, 0, 0.1), kVehicle);
  const Landmark& landmark = feed(car(5, 0, 0.1 + kPi), kVehicle);
  for (const Observation& o : landmark.observations) {
    EXPECT_NEAR(core::yaw(std::get<Cuboid>(o.measured.model).pose.linear()), 0.1, 1e-9);
  }
}

TEST(Landmark, FrontGoesWithTheEvidenceNotWithTheFirst) {
  Feed feed;
  feed(car(5, 0, 0.1), kVehicle, 0.4);
  EXPECT_NEAR(heading(feed(car(5, 0, 0.1), kVehicle, 0.4)), 0.1, 1e-9);
  EXPECT_NEAR(heading(feed(car(5, 0, 0.1 - kPi), kVehicle, 3)), 0.1 - kPi, 1e-9);
}

TEST(Landmark, NearlySquareViewIsTurnedByAQuarterWithItsSize) {
  Feed feed;
  feed(car(5, 0, 0, 1.9, 1.7), kVehicle);  // the rear of a vehicle that heads for y
  const Landmark& landmark = feed(car(5, 0, kPi / 2, 4.4, 1.8), kVehicle);
  const auto& second = std::get<Cuboid>(landmark.observations[1].measured.model);
  EXPECT_NEAR(std::abs(core::yaw(second.pose.linear())), 0, 1e-9);
  EXPECT_NEAR(second.size.y(), 4.4, 1e-12);
}

TEST(Landmark, LongerEdgeIsNamedLengthAndKeepsItsFront) {
  Landmark landmark;
  landmark.model = car(0, 0, 0, 1.8, 4.4);
  for (const double sign : {1.0, -1.0}) {
    landmark.front = {5, 2 * sign};  // evidence across the length says nothing
    const Cuboid named = turned(std::get<Cuboid>(landmark.model), naming_turn(landmark));
    EXPECT_GT(named.size.x(), named.size.y());
    EXPECT_NEAR(core::yaw(named.pose.linear()), sign * kPi / 2, 1e-9);
  }
}

TEST(Landmark, IsBelievedAfterSeveralWindowsOverSomeTime) {
  Feed feed;
  for (int i = 1; i < kConfig.confirm_observations; ++i) {
    EXPECT_FALSE(believed(feed(car(5, 0, 0), kVehicle), kConfig)) << i;
  }
  EXPECT_TRUE(believed(feed(car(5, 0, 0), kVehicle), kConfig));
}

TEST(Landmark, IsNotBelievedWhenOftenLookedForInVainOrMoving) {
  Feed feed;
  for (int i = 0; i < 4; ++i) feed(car(5, 0, 0), kVehicle);
  Landmark landmark = feed(car(5, 0, 0), kVehicle);
  landmark.missed = 35;
  EXPECT_FALSE(believed(landmark, kConfig));
  landmark.missed = 0;
  landmark.seen_moving = 4;
  EXPECT_FALSE(believed(landmark, kConfig));
}

TEST(Landmark, SomethingElseOfItsShapeIsNotBelieved) {
  Feed feed;
  for (int i = 0; i < 4; ++i) feed(car(5, 0, 0), 0);
  EXPECT_FALSE(believed(feed(car(5, 0, 0), 0), kConfig));
}

TEST(Landmark, VehicleWhoseEndNobodyHasSeenIsNotBelievedUntilTwoWindowsHave) {
  Feed feed;
  feed.see_ends(0.1, 1);
  for (int i = 0; i < 9; ++i) feed(car(5, 0, 0), kVehicle);
  const Landmark half = feed(car(5, 0, 0), kVehicle);
  EXPECT_FALSE(believed(half, kConfig));
  EXPECT_TRUE(stands(half, kConfig));
  feed.see_ends(1, 0.1);
  EXPECT_FALSE(believed(feed(car(5, 0, 0), kVehicle), kConfig)) << "one window may be wrong";
  EXPECT_TRUE(believed(feed(car(5, 0, 0), kVehicle), kConfig));
}

TEST(Landmark, WindowFromTheOtherSideSeesTheSameEndWhicheverWayItNamesThem) {
  Feed feed;
  feed.see_ends(0.1, 1);
  for (int i = 0; i < 9; ++i) feed(car(5, 0, 0), kVehicle);
  feed.see_ends(1, 0.1);
  feed(car(5, 0, kPi), kVehicle);
  EXPECT_FALSE(believed(feed(car(5, 0, kPi), kVehicle), kConfig));
}

TEST(Landmark, WindowThatTookItsTailForASideMixesNoEnds) {
  Feed feed;
  feed.see_ends(0.1, 1);
  feed(car(5, 0, 0), kVehicle);
  Landmark& landmark = feed(car(4, 0, kPi / 2), kVehicle);
  landmark.model = landmark.observations.back().measured.model;  // as if it were the likeliest
  for (const double slip : {0.02, -0.02, 0.03, -0.03}) feed(car(5, 0, slip), kVehicle);
  landmark.model = landmark.observations.front().measured.model;
  EXPECT_TRUE(seen_ends(landmark).next.isApprox(Eigen::Vector2d(0.1, 1), 1e-9));
  EXPECT_FALSE(believed(landmark, kConfig));
}

TEST(Landmark, EarlyEvidenceOfAClassIsNotForgotten) {
  Feed feed;
  for (int i = 0; i < 20; ++i) feed(trunk(5, 0), kPole);
  for (int i = 0; i < 12; ++i) feed(trunk(5, 0), kTrunk);
  EXPECT_EQ(kTable[class_of(feed(trunk(5, 0), kTrunk), kTable)].name, "pole");
}

TEST(Landmark, MovesWhenItsFootprintsCoverMoreThanOneVehicle) {
  Feed feed;
  for (int i = 0; i < 5; ++i) feed(car(5 + 0.3 * i, 0, 0), kVehicle);
  EXPECT_FALSE(moves(feed(car(6.4, 0, 0), kVehicle), kFootprint, kConfig));
  EXPECT_TRUE(moves(feed(car(8, 0, 0), kVehicle), kFootprint, kConfig));
}

TEST(Landmark, ThatStoodForLongDoesNotMoveByOneFalseWindow) {
  Feed feed;
  for (int i = 0; i <= kConfig.still_windows; ++i) feed(car(5, 0, 0), kVehicle);
  EXPECT_FALSE(moves(feed(car(8, 0, 0), kVehicle), kFootprint, kConfig));
  EXPECT_TRUE(moves(feed(car(8.5, 0, 0), kVehicle), kFootprint, kConfig));
}

TEST(Landmark, OfTwoVehiclesComesBackWhatDrivesAwayDoesNot) {
  Feed two, one;
  two(car(5, 0, 0), kVehicle);
  two(car(8, 0, 0), kVehicle);
  EXPECT_TRUE(comes_back(two(car(5.2, 0, 0), kVehicle), kConfig));
  one(car(5, 0, 0), kVehicle);
  one(car(8, 0, 0), kVehicle);
  EXPECT_FALSE(comes_back(one(car(11, 0, 0), kVehicle), kConfig));
  EXPECT_FALSE(comes_back(one(car(11.2, 0, 0), kVehicle), kConfig));
}

TEST(Landmark, StandsWhenOnlyTheSeenPartWanders) {
  Feed feed;  // first the rear, then all, then the front of a vehicle from x = 5 to 9.4
  feed(car(5.6, 0, 0, 1.2), kVehicle);
  feed(car(7.2, 0, 0, 4.4), kVehicle);
  EXPECT_FALSE(moves(feed(car(8.8, 0, 0, 1.2), kVehicle), kFootprint, kConfig));
}

TEST(Landmark, MeasurementsFromOneKeyframeAreFused) {
  objects::Measurement m;
  m.class_probability = probability(kVehicle);
  m.model = car(5, 0, 0);
  m.covariance = 0.04 * Matrix9d::Identity();
  const Candidate a{&m, {car(5, 0, 0), Matrix9d(0.04 * Matrix9d::Identity())}, car(5, 0, 0), 5};
  const Candidate b{&m, {car(5.2, 0, 0), Matrix9d(0.04 * Matrix9d::Identity())}, car(5.2, 0, 0), 5};
  Landmark landmark = new_landmark(0, a, 3, kConfig);
  observe(landmark, b, 3, kConfig);
  ASSERT_EQ(landmark.observations.size(), 1U);
  const Gaussian& both = landmark.observations[0].measured;
  EXPECT_NEAR(objects::place(both.model).x(), 5.1, 1e-9);
  EXPECT_NEAR(both.covariance(3, 3), 0.02, 1e-9);
}

}  // namespace
}  // namespace saker::slam
