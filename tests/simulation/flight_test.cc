#include "saker/simulation/mission/flight.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <sstream>

#include "saker/core/files.h"
#include "saker/lidar/recording.h"
#include "saker/objects/map_io.h"

namespace saker::simulation {
namespace {

FlightConfig short_flight() {
  FlightConfig config;
  config.duration_s = 0.5;
  config.capture.columns = 512;
  config.labels = true;
  return config;
}

std::filesystem::path flown(const std::string& name, std::uint64_t seed) {
  const auto folder = std::filesystem::path(testing::TempDir()) / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  write_flight(short_flight(), seed, folder, nullptr);
  return folder;
}

TEST(Flight, WritesACaptureOfScansAndInertialSamples) {
  const auto folder = flown("flight_a", 1);
  const auto source = lidar::open_recording(folder / "flight.pcap");
  int scans = 0;
  std::size_t samples = 0;
  while (const auto frame = source->next()) {
    EXPECT_EQ(frame->fault, "");
    EXPECT_EQ(frame->scan.columns, 512);
    ++scans;
    samples += frame->imu.size();
  }
  EXPECT_EQ(scans, 5);
  EXPECT_NEAR(static_cast<double>(samples), 50, 2);
}

TEST(Flight, TruthHoldsTheObjectsAboutTheFirstScanWithTheirReturns) {
  const auto folder = flown("flight_b", 2);
  const objects::ClassTable table;
  const objects::ObjectMap map = objects::read_map(folder / "truth.json", table);
  int hit = 0;
  for (const objects::MapObject& object : map.objects) {
    EXPECT_GE(object.points, 0);
    hit += object.points > 50;
    EXPECT_LT(objects::place(object.model).z(),
              2);  // the sensor flies above what stands on the ground
  }
  EXPECT_GT(hit, 5);
  const std::string rows = core::read_file(folder / "trajectory_truth.txt");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 5);
}

/// The vehicle hovers: scans are not distorted. Mirrors stand out by 0.15 m.
TEST(Flight, ReturnsOfAVehicleLieInItsTrueCuboid) {
  const auto folder = flown("flight_e", 4);
  const objects::ObjectMap map = objects::read_map(folder / "truth.json", {});
  std::istringstream row(core::read_file(folder / "trajectory_truth.txt"));
  double t = 0;
  Eigen::Vector3d p;
  Eigen::Quaterniond q;
  row >> t >> p.x() >> p.y() >> p.z() >> q.x() >> q.y() >> q.z() >> q.w();
  const SE3 T_world_lidar = Eigen::Translation3d(p) * q;
  const std::string points = core::read_file(folder / "velodyne/000000.bin");
  const std::string labels = core::read_file(folder / "labels/000000.label");
  int inside = 0, all = 0;
  for (std::size_t i = 0; i < labels.size() / 4; ++i) {
    std::uint32_t label = 0;
    std::array<float, 4> xyzr;
    std::memcpy(&label, &labels[4 * i], 4);
    std::memcpy(xyzr.data(), &points[16 * i], 16);
    if ((label & 0xFFFF) != kCar || (label >> 16) == 0) continue;
    const auto& cuboid = std::get<objects::Cuboid>(map.objects.at((label >> 16) - 1).model);
    const Eigen::Vector3d at =
        cuboid.pose.inverse() * T_world_lidar * Eigen::Vector3d(xyzr[0], xyzr[1], xyzr[2]);
    const Eigen::Vector3d margin(0.12, 0.24, 0.12);
    inside += ((at.cwiseAbs() - margin).array() < cuboid.size.array() / 2).all();
    ++all;
  }
  ASSERT_GT(all, 300);
  EXPECT_GT(inside, 0.97 * all);
}

TEST(Flight, TwoRunsAreByteIdentical) {
  const auto a = flown("flight_c", 3);
  const auto b = flown("flight_d", 3);
  for (const char* name : {"flight.pcap", "flight.json", "truth.json", "trajectory_truth.txt"}) {
    EXPECT_EQ(core::read_file(a / name), core::read_file(b / name)) << name;
  }
}

}  // namespace
}  // namespace saker::simulation
