#include "saker/lidar/sensor_gate.h"

#include <limits>

#include "live_sensor.h"
#include "saker/core/rng.h"

namespace saker::lidar {
namespace {

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
    if (i % 5 > 0 && rng.chance(0.2)) continue;  // lost
    if (i % 5 > 1 && rng.chance(0.3)) {          // overtaken by some
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

TEST(UdpSource, IsReadAndWrittenWithDots) {
  EXPECT_EQ(parse_address("192.168.7.2"), kAddress);
  EXPECT_EQ(to_string(UdpSource{kAddress, 7502}), "192.168.7.2:7502");
  for (const char* none :
       {"", "192.168.7", "192.168.7.256", "192.168.7.2.1", "a.b.c.d", "1.2.3.-4"})
    EXPECT_EQ(parse_address(none), std::nullopt) << none;
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
