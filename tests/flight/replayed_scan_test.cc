#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "flight/bus/scan_log.h"
#include "saker/autonomy/pipeline.h"
#include "saker/segmentation/segmentation.h"
#include "saker/simulation/vehicle/simulated_vehicle.h"

// What was flown, logged and replayed is seen as it was in flight.
namespace saker::flight {
namespace {

/// Before the take-off, as ingestion takes it.
autonomy::IngestedScan scan_of_a_mission() {
  simulation::MissionConfig config;
  config.capture.columns = 512;
  simulation::SimulatedVehicle vehicle(config, 1);
  autonomy::Ingestion ingestion({}, {}, vehicle.sensor(), lidar::mount_pose(config.mount));
  for (int i = 0; i < 1000; ++i) {
    vehicle.step_to(vehicle.now() + from_seconds(0.01));
    for (const auto& packet : vehicle.take_packets()) ingestion.add(packet.payload);
    auto frame = ingestion.take_newest();
    if (!frame) continue;
    autonomy::IngestedScan scan = ingestion.register_scan(std::move(*frame));
    if (scan.status == odometry::OdometryStatus::ok) return scan;
  }
  return {};
}

/// Through the messages into a log and back.
lidar::Scan replayed(const autonomy::RegisteredScan& scan) {
  const auto file = std::filesystem::path(testing::TempDir()) /
                    ("saker_replayed_scan_" + std::to_string(::getpid()) + ".lcm");
  {
    lcm::LogFile log(file.string(), "w");
    for (const scan_t& chunk : to_lcm(scan, 0)) {
      std::vector<char> bytes(static_cast<std::size_t>(chunk.getEncodedSize()));
      chunk.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
      lcm::LogEvent event{};
      event.channel = "R1_SCAN";
      event.datalen = static_cast<std::int32_t>(bytes.size());
      event.data = bytes.data();
      log.writeEvent(&event);
    }
  }
  const auto frame = ScanLog(file).next();
  std::filesystem::remove(file);
  return frame ? frame->scan : lidar::Scan{};
}

class ReplayedScan : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    flown_ = scan_of_a_mission();
    replayed_ = replayed(flown_.registered);
  }

  /// Pixels that answered: the replayed scan has just these, in this order.
  static std::vector<std::size_t> answered() {
    std::vector<std::size_t> pixels;
    for (std::size_t i = 0; i < flown_.scan->size(); ++i) {
      if (flown_.scan->points[i].allFinite()) pixels.push_back(i);
    }
    return pixels;
  }

  static inline autonomy::IngestedScan flown_;
  static inline lidar::Scan replayed_;
};

TEST_F(ReplayedScan, HasTheReturnsButNotTheBeamsThatNothingAnswered) {
  ASSERT_NE(flown_.scan, nullptr);
  const auto pixels = answered();
  ASSERT_GT(pixels.size(), 5000u);
  ASSERT_LT(pixels.size(), flown_.registered.points->size() - 1000);  // it saw sky
  ASSERT_EQ(replayed_.size(), pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    ASSERT_LT((replayed_.points[i] - (*flown_.registered.points)[pixels[i]]).norm(), 0.01);
  }
}

TEST_F(ReplayedScan, ReflectsAsInFlight) {
  const auto pixels = answered();
  ASSERT_EQ(replayed_.size(), pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    ASSERT_NEAR(replayed_.reflectivity[i], flown_.scan->reflectivity[pixels[i]], 0.5 / 255);
  }
}

TEST_F(ReplayedScan, IsLabelledAsInFlight) {
  segmentation::Segmentation segmentation({}, objects::ClassTable());
  const auto pixels = answered();
  ASSERT_EQ(replayed_.size(), pixels.size());
  const lidar::Labels in_flight = segmentation.segment(*flown_.scan);
  const lidar::Labels again = segmentation.segment(replayed_);
  double same = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    same += in_flight.classes[pixels[i]] == again.classes[i] ? 1 : 0;
  }
  EXPECT_GT(same / static_cast<double>(pixels.size()), 0.97);
}

}  // namespace
}  // namespace saker::flight
