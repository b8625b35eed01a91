#include <map>

#include "live_sensor.h"
#include "saker/core/rng.h"

/// A clock that steps: what passes carries the stamps of one that did not.
namespace saker::lidar {
namespace {

constexpr Time kMicrosecond = 1'000;

/// Both streams as they are sent, each at its own pace, and what passes.
class SteppingGate : public Gate {
 protected:
  struct Sent {
    testing::Bytes bytes;
    UdpSource from;
    Time arrival = 0, true_stamp = 0;
  };

  void send(double seconds) {
    for (const Time end = now + from_seconds(seconds); now < end; now += 100 * kMicrosecond) {
      if (now >= next_lidar) {
        next_lidar += 16 * sensor.period();
        if (lidar_sends) send(sensor.lidar(now), sensor.lidar_from);
      }
      if (now >= next_imu) {
        next_imu += kImuPeriod;
        send(sensor.imu(now), sensor.imu_from);
      }
      if (now >= next_turn) turn();
    }
  }
  void send(const testing::Bytes& bytes, const UdpSource& from) {
    const auto late = static_cast<Time>(rng.uniform(0, 1) * static_cast<double>(jitter));
    last_arrival = std::max(last_arrival + 1, now + late);
    const bool imu = is_imu_packet(bytes);
    (imu ? imu_sent : lidar_sent) += 1;
    (imu ? imu_port : lidar_port)
        .push_back({bytes, from, last_arrival, sensor.stamp_at(now) - sensor.clock});
    if (turn_time == 0) turn();
  }
  /// As ports are read: one after the other.
  void turn() {
    next_turn = now + turn_time;
    for (std::vector<Sent>* port : {&imu_port, &lidar_port}) {
      for (const Sent& sent : *port) {
        truth[sent.arrival] = sent.true_stamp;
        gate.pass(sent.bytes, sent.from, sent.arrival,
                  [this](const testing::Bytes& passed, Time arrived) {
                    take(passed, truth.at(arrived));
                  });
      }
      port->clear();
    }
  }
  void take(const testing::Bytes& passed, Time true_stamp) {
    const ReadPacket read = read_sensor_packet(passed, sensor.format, sensor.info);
    const bool imu = read.reading.stream == SensorStream::imu;
    ++(imu ? imu_passed : lidar_passed);
    worst_s = std::max(worst_s, std::abs(to_seconds(read.reading.newest - true_stamp)));
    Time& last = imu ? last_imu : last_lidar;
    backwards += read.reading.newest <= last;
    last = read.reading.newest;
  }
  /// Known for a second, by a gate that knew nothing.
  void begin(Time imu_phase) {
    gate = SensorGate(described());
    sensor.clock = 0;
    now += kNanosecondsPerSecond;
    next_lidar = now;
    next_imu = now + imu_phase;
    send(1);
    worst_s = 0;
    imu_sent = imu_passed = lidar_sent = lidar_passed = backwards = 0;
  }

