#include <gtest/gtest.h>

#include "made_world.h"
#include "saker/odometry/odometry.h"

/// Seconds without a scan and without an inertial unit.
namespace saker::odometry {
namespace {

constexpr Time kScanPeriod = 100'000'000;
constexpr int kBefore = 40, kLost = 30;  // scans

/// What is said of the scans after the gap, in another world where one is given.
std::vector<OdometryEstimate> after_a_gap(const testing::MadeWorld& before,
                                          const testing::MadeWorld& after, int count) {
  testing::MadeSensor sensor;
  sensor.range_noise_m = 0.02;
  sensor.max_range_m = 40;
  const testing::Motion motion = testing::straight(5);
  Odometry odometry{OdometryConfig{}};
  for (int k = 1; k <= kBefore; ++k)
    (void)odometry.register_scan(testing::scan(before, sensor, motion, k * kScanPeriod), {});
  std::vector<OdometryEstimate> said;
  for (int k = kBefore + kLost; k < kBefore + kLost + count; ++k)
    said.push_back(
        odometry.register_scan(testing::scan(after, sensor, motion, k * kScanPeriod), {}));
  return said;
}

/// Where the vehicle is after the gap: walls where the street has none.
testing::MadeWorld hall() {
  return {{{{5, 2.5, 0}, {35, 3.5, 6}},
           {{5, -5, 0}, {35, -4, 6}},
           {{31, -5, 0}, {32, 3, 6}},
           {{5, -5, 0}, {6, 3, 6}}}};
}

TEST(LostOdometry, InAFeaturelessCorridorItDoesNotSayWhereItIs) {
  for (const OdometryEstimate& said : after_a_gap(testing::corridor(), testing::corridor(), 4))
    EXPECT_NE(said.status, OdometryStatus::ok);
}

TEST(LostOdometry, APlaceThatItsMapLacksIsNotCalledOneOfIt) {
  const int restart_after = OdometryConfig{}.restart_after;
  for (const OdometryEstimate& said : after_a_gap(testing::street(), hall(), restart_after))
    EXPECT_NE(said.status, OdometryStatus::ok);
}

TEST(LostOdometry, ANewMapAtAGuessedPlaceIsOpenForASecond) {
  const int restart_after = OdometryConfig{}.restart_after;
  const auto said = after_a_gap(testing::street(), hall(), restart_after + 20);
  for (std::size_t k = 0; k < said.size(); ++k) {
    const int since = static_cast<int>(k) - restart_after;
    if (since < 0 || (since >= 8 && since < 13)) continue;
    EXPECT_EQ(said[k].status, since < 8 ? OdometryStatus::open : OdometryStatus::ok) << k;
  }
}

}  // namespace
}  // namespace saker::odometry
