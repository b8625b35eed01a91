#include "live_sensor.h"

/// A sensor that falls silent, restarts, or whose clock steps.
namespace saker::lidar {
namespace {

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

}  // namespace
}  // namespace saker::lidar