  core::Rng rng{4};
  Time jitter = 0;     // most that a packet is late
  Time turn_time = 0;  // 0: each packet is read as it comes
  std::vector<Sent> imu_port, lidar_port;
  std::map<Time, Time> truth;  // by arrival
  Time next_lidar = 0, next_imu = 0, next_turn = 0, last_arrival = 0;
  bool lidar_sends = true;
  double worst_s = 0;
  int imu_sent = 0, imu_passed = 0, lidar_sent = 0, lidar_passed = 0, backwards = 0;
  Time last_imu = 0, last_lidar = 0;
};

// Hazard: Sensor | its clock steps by 5 to 100 ms in flight | inertial samples wait for 0.04 s and
//   stamps go on | –
TEST_F(SteppingGate, WhatPassesIsWithinAMillisecondOfTheTruth) {
  for (const int step_ms : {5, 20, 50, 100, -5, -20, -50, -100}) {
    for (const int phase_us : {0, 700, 1400, 2100, 2800, 6000}) {
      SCOPED_TRACE(::testing::Message() << step_ms << " ms, phase " << phase_us << " µs");
      begin(phase_us * kMicrosecond);
      sensor.clock += step_ms * kMillisecond;
      send(0.5);
      sensor.clock = 0;  // and back
      send(0.5);
      EXPECT_EQ(agreements(), 3);
      EXPECT_LT(worst_s, 1e-3);
      EXPECT_EQ(backwards, 0);
      EXPECT_EQ(imu_passed, imu_sent);
      EXPECT_GT(lidar_passed, lidar_sent - 2 * 16) << "0.05 s each time";
    }
  }
}

TEST_F(SteppingGate, ANetworkThatJittersHidesNoStep) {
  for (const int step_ms : {5, 20, -50, 100}) {
    SCOPED_TRACE(step_ms);
    jitter = 0;
    begin(0);
    jitter = kMillisecond;
    sensor.clock += step_ms * kMillisecond;
    send(0.5);
    EXPECT_EQ(agreements(), 2);
    EXPECT_LT(worst_s, 1e-3);
    EXPECT_EQ(backwards, 0);
    EXPECT_EQ(imu_passed, imu_sent);
  }
}

// As in flight: 200 times a second, the inertial unit's port first.
TEST_F(SteppingGate, PortsThatAreReadOneAfterTheOtherHideNoStep) {
  turn_time = 5 * kMillisecond;
  for (const int step_ms : {5, 20, 100, -5, -20, -100}) {
    for (const int phase_us : {0, 1700, 3400, 5100, 8500}) {
      SCOPED_TRACE(::testing::Message() << step_ms << " ms, phase " << phase_us << " µs");
      begin(phase_us * kMicrosecond);
      sensor.clock += step_ms * kMillisecond;
      send(0.5);
      EXPECT_EQ(agreements(), 2);
      EXPECT_LT(worst_s, 1e-3);
      EXPECT_EQ(backwards, 0);
      EXPECT_GE(imu_passed, imu_sent - 1) << "one may not be read yet";
    }
  }
}

TEST_F(SteppingGate, InertialSamplesWaitForFourHundredthsOfASecond) {
  begin(0);
  sensor.clock -= 50 * kMillisecond;
  const Time stepped = now;
  const int passed = imu_passed;
  while (imu_passed == passed && now < stepped + kNanosecondsPerSecond) send(1e-3);
  EXPECT_LT(to_seconds(now - stepped), 0.04);
}

TEST_F(SteppingGate, WithoutTheLidarNothingWaits) {
  begin(0);
  lidar_sends = false;
  send(0.1);
  imu_sent = imu_passed = 0;
  jitter = 9 * kMillisecond;
  send(0.2);
  EXPECT_EQ(imu_passed, imu_sent);
}

// Its stamps fit nothing, nor each other: no step is told, and the inertial unit is believed alone.
TEST_F(SteppingGate, TheWaitEndsWhereTheLidarTellsNothing) {
  begin(0);
  lidar_sends = false;
  const int passed = imu_passed;
  int during = 0;
  for (int i = 0; i < 50; ++i) {
    send(4e-3);
    LiveSensor confused = sensor;
    confused.first_frame += rng.index(30000);
    send(confused.lidar(now), sensor.lidar_from);
    if (i == 15) during = imu_passed - passed;
  }
  EXPECT_EQ(agreements(), 1);
  EXPECT_LE(during, 1);  // before the first of them
  EXPECT_EQ(imu_passed, imu_sent);
  EXPECT_LT(worst_s, 1e-3);
  EXPECT_EQ(backwards, 0);
}

TEST_F(SteppingGate, ForgedPacketsDelayNoSampleBeyondTheNextPacketOfTheLidar) {
  begin(0);
  LiveSensor forged = sensor;
  forged.first_frame += 1;
  for (int i = 0; i < 500; ++i) {
    send(16e-4);
    (void)gate.judge(forged.lidar(now), sensor.lidar_from, now);
    (void)gate.judge(sensor.imu_of(sensor.stamp_at(now) + 5 * kNanosecondsPerSecond),
                     sensor.imu_from, now);
  }
  send(4e-3);
  EXPECT_EQ(agreements(), 1);
  EXPECT_EQ(imu_passed, imu_sent);
  EXPECT_EQ(backwards, 0);
}

// A copy of all but its clock gathers nothing while the sensor is heard, and has to begin anew.
TEST_F(SteppingGate, ACopyThatSentForLongIsNotTakenInAShortSilence) {
  begin(0);
  LiveSensor copy = sensor;
  copy.clock = 50 * kMillisecond;
  const auto intrude = [&](int times, double seconds) {
    for (int i = 0; i < times; ++i) {
      send(seconds / times);
      (void)gate.judge(copy.lidar(now), copy.lidar_from, now);
      if (i % 3 == 0) (void)gate.judge(copy.imu(now), copy.imu_from, now);
    }
  };
  intrude(300, 1);
  lidar_sends = false;
  intrude(7, 0.045);
  lidar_sends = true;
  intrude(300, 1);
  EXPECT_EQ(agreements(), 1);
}

TEST_F(SteppingGate, WhatWaitsIsBounded) {
  begin(0);
  LiveSensor stepped = sensor;
  stepped.clock -= 50 * kMillisecond;
  now += kMillisecond;
  (void)gate.judge(stepped.lidar(now), sensor.lidar_from, now);
  Time stamp = sensor.stamp_at(now);
  for (int i = 0; i < 300; ++i) {
    (void)gate.judge(sensor.imu_of(stamp += kMicrosecond), sensor.imu_from, now);
  }
  EXPECT_EQ(gate.figures().refused[static_cast<std::size_t>(GateCause::too_many)],
            300 - static_cast<long>(WaitingPackets::kMost));
  send(1);
  EXPECT_EQ(agreements(), 1);
}

}  // namespace
}  // namespace saker::lidar
