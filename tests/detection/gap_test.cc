#include "saker/detection/gap.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace saker::detection {
namespace {

/// A sensor at the origin, 1.2 m up, and an outline 9 m ahead of it whose length lies across, all
/// of it turned about the sensor.
struct World {
  double turn = 0;
  double length = 4.4;
  double depth = 1.8;  ///< of the outline, away from the sensor
  std::vector<Eigen::Vector3d> ends = {};

  [[nodiscard]] Plan outline() const {
    return {turn + M_PI / 2, 0.01, {{{-length / 2, length / 2}, {-9 - depth, -9}}}};
  }

  [[nodiscard]] bool parted(const GapConfig& config = {}) const {
    const Eigen::AngleAxisd R(turn, Eigen::Vector3d::UnitZ());
    Window window;
    window.sensors = {{0, 0, 1.2}};
    for (const Eigen::Vector3d& end : ends) {
      window.beams.push_back({Eigen::Vector3d(R * end).cast<float>(), 0});
    }
    Beams beams;
    beams.fill(window);
    const Surroundings surroundings({});
    const Sight sight{window.sensors, beams, surroundings, SE3::Identity()};
    return detection::parted(outline(), sight, config);
  }
};

/// So many beams to a distance and height, side by side.
std::vector<Eigen::Vector3d> fan(int count, double distance, double height, double aside = 0) {
  std::vector<Eigen::Vector3d> ends;
  for (int i = 0; i < count; ++i) {
    ends.emplace_back(distance, aside + 0.1 * (i - 0.5 * (count - 1)), height);
  }
  return ends;
}

const int kBeams = GapConfig().beams;

TEST(Gap, EnoughBeamsThroughTheMiddleShowMoreThanOneVehicle) {
  for (const double turn : {0.0, 0.8, 2.6, -1.9}) {
    EXPECT_TRUE((World{.turn = turn, .ends = fan(kBeams, 20, 0)}.parted())) << turn;
    EXPECT_FALSE((World{.turn = turn, .ends = fan(kBeams - 1, 20, 0)}.parted())) << turn;
  }
}

TEST(Gap, BeamsThroughWindowsOrBelowTheBodyShowNothing) {
  EXPECT_FALSE((World{.ends = fan(50, 20, 0.9)}.parted()));
  EXPECT_FALSE((World{.ends = fan(50, 12, 0)}.parted())) << "at 10 m 0.2 m above the ground";
}

TEST(Gap, BeamsThatEndInItShowNothing) { EXPECT_FALSE((World{.ends = fan(50, 10, 0.6)}.parted())); }

TEST(Gap, BeamsPastItsCornersShowNothing) {
  EXPECT_FALSE((World{.ends = fan(50, 20, 0, 7)}.parted()));
}

TEST(Gap, NoBeamsShowNothing) { EXPECT_FALSE(World{}.parted()); }

/// Of two vehicles side by side that show their ends alone: the outline has no inside.
World two_ends() { return {.depth = 0.5, .ends = fan(kBeams, 20, 0)}; }

TEST(Gap, BeamsBehindASideOnWhichNothingWasMetShowMoreThanOne) {
  EXPECT_TRUE(two_ends().parted());
  World fewer = two_ends();
  fewer.ends.pop_back();
  EXPECT_FALSE(fewer.parted());
}

TEST(Gap, WhereSomethingWasMetOnTheSideItIsOne) {
  World one = two_ends();
  one.ends.emplace_back(9, 0, 0.6);
  EXPECT_FALSE(one.parted());
}

TEST(Gap, ASideThatIsShorterThanTwoWidthsIsOneVehicles) {
  World one = two_ends();
  one.length = 3.4;
  EXPECT_FALSE(one.parted());
}

TEST(Gap, BeamsBesideTheMiddleOfASideShowNothing) {
  World one = two_ends();
  one.ends = fan(kBeams, 20, 0, 3);  // 1.4 m off the middle: at a wheel arch
  EXPECT_FALSE(one.parted());
}

}  // namespace
}  // namespace saker::detection
