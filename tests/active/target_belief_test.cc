#include "saker/active/belief/target_belief.h"

#include <gtest/gtest.h>

#include <cmath>

#include "made_model.h"
#include "made_street.h"

namespace saker::active {
namespace {

using namespace made;

/// A car at the origin, seen for three seconds each from as many places of a circle.
struct Seen {
  explicit Seen(int places, double map_sd = 0) {
    target.class_id = kVehicle;
    target.extent = car(0, 0);
    target.object_id = 4;
    if (map_sd > 0) target.covariance = map_sd * map_sd * Eigen::Matrix4d::Identity();
    for (int i = 0; i < places; ++i) {
      history.add(i, {8 * std::cos(i + 0.2), 8 * std::sin(i + 0.2), 3}, {0, 0, 0}, 3, 0);
    }
    history.map_holds(places);
  }
  [[nodiscard]] TargetBelief belief(const PamsConfig& config) const {
    return {target, history, model, config};
  }

  Target target;
  MappedViewHistory history{ViewHistory(24, 1.5)};
  ViewModel model = oblique_model();
};

const PamsConfig kPaper = PamsConfig::paper(), kSaker = PamsConfig::saker();

TEST(TargetBelief, OfThePaperIsByTheViewsWhateverTheMapHas) {
  const Seen seen(4, 5);
  EXPECT_EQ(seen.belief(kPaper).belief().entropy(),
            seen.belief(kPaper).by_views().belief().entropy());
}

TEST(TargetBelief, OfSakerIsByTheLessCertainOfBoth) {
  const Seen unsure(4, 1), sure(4, 0.01);
  EXPECT_EQ(unsure.belief(kSaker).belief().entropy(),
            unsure.belief(kSaker).in_map(unsure.history.so_far()).entropy());
  EXPECT_EQ(sure.belief(kSaker).belief().entropy(),
            sure.belief(kSaker).by_views().belief().entropy());
}

TEST(TargetBelief, WhatTheMapDoesNotHoldYetCountsAsIfItDid) {
  Seen seen(2, 0.5);
  const double before = seen.belief(kSaker).belief().entropy();
  seen.history.add(10, {0, 9, 3}, {0, 0, 0}, 3, 0);
  EXPECT_LT(seen.belief(kSaker).belief().entropy(), before - 0.1);
}

TEST(TargetBelief, SizeIsKnownByTheMapOrWhereThatSaysNothingByViews) {
  PamsConfig config = kSaker;
  config.most_size_sd_m = 0.2;
  config.common_counts = false;
  EXPECT_TRUE(Seen(0, 0.19).belief(config).size_is_known(1));
  EXPECT_FALSE(Seen(0, 0.21).belief(config).size_is_known(1));
  EXPECT_TRUE(Seen(0, 0.21).belief(config).size_is_known(1.3));
  EXPECT_FALSE(Seen(0).belief(config).size_is_known(1));
  EXPECT_TRUE(Seen(8).belief(config).size_is_known(1));
}

TEST(TargetBelief, IsEnoughWithEntropySizeAndClass) {
  PamsConfig config = kSaker;
  config.enough_entropy = -8;
  config.most_size_sd_m = 0.2;
  objects::ObjectMap map;
  map.objects = {vehicle(4, car(0, 0))};
  map.objects[0].class_probability = {0.02, 0.9, 0.08};
  const Seen seen(8);
  EXPECT_TRUE(seen.belief(config).is_enough(&map));
  EXPECT_TRUE(seen.belief(config).is_enough(nullptr)) << "nothing speaks against the class";
  map.objects[0].class_probability = {0.3, 0.6, 0.1};
  EXPECT_FALSE(seen.belief(config).is_enough(&map)) << "class";
  map.objects.clear();
  config.most_size_sd_m = 0.01;
  EXPECT_FALSE(seen.belief(config).is_enough(&map)) << "size";
  config.most_size_sd_m = 0.2;
  config.enough_entropy = -40;
  EXPECT_FALSE(seen.belief(config).is_enough(&map)) << "entropy";
}

}  // namespace
}  // namespace saker::active
