#include "saker/lidar/sensor_gate.h"

#include <gtest/gtest.h>

#include <limits>

#include "made_sensor.h"
#include "saker/core/rng.h"
#include "saker/lidar/imu_packet.h"

namespace saker::lidar {
namespace {

constexpr Time kMillisecond = 1'000'000;
constexpr Time kLatency = 2 * kMillisecond;
constexpr Time kSwitchedOn = 3600 * kNanosecondsPerSecond;  // by the receiver's clock
constexpr Time kImuPeriod = 10 * kMillisecond;
constexpr std::uint32_t kAddress = 0xC0A80702;  // 192.168.7.2

SensorInfo described(PacketProfile profile = PacketProfile::kRng15Rfl8Nir8) {
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

testing::Bytes other_serial(const SensorInfo& of, const LiveSensor& as, Time now) {
  LiveSensor other(of);
  other.info.serial_number = "122000000002";
  other.format = PacketFormat(other.info);
  other.began = as.began;
  return other.lidar(now);
}

TEST_F(Gate, BelievesASensorOnceBothItsStreamsAgree) {
  EXPECT_EQ(lidar(sensor, sensor.lidar(now)), GateCause::not_agreed);
  (void)run(sensor, 0.2);
  EXPECT_EQ(agreements(), 1);
  EXPECT_EQ(run(sensor, 1), 0);
  EXPECT_EQ(correction, 0);
  EXPECT_EQ(gate.identity().address, kAddress);
  EXPECT_EQ(gate.identity().lidar_port, 40001);
  EXPECT_EQ(gate.identity().imu_port, 40002);
  EXPECT_EQ(gate.identity().sender.initialization_id, 7U);
}

TEST_F(Gate, AHealthySensorLosesNothingWhateverItsFrameNumber) {
  sensor.first_frame = 65536 - 1005;  // the 16 bits run over
  (void)run(sensor, 0.2);
  EXPECT_EQ(run(sensor, 60), 0);
}

TEST_F(Gate, LossDelayAndOvertakingOnTheNetworkAreNoFault) {
  (void)run(sensor, 0.2);
  core::Rng rng(5);
  const long before = refused();
  std::vector<testing::Bytes> late;
  for (int i = 0; i < 2000; ++i) {
    now += 16 * sensor.period();
    if (rng.chance(0.2)) continue;       // lost
    if (i % 5 > 1 && rng.chance(0.3)) {  // overtaken by some
      late.push_back(sensor.lidar(now));
      continue;
    }
    EXPECT_EQ(lidar(sensor, sensor.lidar(now)), GateCause::none);
    if (late.empty() || i % 5 != 0) continue;
    EXPECT_EQ(lidar(sensor, late.back()), GateCause::none) << i;
    late.clear();
  }
  EXPECT_EQ(refused(), before);
}

TEST_F(Gate, AFarStampOfAnInertialSampleIsRefused) {
  (void)run(sensor, 1);
  for (const Time stamp : {std::numeric_limits<Time>::max(), std::numeric_limits<Time>::min(),
                           Time{-1}, kStampEnd, kStampEnd - 1, Time{0}}) {
    EXPECT_NE(imu(sensor, sensor.imu_of(stamp)), GateCause::none) << stamp;
  }
  EXPECT_EQ(run(sensor, 1), 0);  // and shuts out nothing
}

TEST_F(Gate, AStampAheadOfItsArrivalIsRefusedInBothStreams) {
  (void)run(sensor, 1);
  for (const double seconds : {0.03, 0.5, 5.0, 9.9}) {
    const Time ahead = from_seconds(seconds);
    EXPECT_EQ(imu(sensor, sensor.imu_of(sensor.stamp_at(now) + ahead)), GateCause::ahead);
    EXPECT_EQ(lidar(sensor, sensor.lidar(now + ahead)), GateCause::ahead);
  }
  EXPECT_EQ(run(sensor, 1), 0);
}

// Each 19 ms ahead of the ones before: they would carry the line along.
TEST_F(Gate, StampsALittleAheadDoNotCarryTimeAlong) {
  (void)run(sensor, 1);
  for (int second = 0; second < 20; ++second) {
    for (int i = 0; i < 50; ++i) {
      (void)run(sensor, 0.02);
      (void)imu(sensor, sensor.imu_of(sensor.stamp_at(now) + from_seconds(0.019 * (1 + second))));
    }
  }
  EXPECT_EQ(imu(sensor, sensor.imu_of(sensor.stamp_at(now) + 45 * kMillisecond)), GateCause::ahead);
}

TEST_F(Gate, InertialSamplesDoNotGoBack) {
  (void)run(sensor, 1);
  const Time stamp = sensor.stamp_at(now += kImuPeriod);
  EXPECT_EQ(imu(sensor, sensor.imu_of(stamp)), GateCause::none);
  EXPECT_EQ(imu(sensor, sensor.imu_of(stamp)), GateCause::back);
  EXPECT_EQ(imu(sensor, sensor.imu_of(stamp - 5 * kMillisecond)), GateCause::back);
  EXPECT_EQ(imu(sensor, sensor.imu_of(stamp - 2 * kNanosecondsPerSecond)), GateCause::late);
}

TEST_F(Gate, AForgedFrameNumberClosesNoScan) {
  (void)run(sensor, 1);
  for (const int frames : {1, 2, 17, 500, 30000, -1, -3}) {
    LiveSensor forged = sensor;
    forged.first_frame += frames;
    EXPECT_EQ(lidar(sensor, forged.lidar(now)), GateCause::frame) << frames;
  }
  EXPECT_EQ(run(sensor, 1), 0);
}

TEST_F(Gate, ColumnsThatAreNotInARowAreRefused) {
  (void)run(sensor, 1);
  testing::Bytes swapped = sensor.lidar(now);
  const std::size_t column_bytes = (swapped.size() - 2 * kPacketHeadBytes) / 16;
  const auto column = [&](std::size_t i) {
    return swapped.begin() + static_cast<std::ptrdiff_t>(kPacketHeadBytes + i * column_bytes);
  };
  std::swap_ranges(column(3), column(4), column(9));
  EXPECT_EQ(lidar(sensor, swapped), GateCause::columns);
  testing::Bytes beyond = sensor.lidar(now);
  beyond[kPacketHeadBytes + 9] = 0xFF;  // of the first column's number
  EXPECT_EQ(lidar(sensor, beyond), GateCause::columns);
}

TEST_F(Gate, AReplayedPacketIsOutOfOrder) {
  (void)run(sensor, 1);
  const testing::Bytes old = sensor.lidar(now);
  (void)run(sensor, 0.05);
  EXPECT_EQ(lidar(sensor, old), GateCause::out_of_order);
}

TEST_F(Gate, ASecondSensorOfTheSameTypeIsRefused) {
  (void)run(sensor, 1);
  LiveSensor second = sensor;
  second.lidar_from.address = second.imu_from.address = kAddress + 1;
  EXPECT_EQ(lidar(second, other_serial(sensor.info, sensor, now)), GateCause::serial_number);
  EXPECT_EQ(lidar(second, sensor.lidar(now)), GateCause::address);
  EXPECT_EQ(imu(second, sensor.imu(now)), GateCause::address);
  second = sensor;
  second.lidar_from.port = 40003;
  EXPECT_EQ(lidar(second, sensor.lidar(now)), GateCause::port);
  EXPECT_EQ(run(sensor, 1), 0);
}

TEST_F(Gate, TheConfiguredAddressIsHeardAlone) {
  gate = SensorGate(described(), {kAddress, {}});
  LiveSensor other = sensor;
  other.lidar_from.address = other.imu_from.address = kAddress + 1;
  (void)run(other, 2);
  EXPECT_EQ(agreements(), 0);
  EXPECT_EQ(gate.source(SensorStream::lidar, now), (UdpSource{kAddress, 0}));
  (void)run(sensor, 0.2);
  EXPECT_EQ(agreements(), 1);
  EXPECT_EQ(gate.source(SensorStream::lidar, now), sensor.lidar_from);
  EXPECT_EQ(gate.source(SensorStream::imu, now), sensor.imu_from);
}

TEST_F(Gate, EverybodyIsHeardAgainWhenTheSensorIsSilent) {
  (void)run(sensor, 1);
  EXPECT_EQ(gate.source(SensorStream::lidar, now), sensor.lidar_from);
  be_silent(0.5);
  EXPECT_EQ(gate.source(SensorStream::lidar, now), UdpSource{});
}

/// Restarted: columns, frames and stamps from 0, sent from other ports.
LiveSensor restarted(const LiveSensor& sensor, Time now) {
  LiveSensor again = sensor;
  again.info.initialization_id = 8;
  again.format = PacketFormat(again.info);
  again.began = now - kLatency - 30 * kMillisecond;
  again.lidar_from.port = 50001;
  again.imu_from.port = 50002;
  return again;
}

TEST_F(Gate, ASensorThatRestartedIsTakenUpAndItsTimeGoesOn) {
  (void)run(sensor, 1);
  be_silent(20);
  const LiveSensor again = restarted(sensor, now);
  const long refused = run(again, 0.5);
  EXPECT_EQ(agreements(), 2);
  EXPECT_LT(refused, 40);
  now += kImuPeriod;
  EXPECT_EQ(imu(again, again.imu(now)), GateCause::none);
  EXPECT_NEAR(to_seconds(again.stamp_at(now) + correction), to_seconds(sensor.stamp_at(now)), 1e-3);
  EXPECT_NE(gate.figures().last_agreement.find("restarted"), std::string::npos);
}

TEST_F(Gate, NobodyIsTakenForTheSensorWhileItSends) {
  (void)run(sensor, 1);
  LiveSensor again = restarted(sensor, now);
  again.began -= 40 * kNanosecondsPerSecond;
  LiveSensor copy = sensor;  // in everything, but its clock
  copy.clock = from_seconds(3);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(run(sensor, 0.004), 0);
    (void)lidar(again, again.lidar(now));
    (void)imu(again, again.imu(now));
    (void)lidar(copy, copy.lidar(now));
    (void)imu(copy, copy.imu(now));
  }
  EXPECT_EQ(agreements(), 1);
}

TEST_F(Gate, ARestartBelowASecondOfSilenceWaitsForIt) {
  (void)run(sensor, 1);
  be_silent(0.3);
  const LiveSensor again = restarted(sensor, now);
  (void)run(again, 0.5);
  EXPECT_EQ(agreements(), 1);
  (void)run(again, 0.5);
  EXPECT_EQ(agreements(), 2);
}

TEST_F(Gate, AClockThatStepsIsTakenUpWithinAQuarterOfASecond) {
  for (const double step_s : {0.1, -0.1, 0.04, 900.0, -60.0, 3e8}) {
    SCOPED_TRACE(step_s);
    gate = SensorGate(described());
    sensor.clock = 0;
    (void)run(sensor, 1);
    const Time unstepped = sensor.clock;
    sensor.clock += from_seconds(step_s);
    (void)run(sensor, 0.25);
    EXPECT_EQ(agreements(), 2);
    EXPECT_EQ(run(sensor, 1), 0);
    EXPECT_EQ(lidar(sensor, sensor.lidar(now + 8 * kMillisecond)), GateCause::none);
    EXPECT_NEAR(to_seconds(sensor.clock + correction), to_seconds(unstepped), 1e-3);
  }
}

// Packets that were 90 ms on their way for long, and are not any more: nobody set a clock.
TEST_F(Gate, ANetworkThatGotFasterIsNoStep) {
  sensor.began += 90 * kMillisecond;
  (void)run(sensor, 12);
  sensor.began -= 90 * kMillisecond;
  (void)run(sensor, 0.3);
  EXPECT_EQ(agreements(), 2);
  EXPECT_EQ(run(sensor, 1), 0);
  EXPECT_EQ(correction, 0);
}

TEST_F(Gate, AnotherAddressIsTakenUpOnlyWithTheSameSerialNumber) {
  (void)run(sensor, 1);
  be_silent(3);
  sensor.lidar_from.address = sensor.imu_from.address = kAddress + 9;
  (void)run(sensor, 0.3);
  EXPECT_EQ(agreements(), 2);

  const SensorInfo old = described(PacketProfile::kLegacy);  // says no serial number
  gate = SensorGate(old);
  LiveSensor legacy(old);
  (void)run(legacy, 1);
  be_silent(3);
  legacy.lidar_from.address = legacy.imu_from.address = kAddress + 1;
  (void)run(legacy, 2);
  EXPECT_EQ(agreements(), 1);
  EXPECT_GT(gate.figures().refused[static_cast<std::size_t>(GateCause::address)], 100);
}

TEST_F(Gate, StrangersDoNotKeepTheSensorFromBeingFound) {
  core::Rng rng(3);
  for (int i = 0; i < 300 && agreements() == 0; ++i) {
    (void)run(sensor, 0.0031);
    for (int other = 0; other < 100; ++other) {
      LiveSensor stranger = sensor;
      stranger.lidar_from = {static_cast<std::uint32_t>(rng.index(1 << 20)), 1};
      stranger.clock = from_seconds(rng.uniform(0, 1e6));
      (void)lidar(stranger, stranger.lidar(now));
    }
  }
  EXPECT_EQ(agreements(), 1);
  EXPECT_EQ(gate.identity().address, kAddress);
}

TEST_F(Gate, MoreThanTwiceWhatASensorSendsIsTooMany) {
  (void)run(sensor, 1);
  const auto at = static_cast<std::size_t>(GateCause::too_many);
  Time stamp = sensor.stamp_at(now);
  for (int i = 0; i < 20'000; ++i) {
    now += 50'000;  // 20 kHz, each newer than the one before
    (void)imu(sensor, sensor.imu_of(stamp += 50'000));
    if (i % 2 == 0) (void)lidar(sensor, sensor.lidar(now));
  }
  EXPECT_GT(gate.figures().refused[at], 15'000);
}

TEST_F(Gate, WhereArrivalIsInTheSensorsTimeTheFirstPacketIsBelieved) {
  gate = SensorGate(described(), {{}, Time{0}});
  EXPECT_EQ(judge(sensor.imu_of(now - kLatency), {}), GateCause::none);
  sensor.clock = sensor.began;
  EXPECT_EQ(judge(sensor.lidar(now), {}), GateCause::none);
  EXPECT_EQ(judge(sensor.imu_of(now + kNanosecondsPerSecond), {}), GateCause::ahead);
  EXPECT_EQ(correction, 0);
}

TEST_F(Gate, AnyBytesMayCome) {
  (void)run(sensor, 0.5);
  core::Rng rng(11);
  for (int i = 0; i < 3000; ++i) {
    testing::Bytes bytes = i % 2 == 0 ? sensor.lidar(now) : sensor.imu(now);
    for (int j = 0; j < 8; ++j)
      bytes[rng.index(static_cast<int>(bytes.size()))] = static_cast<std::uint8_t>(rng.index(256));
    if (i % 7 == 0) bytes.resize(rng.index(static_cast<int>(bytes.size())));
    (void)judge(bytes, i % 2 == 0 ? sensor.lidar_from : sensor.imu_from);
  }
  EXPECT_LT(run(sensor, 2), 60);  // whatever became of it, the sensor is heard
  EXPECT_EQ(run(sensor, 1), 0);
}

TEST(SensorReading, StampsAreCorrectedInEveryKindOfPacket) {
  for (const PacketProfile profile : {PacketProfile::kLegacy, PacketProfile::kRng15Rfl8Nir8,
                                      PacketProfile::kFusaRng15Rfl8Nir8Dual}) {
    const SensorInfo info = described(profile);
    const PacketFormat format(info);
    testing::Bytes packet = testing::made_packets(info, 3, 3)[5];
    const ReadPacket before = read_sensor_packet(packet, format, info);
    add_to_stamps(packet, -from_seconds(7), format, info);
    const ReadPacket after = read_sensor_packet(packet, format, info);
    ASSERT_EQ(after.fault, ReadingFault::none);
    EXPECT_EQ(after.reading.oldest, before.reading.oldest - from_seconds(7));
    EXPECT_EQ(after.reading.newest, before.reading.newest - from_seconds(7));
    EXPECT_EQ(after.reading.last.column, before.reading.last.column);
  }
  const SensorInfo info = described();
  std::vector<ImuSample> samples(8);
  for (int i = 0; i < 8; ++i) {
    samples[i].stamp = from_seconds(9) + i * kMillisecond;
    samples[i].acceleration = {0, 0, 9.8};
    samples[i].angular_velocity = {0.1, 0, 0};
  }
  for (testing::Bytes packet : {encode_imu(samples[0], info), encode_imu(samples, info)}) {
    add_to_stamps(packet, from_seconds(100), PacketFormat(info), info);
    const auto decoded = decode_imu(packet, info);
    ASSERT_FALSE(decoded.empty());
    for (std::size_t i = 0; i < decoded.size(); ++i)
      EXPECT_EQ(decoded[i].stamp, samples[i].stamp + from_seconds(100));
  }
}

}  // namespace
}  // namespace saker::lidar
