#include "simulation/flight.h"

#include <gtest/gtest.h>

#include "core/files.h"
#include "lidar/recording.h"
#include "objects/map_io.h"

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

TEST(Flight, TwoRunsAreByteIdentical) {
  const auto a = flown("flight_c", 3);
  const auto b = flown("flight_d", 3);
  for (const char* name : {"flight.pcap", "flight.json", "truth.json", "trajectory_truth.txt"}) {
    EXPECT_EQ(core::read_file(a / name), core::read_file(b / name)) << name;
  }
}

}  // namespace
}  // namespace saker::simulation
