/// One world seen from the same places by ten sensors: what they are called must not depend on who
/// looks.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include "saker/lidar/kitti_folder.h"
#include "saker/segmentation/segmentation.h"
#include "saker/simulation/mission/training.h"

namespace saker::segmentation {
namespace {

namespace fs = std::filesystem;
using simulation::SensorChoice;

constexpr std::uint64_t kSeed = 20261;
constexpr float kSame = 0.15F;  // m: returns in one cube of this edge are of one surface
constexpr int kWorlds = 3, kScans = 2;

using Cube = std::array<int, 4>;  ///< number of the scan, and where
using Called = std::map<Cube, std::uint8_t>;

Cube cube_of(int scan, const Eigen::Vector3f& p) {
  const Eigen::Vector3i at = (p / kSame).array().floor().cast<int>();
  return {scan, at.x(), at.y(), at.z()};
}

/// What the sensor's points are called, by cube; the last point of a cube speaks for it.
Called seen_by(SensorChoice sensor, Segmentation& segmentation) {
  const fs::path folder =
      fs::path(::testing::TempDir()) / ("saker_sensor_" + std::to_string(static_cast<int>(sensor)));
  simulation::write_training_scans({.world = simulation::WorldKind::street,
                                    .worlds = kWorlds,
                                    .scans_per_world = kScans,
                                    .sensor = sensor},
                                   kSeed, folder, nullptr);
  Called called;
  lidar::KittiFolder scans(folder);
  int number = 0;
  for (auto frame = scans.next(); frame; frame = scans.next(), ++number) {
    const lidar::Labels labels = segmentation.segment(frame->scan);
    for (std::size_t i = 0; i < frame->scan.size(); ++i) {
      if (frame->scan.points[i].norm() < 40)
        called[cube_of(number, frame->scan.points[i])] = labels.classes[i];
    }
  }
  fs::remove_all(folder);
  return called;
}

/// The aim is 0.95; weights that were trained on two of these sensors reach 0.915 in the mean.
TEST(Segmentation, CallsThingsTheSameWhicheverOfTenSensorsLooks) {
  using enum SensorChoice;
  Segmentation segmentation({}, objects::ClassTable{});
  const Called reference = seen_by(os1_64, segmentation);
  double mean = 0;
  const std::vector<SensorChoice> others = {hdl_64e,  hdl_32e, vlp_32c, vls_128,     pandar64,
                                            pandar40, xt32,    os0_64,  vlp_32c_pair};
  for (const SensorChoice sensor : others) {
    double both = 0, same = 0;
    for (const auto& [cube, id] : seen_by(sensor, segmentation)) {
      const auto found = reference.find(cube);
      if (found == reference.end()) continue;
      both += 1;
      same += found->second == id;
    }
    ASSERT_GT(both, 1000);
    EXPECT_GT(same / both, 0.87) << "sensor " << static_cast<int>(sensor);
    mean += same / both / static_cast<double>(others.size());
    RecordProperty("agreement_" + std::to_string(static_cast<int>(sensor)),
                   std::to_string(same / both));
  }
  EXPECT_GT(mean, 0.9);
}

}  // namespace
}  // namespace saker::segmentation
