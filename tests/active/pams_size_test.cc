/// Policy `saker` and the size that the map states: an end that nobody saw keeps a target open.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "made_pams_flight.h"

namespace saker::active {
namespace {

using namespace made;

/// A vehicle whose place and width the map knows well, and its length to `length_sd`.
struct KnownButForItsLength : Flight {
  explicit KnownButForItsLength(const PamsConfig& pams, const InGeofence& fence = everywhere,
                                bool discovered = false)
      : Flight(tour_for(pams, fence, discovered)) {}

  static TargetTour tour_for(const PamsConfig& pams, const InGeofence& fence, bool discovered) {
    const objects::ObjectMap map = map_of({car(20, 5)});
    TargetList targets({}, {}, discovered ? objects::ObjectMap() : map);
    if (discovered) targets.add(map.objects[0], true);
    return pams_tour(pams, std::move(targets), fence, oblique_model(0));
  }

  void know_length_to(double length_sd) {
    objects::ObjectMap map = map_of({car(20, 5)});
    Eigen::MatrixXd covariance = 1e-4 * Matrix9d::Identity();
    covariance(6, 6) = length_sd * length_sd;
    map.objects[0].covariance = covariance;
    input.map = std::make_shared<const objects::ObjectMap>(map);
  }
};

PamsConfig easily_enough() {
  PamsConfig config = PamsConfig::saker();
  config.enough_entropy = -8;  // a length of 0.5 m with the others at 0.01 m
  config.price_per_s = 0.01;
  return config;
}

TEST(PamsSize, ALengthThatIsNotKnownHidesInNoDeterminant) {
  const auto goals = [](double length_sd, double most_size_sd_m) {
    PamsConfig config = easily_enough();
    config.most_size_sd_m = most_size_sd_m;
    KnownButForItsLength flight(config);
    flight.know_length_to(length_sd);
    flight.fly(600);
    EXPECT_EQ(flight.target(0).status, TargetStatus::done);
    return flight.goals.size();
  };
  EXPECT_GT(goals(0.3, 0.1), goals(0.3, 10));
  EXPECT_EQ(goals(0.05, 0.1), goals(0.05, 10));
}

TEST(PamsSize, AClosedTargetWhoseViewsContradictEachOtherLaterIsLookedAtFurther) {
  KnownButForItsLength flight(easily_enough());
  flight.know_length_to(0.05);
  flight.fly(600);
  ASSERT_EQ(flight.target(0).status, TargetStatus::done);
  ASSERT_EQ(flight.target(0).reason.find("known well enough"), 0U) << flight.target(0).reason;
  flight.know_length_to(0.5);
  EXPECT_EQ(flight.decide().status, ActiveStatus::flying);
  EXPECT_EQ(flight.target(0).status, TargetStatus::pending);
  flight.know_length_to(0.05);
  EXPECT_LT(flight.fly(600), 600);
  EXPECT_EQ(flight.target(0).status, TargetStatus::done);
}

TEST(PamsSize, ATargetFoundKnownWellEnoughInItsTurnIsReconsideredAsWell) {
  PamsConfig config = easily_enough();
  config.enough_entropy = 0;  // the length alone decides
  KnownButForItsLength flight(config);
  flight.know_length_to(0.5);
  flight.fly(8);
  ASSERT_EQ(flight.target(0).status, TargetStatus::pending);
  flight.body.x() -= 100;  // out of view
  flight.know_length_to(0.05);
  flight.decide();
  ASSERT_EQ(flight.target(0).status, TargetStatus::done);
  ASSERT_NE(flight.target(0).reason.find("; known well enough"), std::string::npos);
  flight.know_length_to(0.5);
  EXPECT_EQ(flight.decide().status, ActiveStatus::flying);
}

TEST(PamsSize, AClosedTargetWhoseObjectLeavesTheMapIsLookedForAgain) {
  KnownButForItsLength flight(easily_enough());
  flight.know_length_to(0.05);
  flight.fly(600);
  ASSERT_EQ(flight.target(0).status, TargetStatus::done);
  flight.map({});
  EXPECT_EQ(flight.decide().status, ActiveStatus::flying);
  EXPECT_LT(flight.fly(600), 600);
  EXPECT_EQ(flight.target(0).status, TargetStatus::visited);
}

TEST(PamsSize, AMapThatNeverKnowsEndsTheFlightAllTheSame) {
  KnownButForItsLength flight(easily_enough());
  flight.know_length_to(2);
  EXPECT_LT(flight.fly(600), 600);
  EXPECT_EQ(flight.target(0).status, TargetStatus::done);
  EXPECT_NE(flight.target(0).reason.find("seen from"), std::string::npos);
}

TEST(PamsSize, WhereTheRegionsCentroidsCannotBeReachedTheLatticeShowsTheLength) {
  const auto goals = [](bool beyond_region, const InGeofence& fence) {
    PamsConfig config = easily_enough();
    config.beyond_region = beyond_region;
    KnownButForItsLength flight(config, fence);
    flight.know_length_to(0.5);
    flight.fly(600);
    return flight.goals;
  };
  const std::vector<Viewpoint> centroids = goals(false, everywhere);
  ASSERT_FALSE(centroids.empty());
  const auto elsewhere = [&](const Eigen::Vector3d& place) {
    return std::ranges::none_of(
        centroids, [&](const Viewpoint& at) { return (at.position - place).norm() < 0.1; });
  };
  EXPECT_TRUE(goals(false, elsewhere).empty());
  EXPECT_FALSE(goals(true, elsewhere).empty());
}

TEST(PamsSize, ADiscoveredTargetWithoutAPriorMapHasThePriceOfAll) {
  const auto goals = [](double price_per_s) {
    PamsConfig config = easily_enough();
    config.price_per_s = price_per_s;
    config.discovered_price_per_s = 10;  // nothing brings that much
    KnownButForItsLength flight(config, everywhere, true);
    flight.know_length_to(0.5);
    EXPECT_LT(flight.fly(600), 600);
    return flight.goals.size();
  };
  EXPECT_GT(goals(0.01), 0U);
  EXPECT_EQ(goals(10), 0U);
}

/// A vehicle on the prior map that is well known, and one beside it whose length is not.
struct BesideAPriorMap : Flight {
  explicit BesideAPriorMap(const PamsConfig& pams) : Flight(tour_for(pams)) {
    objects::ObjectMap map = map_of({car(40, -4), car(20, 5)});
    for (objects::MapObject& object : map.objects) object.covariance = 1e-4 * Matrix9d::Identity();
    map.objects[1].covariance(6, 6) = 0.25;
    input.map = std::make_shared<const objects::ObjectMap>(map);
  }

