#include "saker/slam/landmark_evidence.h"

#include <gtest/gtest.h>

namespace saker::slam {
namespace {

TEST(LandmarkEvidence, EachWindowThatMissesTakesTheSame) {
  const LandmarkConfig config;
  Landmark landmark;
  landmark.log_odds = 3;
  EXPECT_DOUBLE_EQ(log_odds(landmark, config), 3);
  landmark.missed = 4;
  EXPECT_DOUBLE_EQ(log_odds(landmark, config), 3 - 4 * config.missed_log_odds);
}

TEST(LandmarkEvidence, WhatMovedInHalfOfItsWindowsIsStillAnObject) {
  Landmark landmark;
  landmark.seen = 6;
  landmark.seen_moving = 3;
  EXPECT_FALSE(is_mobile(landmark));
  landmark.seen_moving = 4;
  EXPECT_TRUE(is_mobile(landmark));
}

TEST(LandmarkEvidence, WhatMovesNowIsMobileHoweverLongItStood) {
  Landmark landmark;
  landmark.seen = 100;
  landmark.moving = true;
  EXPECT_TRUE(is_mobile(landmark));
}

TEST(LandmarkEvidence, WhatIsMobileDoesNotStand) {
  const LandmarkConfig config;
  Landmark landmark;
  landmark.seen = 100;
  landmark.log_odds = 100;
  landmark.last_stamp = from_seconds(config.confirm_span_s + 1);
  EXPECT_TRUE(stands(landmark, config));
  landmark.seen_moving = 51;
  EXPECT_FALSE(stands(landmark, config));
}

}  // namespace
}  // namespace saker::slam
