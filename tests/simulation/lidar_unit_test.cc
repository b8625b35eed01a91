#include "saker/simulation/sensor/lidar_unit.h"

#include <gtest/gtest.h>

#include "saker/lidar/ouster_stream.h"

namespace saker::simulation {
namespace {

constexpr Time kStart = 5 * kNanosecondsPerSecond;

/// A plain 2 m under the lidar with a wall 6 m ahead.
World room() {
  World world;
  const MaterialId ground = world.add({kRoad, 0.3F, 0, 0, 0, 0});
  const MaterialId wall = world.add({kBuilding, 0.5F, 0, 0, 0, 0});
  Pen pen(world.mesh);
  pen.quad({-60, -60, 0}, {60, -60, 0}, {60, 60, 0}, {-60, 60, 0}, ground);
  pen.box({6, -60, 0}, {7, 60, 30}, wall);
  return world;
}

MissionConfig exact() {
  MissionConfig config;
  config.capture.rows = 32;
  config.capture.columns = 512;
  config.receiver.noise_m = config.receiver.noise_per_m = config.receiver.beam_bias_m = 0;
  config.receiver.divergence_mrad = config.receiver.mixed_share = config.receiver.drop_share = 0;
  config.receiver.sensitivity = 1e-12;
  return config;
}

struct Turned {
  std::vector<SensorDatagram> datagrams;
  std::vector<Time> stamps;
};

Turned turn(const MissionConfig& config, int revolutions, const LidarUnit::PoseAt& pose_at) {
  const World world = room();
  const RayCaster caster(world);
  LidarUnit unit(config, caster, world, kStart, 1);
  DatagramQueue queue;
  Turned result;
  while (unit.revolutions() < revolutions) {
    if (unit.turn(pose_at, queue)) result.stamps.push_back(unit.scan_stamp());
  }
  result.datagrams = queue.take_until(kStart + 3600 * kNanosecondsPerSecond);
  return result;
}

const LidarUnit::PoseAt kStill = [](Time) { return placed(0, 0, 2); };

TEST(LidarUnit, APacketArrivesByTheLatencyAfterItsLastColumn) {
  MissionConfig config = exact();
  config.latency_s = 0.004;
  const Turned turned = turn(config, 1, kStill);
  ASSERT_EQ(turned.datagrams.size(), 32U);
  const Time period = from_seconds(0.1 / 512);
  for (std::size_t i = 0; i < turned.datagrams.size(); ++i) {
    const Time measured = kStart + from_seconds((16 * static_cast<double>(i) + 15) * 0.1 / 512);
    EXPECT_NEAR(static_cast<double>(turned.datagrams[i].received - measured), 4e6, 1000);
  }
  EXPECT_NEAR(static_cast<double>(turned.stamps[0] - kStart), 511.0 * static_cast<double>(period),
              1e5);
}

/// It flies ahead at 4 m/s: the wall, seen at the middle of the revolution, is where it was then.
TEST(LidarUnit, ColumnsAreCastFromWhereTheLidarIsAtTheirTimes) {
  const auto ahead = [](Time t) { return placed(4 * to_seconds(t - kStart), 0, 2); };
  const Turned turned = turn(exact(), 2, ahead);
  lidar::OusterStream stream(LidarUnit(exact(), RayCaster(room()), room(), kStart, 1).info());
  for (const SensorDatagram& datagram : turned.datagrams) stream.add(datagram.payload);
  stream.finish();
  const auto item = stream.take();
  ASSERT_TRUE(item.has_value());
  const lidar::Scan& scan = item->frame.scan;
  int on_wall = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3f& p = scan.points[i];
    if (!p.allFinite() || p.x() < 3 || std::abs(p.y()) > 5 || p.z() < -1.5F) continue;
    const double moved = 4 * to_seconds(scan.time_of(i) - kStart);
    EXPECT_NEAR(p.x(), 6 - moved, 0.005);
    ++on_wall;
  }
  EXPECT_GT(on_wall, 500);
}

TEST(LidarUnit, LostRepeatedAndLatePacketsAreAsManyAsConfigured) {
  MissionConfig config = exact();
  config.capture.lost_share = 0.2;
  const auto size = [&] { return static_cast<double>(turn(config, 20, kStill).datagrams.size()); };
  EXPECT_NEAR(size(), 0.8 * 640, 40);
  config.capture.lost_share = 0;
  config.capture.repeated_share = 0.2;
  EXPECT_NEAR(size(), 1.2 * 640, 40);
  config.capture.repeated_share = 0;
  config.capture.late_share = 0.2;
  const Turned late = turn(config, 20, kStill);
  lidar::PacketFormat format(LidarUnit(config, RayCaster(room()), room(), kStart, 1).info());
  int overtaken = 0;
  Time last = 0;
  for (const SensorDatagram& datagram : late.datagrams) {
    const Time time = format.time(datagram.payload, 0);
    overtaken += time < last;
    last = time;
  }
  EXPECT_GT(overtaken, 60);
}

TEST(LidarUnit, AWindowLeavesTheOtherPacketsOut) {
  MissionConfig config = exact();
  config.capture.window_first = 128;
  config.capture.window_last = 255;
  const Turned turned = turn(config, 1, kStill);
  EXPECT_EQ(turned.datagrams.size(), 8U);
  EXPECT_NEAR(to_seconds(turned.stamps[0] - kStart), 255 * 0.1 / 512, 1e-6);
}

TEST(DatagramQueue, KeepsTheOrderOfArrivalAndDropsTheOldestBeyondItsCeiling) {
  DatagramQueue queue;
  for (int i = 0; i < static_cast<int>(DatagramQueue::kMost) + 10; ++i)
    queue.add({i % 2 == 0 ? i : i - 2, 7502, {}});
  EXPECT_EQ(queue.dropped(), 10);
  const auto taken = queue.take_until(1000000);
  EXPECT_EQ(taken.size(), DatagramQueue::kMost);
  EXPECT_TRUE(std::is_sorted(taken.begin(), taken.end(),
                             [](const auto& a, const auto& b) { return a.received < b.received; }));
  EXPECT_TRUE(queue.take_until(1000000).empty());
}

}  // namespace
}  // namespace saker::simulation