  static TargetTour tour_for(const PamsConfig& pams) {
    TargetList targets({}, {}, map_of({car(40, -4)}));
    targets.add(map_of({car(40, -4), car(20, 5)}).objects[1], true);
    return pams_tour(pams, std::move(targets), everywhere, oblique_model(0));
  }
};

TEST(PamsSize, ADiscoveredTargetBesideAPriorMapHasAPriceOfItsOwn) {
  const auto goals = [](double discovered_price_per_s) {
    PamsConfig config = easily_enough();
    config.discovered_price_per_s = discovered_price_per_s;
    BesideAPriorMap flight(config);
    EXPECT_LT(flight.fly(600), 600);
    return std::ranges::count(flight.goals, flight.target(1).id, &Viewpoint::target_id);
  };
  EXPECT_GT(goals(0.01), 0);
  EXPECT_EQ(goals(10), 0);
}

TEST(PamsSize, PolicyPaperAsksForTheDeterminantAlone) {
  PamsConfig config = PamsConfig::paper();
  config.enough_entropy = 10;
  KnownButForItsLength flight(config);
  flight.know_length_to(2);
  flight.fly(600);
  EXPECT_EQ(flight.target(0).reason.find("known well enough"), 0U) << flight.target(0).reason;
}

/// It is late: what was seen since then will be in it.
TEST(PamsSize, WhatTheMapDoesNotHoldYetCounts) {
  const auto goals = [](std::optional<Time> map_stamp) {
    PamsConfig config = easily_enough();
    config.most_size_sd_m = 0.1;
    KnownButForItsLength flight(config);
    flight.know_length_to(0.3);
    flight.input.map_stamp = map_stamp;
    flight.fly(600);
    return flight.goals.size();
  };
  EXPECT_LT(goals(Time{0}), goals(std::nullopt));
}

}  // namespace
}  // namespace saker::active
