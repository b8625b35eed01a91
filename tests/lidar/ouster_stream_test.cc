#include "saker/lidar/ouster_stream.h"

#include <gtest/gtest.h>

#include "made_sensor.h"
#include "saker/lidar/imu_packet.h"

namespace saker::lidar {
namespace {

using testing::made_packets;
using testing::made_time;

SensorInfo sensor() { return SensorInfo::make_os1(16, 512, PacketProfile::kRng15Rfl8Nir8); }

testing::Bytes imu_at(Time stamp) {
  ImuSample sample;
  sample.stamp = stamp;
  sample.acceleration = {0, 0, 9.8};
  sample.angular_velocity = {0, 0, 0.1};
  return encode_imu(sample, sensor());
}

void add_frame(OusterStream& stream, int frame) {
  for (const auto& packet : made_packets(sensor(), frame, frame)) stream.add(packet);
}

TEST(OusterStream, AFrameHasTheInertialSamplesUpToItsStampInOrder) {
  OusterStream stream(sensor());
  const Time first = made_time(sensor(), 0, 0);
  const Time stamp = made_time(sensor(), 0, 511);
  for (const Time offset : {30, 10, 20}) stream.add(imu_at(first + offset));
  stream.add(imu_at(stamp + 1));  // belongs to the next one
  add_frame(stream, 0);
  add_frame(stream, 1);
  const auto a = stream.take();
  const auto b = stream.take();
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->frame.imu.size(), 3U);
  EXPECT_EQ(a->frame.imu[0].stamp, first + 10);
  EXPECT_EQ(a->frame.imu[2].stamp, first + 30);
  ASSERT_EQ(b->frame.imu.size(), 1U);
  EXPECT_EQ(b->frame.imu[0].stamp, stamp + 1);
}

TEST(OusterStream, NoSampleIsGivenTwiceOrOutOfOrder) {
  OusterStream stream(sensor());
  const Time first = made_time(sensor(), 0, 0);
  stream.add(imu_at(first + 10));
  stream.add(imu_at(first + 10));
  add_frame(stream, 0);
  const auto a = stream.take();
  stream.add(imu_at(first + 5));  // older than what was given
  add_frame(stream, 1);
  const auto b = stream.take();
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->frame.imu.size(), 1U);
  EXPECT_TRUE(b->frame.imu.empty());
  EXPECT_EQ(stream.late_imu_samples(), 2);
}

TEST(OusterStream, NamesFramesByRunningNumbersOfSixDigits) {
  OusterStream stream(sensor());
  for (int frame = 0; frame < 3; ++frame) add_frame(stream, frame);
  for (const char* name : {"000000", "000001", "000002"}) {
    const auto item = stream.take();
    ASSERT_TRUE(item);
    EXPECT_EQ(item->frame.name, name);
  }
  EXPECT_EQ(stream.counters().summary(), "");
}

/// Frames 0 to 9, whose clock is `step` ahead from the middle of frame 5 on, each packet of the
/// inertial unit after one of the lidar.
void add_stepping(OusterStream& stream, Time step) {
  const PacketFormat format(sensor());
  for (int frame = 0; frame < 10; ++frame) {
    for (int first = 0; first < 512; first += sensor().columns_per_packet) {
      std::vector<Column> columns;
      for (int i = 0; i < sensor().columns_per_packet; ++i) {
        columns.push_back(testing::made_column(sensor(), frame, frame, first + i));
        if (frame > 5 || (frame == 5 && first >= 256)) columns.back().time += step;
      }
      stream.add(format.encode(columns));
      stream.add(imu_at(columns.back().time));
    }
  }
  stream.finish();
}

TEST(OusterStream, StampsGoOnWhereTheClockSteps) {
  for (const double step_s : {-900.0, -1.0, 0.3, 1.0, 1e9}) {
    OusterStream stream(sensor());
    add_stepping(stream, from_seconds(step_s));
    EXPECT_EQ(stream.counters().clock_steps, 1) << step_s;
    Time last_imu = 0;
    int samples = 0;
    for (int frame = 0; frame < 10; ++frame) {
      const auto item = stream.take();
      ASSERT_TRUE(item);
      EXPECT_NEAR(to_seconds(item->frame.scan.stamp - made_time(sensor(), frame, 511)), 0, 1e-3)
          << step_s << " frame " << frame;
      for (const ImuSample& sample : item->frame.imu) {
        EXPECT_LT(sample.stamp - last_imu, from_seconds(last_imu == 0 ? 1e9 : 0.02));
        EXPECT_GT(sample.stamp, last_imu);
        last_imu = sample.stamp;
        ++samples;
      }
    }
    EXPECT_GE(samples, 10 * 512 / sensor().columns_per_packet - 4) << step_s;
  }
}

// Live: the gate has put them back already, by the time of arrival.
TEST(OusterStream, StampsThatGoOnAreLeftAsTheyAre) {
  const Time step = from_seconds(20);
  OusterStream stream(sensor(), false, OusterStream::Stamps::go_on);
  add_stepping(stream, step);
  EXPECT_EQ(stream.counters().clock_steps, 0);
  std::optional<OusterStream::Item> last;
  while (auto item = stream.take()) last = std::move(item);
  ASSERT_TRUE(last);
  EXPECT_EQ(last->frame.scan.stamp, made_time(sensor(), 9, 511) + step);
}

TEST(OusterStream, WhatWasNotUsedIsToldInWords) {
  OusterStream stream(sensor());
  stream.add(testing::Bytes(17, 0));
  EXPECT_EQ(stream.counters().summary(), "1 bad packets");
}

}  // namespace
}  // namespace saker::lidar
