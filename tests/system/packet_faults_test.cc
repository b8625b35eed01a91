#include "tools/saker/faults/packet_faults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "saker/lidar/imu_packet.h"

namespace saker::tools {
namespace {

constexpr Time kStamp = 5'000'000'000;
constexpr std::uint32_t kRange_mm = 20'000;

Fault fault(FaultKind kind, double strength, FaultPlace place = FaultPlace::none) {
  Fault made;
  made.kind = kind;
  made.place = place;
  made.at_s = 10;
  made.lasts_s = 10;
  made.strength = strength;
  made.seed = 3;
  return made;
}

class Packets : public testing::Test {
 protected:
  /// All columns of a revolution, a packet each 16, as they come at `t_s` with the fault.
  std::vector<lidar::Column> columns_at(double t_s, const FaultSchedule& schedule) const {
    PacketFaults faults(schedule, info);
    const lidar::PacketFormat format(info);
    std::vector<lidar::Column> all;
    for (int first = 0; first < info.columns; first += info.columns_per_packet) {
      std::vector<lidar::Column> sent;
      for (int i = 0; i < info.columns_per_packet; ++i) {
        lidar::Column column;
        column.time = kStamp;
        column.measurement_id = first + i;
        column.pixels.assign(static_cast<std::size_t>(info.rows), {kRange_mm, 100, 10, 50});
        sent.push_back(std::move(column));
      }
      auto payload = format.encode(sent);
      faults.apply(t_s, payload);
      for (int i = 0; i < info.columns_per_packet; ++i) all.push_back(format.column(payload, i));
    }
    return all;
  }

  double share_of(const std::vector<lidar::Column>& columns,
                  const std::function<bool(const lidar::Pixel&)>& is) const {
    double n = 0, all = 0;
    for (const lidar::Column& column : columns) {
      n += static_cast<double>(std::ranges::count_if(column.pixels, is));
      all += static_cast<double>(column.pixels.size());
    }
    return n / all;
  }

  lidar::ImuSample imu_at(double t_s, const FaultSchedule& schedule) const {
    PacketFaults faults(schedule, info);
    lidar::ImuSample sample{kStamp, {0.1, 0.2, 9.8}, {0.01, 0.02, 0.03}};
    auto payload = lidar::encode_imu(sample, info);
    faults.apply(t_s, payload);
    const auto samples = lidar::decode_imu(payload, info);
    return samples.empty() ? lidar::ImuSample{} : samples.front();
  }

