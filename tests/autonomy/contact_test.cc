#include "saker/autonomy/contact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saker/core/rng.h"

namespace saker::autonomy {
namespace {

constexpr Time kSample = kNanosecondsPerSecond / 100;

/// An inertial unit at 100 Hz on a vehicle that shakes.
class ContactTest : public testing::Test {
 protected:
  bool add(const Eigen::Vector3d& force) {
    lidar::ImuSample sample;
    sample.stamp = now += kSample;
    sample.acceleration = force;
    return contact.add(sample);
  }
  /// \return bumps
  int fly(double seconds, double shake_mps2, double manoeuvre_mps2 = 0) {
    int bumps = 0;
    for (int i = 0; i < seconds * 100; ++i) {
      const double push = manoeuvre_mps2 * std::sin(i * 0.02);
      const double x = rng.normal(0, shake_mps2), y = rng.normal(0, shake_mps2);
      bumps += add({push + x, y, 9.81 + rng.normal(0, shake_mps2)});
    }
    return bumps;
  }
  bool bump(double mps2) { return add({mps2, 0, 9.81}); }

  Contact contact{ContactConfig{}};
  core::Rng rng{3};
  Time now = 50 * kNanosecondsPerSecond;
};

TEST_F(ContactTest, FlightWithoutOneFeelsNone) {
  EXPECT_EQ(fly(60, 0.3, 4), 0);
  EXPECT_EQ(contact.last(), 0);
}

TEST_F(ContactTest, ABumpIsFeltAtItsStamp) {
  fly(20, 0.3, 2);
  EXPECT_TRUE(bump(-30));
  EXPECT_EQ(contact.last(), now);
  EXPECT_NEAR(contact.last_mps2(), 30, 4);
}

TEST_F(ContactTest, ASoftTouchIsNot) {
  fly(20, 0.3);
  EXPECT_FALSE(bump(10));
}

TEST_F(ContactTest, AVehicleThatShakesHardIsFeltLater) {
  EXPECT_EQ(fly(60, 4), 0);
  EXPECT_FALSE(bump(-30));
  EXPECT_TRUE(bump(-90));
}

TEST_F(ContactTest, AfterAGapTheMeanBeginsAnew) {
  fly(10, 0.3);
  now += kNanosecondsPerSecond;
  EXPECT_FALSE(add({0, 40, 9.81}));
}

TEST_F(ContactTest, WhatIsNotFiniteOrOldIsLeftOut) {
  fly(10, 0.3);
  EXPECT_FALSE(bump(NAN));
  EXPECT_FALSE(bump(INFINITY));
  now -= 4 * kSample;
  EXPECT_FALSE(bump(90));
  EXPECT_EQ(fly(5, 0.3), 0);
}

}  // namespace
}  // namespace saker::autonomy
