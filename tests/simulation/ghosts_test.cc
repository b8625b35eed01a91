#include "saker/simulation/sensor/ghosts.h"

#include <gtest/gtest.h>

#include "drawn.h"
#include "saker/simulation/sensor/scan_points.h"

namespace saker::simulation {
namespace {

/// A wall ahead at x = −8 and a mirror behind it at x = 6; the sensor is between them.
class GhostsTest : public testing::Test {
 protected:
  explicit GhostsTest(float gloss = 1) {
    const MaterialId wall = world_.add({kBuilding, 0.9F, 0, 0, 0, 0});
    mirror_ = world_.add({kCar, 0.05F, 0, gloss, 0, 0});
    Pen pen(world_.mesh);
    pen.quad({-8, -20, -20}, {-8, 20, -20}, {-8, 20, 20}, {-8, -20, 20}, wall);
    pen.quad({6, -3, -3}, {6, 3, -3}, {6, 3, 3}, {6, -3, 3}, mirror_);
    core::Rng rng(2);
    unit_ = make_unit(SensorChoice::vlp_16, rng);
    unit_.receiver.sensitivity = 1e-12;
  }

  /// A scan in which every beam was lost, with ghosts.
  CastScan ghosts(double share) {
    const RayCaster caster(world_);
    const Scanner scanner(caster, world_, unit_.beams, unit_.receiver, 3);
    CastScan scan = scanner.empty_scan();
    const ScanSetting setting{&caster, &world_, &unit_, &mount_,
                              [](int) { return SE3::Identity(); }};
    core::Rng rng(8);
    add_ghosts(share, setting, rng, scan);
    return scan;
  }

  static std::vector<std::size_t> returns(const CastScan& scan) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < scan.range_m.size(); ++i) {
      if (scan.range_m[i] > 0) found.push_back(i);
    }
    return found;
  }

  World world_;
  MaterialId mirror_ = 0;
  SensorUnit unit_;
  Mount mount_;
};

/// The wall's mirror image lies as far behind the mirror as the wall stands before it.
TEST_F(GhostsTest, LieWhereTheMirrorImageOfTheWallIs) {
  const CastScan scan = ghosts(1);
  const std::vector<std::size_t> found = returns(scan);
  ASSERT_GT(found.size(), 500U);
  for (const std::size_t i : found) EXPECT_NEAR(scan.points[i].x(), 6 + 14, 0.02);
}

TEST_F(GhostsTest, AreOutliersOfNoObject) {
  const CastScan scan = ghosts(1);
  for (const std::size_t i : returns(scan)) {
    EXPECT_EQ(scan.labels[i], kOutlier);
    EXPECT_EQ(scan.objects[i], 0);
  }
}

TEST_F(GhostsTest, SeemHalfAsBrightAsWhatIsMirrored) {
  const CastScan scan = ghosts(1);
  for (const std::size_t i : returns(scan)) EXPECT_NEAR(scan.reflectivity[i], 0.45, 1e-5);
}

TEST_F(GhostsTest, OnlyBeamsThatMeetTheMirrorHaveOne) {
  const CastScan scan = ghosts(1);
  for (const std::size_t i : returns(scan)) {
    const Eigen::Vector3f& beam = unit_.beams.directions[i];
    ASSERT_GT(beam.x(), 0);
    const Eigen::Vector3f at = 6 / beam.x() * beam;
    EXPECT_LT(std::abs(at.y()), 3.01F);
    EXPECT_LT(std::abs(at.z()), 3.01F);
  }
}

TEST_F(GhostsTest, AreTheShareThatWasAskedFor) {
  const double all = static_cast<double>(returns(ghosts(1)).size());
  const double third = static_cast<double>(returns(ghosts(0.33)).size());
  EXPECT_NEAR(third / all, 0.33, 0.06);
}

TEST_F(GhostsTest, BeamsThatCameBackHaveNone) {
  const RayCaster caster(world_);
  const Scanner scanner(caster, world_, unit_.beams, unit_.receiver, 3);
  CastScan scan = scanner.empty_scan();
  for (float& range : scan.range_m) range = 3;
  const std::vector<float> before = scan.range_m;
  core::Rng rng(8);
  add_ghosts(1, {&caster, &world_, &unit_, &mount_, [](int) { return SE3::Identity(); }}, rng,
             scan);
  EXPECT_EQ(scan.range_m, before);
}

TEST_F(GhostsTest, NoneIsFartherThanTheReceiverListens) {
  unit_.receiver.max_range_m = 15;
  EXPECT_TRUE(returns(ghosts(1)).empty());
}

/// The same with a mirror that is too dull.
class DullMirrorTest : public GhostsTest {
 protected:
  DullMirrorTest() : GhostsTest(0.25F) {}
};

TEST_F(DullMirrorTest, HasNoGhosts) { EXPECT_TRUE(returns(ghosts(1)).empty()); }

}  // namespace
}  // namespace saker::simulation