  lidar::SensorInfo info =
      lidar::SensorInfo::make_os1(32, 512, lidar::PacketProfile::kRng19Rfl8Sig16Nir16);
};

bool none(const lidar::Pixel& pixel) { return pixel.range_mm == 0; }

TEST_F(Packets, WithoutAFaultTheBytesStay) {
  const FaultSchedule schedule = {fault(FaultKind::rain, 0.3)};
  PacketFaults faults(schedule, info);
  std::vector<std::uint8_t> payload(lidar::PacketFormat(info).packet_bytes(), 0x5A);
  const auto before = payload;
  faults.apply(9, payload);
  EXPECT_EQ(payload, before);
}

TEST_F(Packets, DeadRowsAreDeadInAllColumns) {
  const auto columns = columns_at(15, {fault(FaultKind::rows_dead, 0.4)});
  std::vector<bool> dead;
  for (const lidar::Pixel& pixel : columns.front().pixels) dead.push_back(none(pixel));
  EXPECT_NEAR(static_cast<double>(std::ranges::count(dead, true)), 0.4 * info.rows, 6);
  for (const lidar::Column& column : columns) {
    for (std::size_t row = 0; row < dead.size(); ++row) {
      ASSERT_EQ(none(column.pixels[row]), dead[row]);
    }
  }
}

TEST_F(Packets, ACoveredViewIsOneStretchOfColumns) {
  const auto columns = columns_at(15, {fault(FaultKind::view_covered, 0.5)});
  EXPECT_NEAR(share_of(columns, none), 0.5, 0.01);
  int changes = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto& next = columns[(i + 1) % columns.size()];
    changes += none(columns[i].pixels[0]) != none(next.pixels[0]);
  }
  EXPECT_EQ(changes, 2);
}

TEST_F(Packets, RainReturnsBeforeWhatIsBehindIt) {
  const auto columns = columns_at(15, {fault(FaultKind::rain, 0.2)});
  EXPECT_NEAR(share_of(columns, [](const lidar::Pixel& p) { return p.range_mm < kRange_mm; }), 0.2,
              0.02);
}

TEST_F(Packets, AClockThatStepsTakesBothStreamsAlong) {
  const FaultSchedule schedule = {fault(FaultKind::clock_step, 0.05)};
  EXPECT_EQ(columns_at(15, schedule).front().time, kStamp + 50'000'000);
  EXPECT_EQ(imu_at(15, schedule).stamp, kStamp + 50'000'000);
  EXPECT_EQ(imu_at(25, schedule).stamp, kStamp);
}

TEST_F(Packets, AClockThatDriftsStaysOff) {
  const FaultSchedule schedule = {fault(FaultKind::clock_drift, -200)};
  EXPECT_EQ(imu_at(15, schedule).stamp, kStamp - 1'000'000);
  EXPECT_EQ(imu_at(30, schedule).stamp, kStamp - 2'000'000);
}

TEST_F(Packets, ABiasIsTheSameInEverySample) {
  const FaultSchedule schedule = {fault(FaultKind::imu_bias, 0.5)};
  const lidar::ImuSample clean = imu_at(5, schedule), one = imu_at(11, schedule),
                         other = imu_at(19, schedule);
  EXPECT_NEAR((one.acceleration - clean.acceleration).norm(), 0.5, 1e-3);
  EXPECT_LT((one.acceleration - other.acceleration).norm(), 1e-6);
  EXPECT_LT((one.angular_velocity - other.angular_velocity).norm(), 1e-6);
}

TEST_F(Packets, ASaturatedUnitReadsItsMost) {
  lidar::ImuSample sample = imu_at(15, {fault(FaultKind::imu_saturation, 5)});
  EXPECT_NEAR(sample.acceleration.z(), 5, 1e-3);
  EXPECT_NEAR(sample.acceleration.x(), 0.1, 1e-3);
}

TEST_F(Packets, AShakenUnitIsRightOnAverage) {
  const FaultSchedule schedule = {fault(FaultKind::imu_vibration, 2)};
  PacketFaults faults(schedule, info);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0;
  constexpr int kSamples = 2000;
  for (int i = 0; i < kSamples; ++i) {
    auto payload = lidar::encode_imu({kStamp, {0, 0, 9.8}, {0, 0, 0}}, info);
    faults.apply(15, payload);
    const auto read = lidar::decode_imu(payload, info).front();
    sum += read.acceleration;
    squares += std::pow(read.acceleration.x(), 2);
  }
  EXPECT_NEAR(sum.z() / kSamples, 9.8, 0.2);
  EXPECT_NEAR(std::sqrt(squares / kSamples), 2, 0.15);
}

TEST_F(Packets, GarbageIsNoPacketOfThisSensor) {
  const FaultSchedule schedule = {fault(FaultKind::garbage, 1, FaultPlace::lidar)};
  PacketFaults faults(schedule, info);
  std::vector<std::uint8_t> payload(lidar::PacketFormat(info).packet_bytes(), 0);
  faults.apply(15, payload);
  EXPECT_EQ(payload.size(), lidar::PacketFormat(info).packet_bytes());
  EXPECT_GT(std::ranges::count_if(payload, [](std::uint8_t byte) { return byte != 0; }), 1000);
}

std::vector<std::uint8_t> imu_packet(const lidar::SensorInfo& info) {
  return lidar::encode_imu({kStamp, {0.1, 0.2, 9.8}, {0.01, 0.02, 0.03}}, info);
}

TEST_F(Packets, NobodyElseSendsWithoutAFault) {
  const FaultSchedule schedule = {fault(FaultKind::flood, 50, FaultPlace::lidar)};
  PacketFaults faults(schedule, info);
  EXPECT_TRUE(faults.company(15, imu_packet(info)).empty());
  EXPECT_TRUE(faults.company(9, imu_packet(info)).empty());
}

TEST_F(Packets, AFloodIsCopiesOfEachPacket) {
  const FaultSchedule schedule = {fault(FaultKind::flood, 50, FaultPlace::imu)};
  PacketFaults faults(schedule, info);
  const auto payload = imu_packet(info);
  const auto others = faults.company(15, payload);
  EXPECT_EQ(others.size(), 50U);
  for (const auto& other : others) EXPECT_EQ(other, payload);
}

TEST_F(Packets, AForgedInertialSampleIsOfAnotherTime) {
  const FaultSchedule schedule = {fault(FaultKind::forge, 5, FaultPlace::imu)};
  PacketFaults faults(schedule, info);
  const auto others = faults.company(15, imu_packet(info));
  ASSERT_EQ(others.size(), 1U);
  EXPECT_EQ(lidar::decode_imu(others[0], info).front().stamp, kStamp + 5 * kNanosecondsPerSecond);
}

TEST_F(Packets, AForgedScanIsOfAnotherTimeAndFrame) {
  const FaultSchedule schedule = {fault(FaultKind::forge, -2, FaultPlace::lidar)};
  PacketFaults faults(schedule, info);
  const lidar::PacketFormat format(info);
  std::vector<lidar::Column> columns(static_cast<std::size_t>(info.columns_per_packet));
  for (lidar::Column& column : columns) {
    column.time = kStamp;
    column.frame_id = 7;
    column.pixels.assign(static_cast<std::size_t>(info.rows), {kRange_mm, 100, 10, 50});
  }
  const auto others = faults.company(15, format.encode(columns));
  ASSERT_EQ(others.size(), 1U);
  const lidar::Column forged = format.column(others[0], 0);
  EXPECT_EQ(forged.time, kStamp - 2 * kNanosecondsPerSecond);
  EXPECT_NE(forged.frame_id, 7);
  EXPECT_EQ(forged.pixels[0].range_mm, kRange_mm);
}

}  // namespace
}  // namespace saker::tools
