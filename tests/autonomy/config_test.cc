#include "saker/autonomy/config.h"

#include <gtest/gtest.h>

namespace saker::autonomy {
namespace {

TEST(ActiveAsFlown, SeesWhatTheSensorsBeamsSee) {
  lidar::SensorInfo sensor = lidar::SensorInfo::make_os1(64, 512, lidar::PacketProfile::kLegacy);
  const Config config;
  EXPECT_EQ(active_as_flown(config, sensor).view.lowest_deg, -22.5);
  EXPECT_EQ(active_as_flown(config, sensor).view.highest_deg, 22.5);
  for (double& altitude : sensor.beam_altitude_deg) altitude /= 2;  // an OS2's
  EXPECT_EQ(active_as_flown(config, sensor).view.lowest_deg, -11.25);
  EXPECT_EQ(active_as_flown(config, sensor).view.highest_deg, 11.25);
}

TEST(ActiveAsFlown, KnowsOfSizesWhatTheClassTableDoes) {
  Config config;
  config.objects.classes[config.objects.first_target()].length_sd_m = 0.2;
  const active::ActiveConfig active = active_as_flown(config, {});
  EXPECT_EQ(active.saker.prior_length_m, 0.2);
  EXPECT_EQ(active.paper.prior_length_m, active::PamsConfig::paper().prior_length_m);
}

TEST(WithinGeofence, HeightsAreBelowItsUpperEnd) {
  Config config;
  EXPECT_EQ(within_geofence(config).mission.height_m, config.mission.height_m);
  config.motion.geofence.highest_m = 2;
  EXPECT_DOUBLE_EQ(within_geofence(config).mission.height_m, 1.6);
  EXPECT_DOUBLE_EQ(within_geofence(config).active.viewpoints.height_m, 1.6);
}

}  // namespace
}  // namespace saker::autonomy
