#pragma once

#include <gtest/gtest.h>

#include "made_sensor.h"
#include "saker/lidar/imu_packet.h"
#include "saker/lidar/sensor_gate.h"

/// A sensor that sends, and the gate that hears it.
namespace saker::lidar {

inline constexpr Time kMillisecond = 1'000'000;
inline constexpr Time kLatency = 2 * kMillisecond;
inline constexpr Time kSwitchedOn = 3600 * kNanosecondsPerSecond;  // by the receiver's clock
inline constexpr Time kImuPeriod = 10 * kMillisecond;
inline constexpr std::uint32_t kAddress = 0xC0A80702;  // 192.168.7.2

inline SensorInfo described(PacketProfile profile = PacketProfile::kRng15Rfl8Nir8) {
  SensorInfo info = SensorInfo::make_os1(16, 512, profile);
  info.serial_number = "122000000001";
  info.initialization_id = 7;
  return info;
}

/// A sensor on the network: what it sends, and when that arrives.
struct LiveSensor {
  explicit LiveSensor(const SensorInfo& of) : info(of), format(of) {}

  [[nodiscard]] Time stamp_at(Time arrival) const { return arrival - kLatency - began + clock; }
  [[nodiscard]] testing::Bytes lidar(Time arrival) const {
    const Time newest = arrival - kLatency - began;
    const auto end = static_cast<int>(newest / period());  // columns that were measured
    return lidar_of(first_frame + (end - 1) / info.columns, (end - 1) % info.columns / 16 * 16,
                    stamp_at(arrival));
  }
  /// The packet that begins with the column.
  [[nodiscard]] testing::Bytes lidar_of(int frame, int column, Time last_stamp) const {
    std::vector<Column> columns;
    for (int i = 0; i < 16; ++i) {
      Column one = testing::made_column(info, frame, frame & 0xFFFF, column + i);
      one.time = last_stamp - (15 - i) * period();
      columns.push_back(std::move(one));
    }
    return format.encode(columns);
  }
  [[nodiscard]] testing::Bytes imu(Time arrival) const { return imu_of(stamp_at(arrival)); }
  [[nodiscard]] testing::Bytes imu_of(Time stamp) const {
    ImuSample sample;
    sample.stamp = stamp;
    sample.acceleration = {0, 0, 9.8};
    sample.angular_velocity = {0, 0, 0};
    return encode_imu(sample, info);
  }
  [[nodiscard]] Time period() const { return from_seconds(info.column_period_s()); }

  SensorInfo info;
  PacketFormat format;
  Time began = kSwitchedOn - 100 * kNanosecondsPerSecond;
  Time clock = 0;  // how far it was set
  int first_frame = 1;
  UdpSource lidar_from{kAddress, 40001}, imu_from{kAddress, 40002};
};

class Gate : public ::testing::Test {
 protected:
  GateCause lidar(const LiveSensor& from, const testing::Bytes& bytes) {
    return judge(bytes, from.lidar_from);
  }
  GateCause imu(const LiveSensor& from, const testing::Bytes& bytes) {
    return judge(bytes, from.imu_from);
  }
  GateCause judge(const testing::Bytes& bytes, const UdpSource& from) {
    const GateVerdict verdict = gate.judge(bytes, from, now);
    correction = verdict.correction;
    return verdict.cause;
  }
  /// Sends for so long; how many did not pass.
  long run(const LiveSensor& from, double seconds) {
    const long refused_before = refused();
    for (const Time end = now + from_seconds(seconds); now < end;) {
      now += 16 * from.period();
      (void)lidar(from, from.lidar(now));
      if (now / kImuPeriod == imu_ticks) continue;
      imu_ticks = now / kImuPeriod;
      (void)imu(from, from.imu(now));
    }
    return refused() - refused_before;
  }
  [[nodiscard]] long refused() const {
    long sum = 0;
    for (const long count : gate.figures().refused) sum += count;
    return sum;
  }
  void be_silent(double seconds) { now += from_seconds(seconds); }
  [[nodiscard]] int agreements() const { return gate.figures().agreements; }

  Time now = kSwitchedOn;
  Time correction = 0;
  Time imu_ticks = 0;
  LiveSensor sensor{described()};
  SensorGate gate{described()};
};

}  // namespace saker::lidar
