#include "saker/lidar/osf/osf_recording.h"

#include <gtest/gtest.h>

#include "made_bag.h"
#include "made_osf.h"
#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/core/rng.h"
#include "saker/lidar/osf/osf_image.h"

namespace saker::lidar {
namespace {

using testing::made_osf;
using testing::osf_sensor;
using testing::TemporaryFolder;
using Bytes = std::vector<std::uint8_t>;

RecordingOptions with_ranges() {
  RecordingOptions options;
  options.keep_ranges = true;
  return options;
}

TEST(OsfRecording, ScansOfTodaysAndOfOlderFilesAreTheSame) {
  for (const bool png : {false, true}) {
    const TemporaryFolder folder;
    testing::write_bytes(folder / "drive", made_osf(osf_sensor(), 3, png));
    const auto source = open_recording(folder / "drive", with_ranges());
    int frames = 0;
    for (; const auto frame = source->next(); ++frames) {
      ASSERT_EQ(frame->fault, "");
      EXPECT_EQ(source->assembled()->ranges_mm, testing::made_ranges(osf_sensor(), frames)) << png;
      EXPECT_EQ(source->assembled()->frame_id, 100 + frames);
      EXPECT_EQ(frame->scan.stamp, testing::made_time(osf_sensor(), frames, 511));
    }
    EXPECT_EQ(frames, 3);
    EXPECT_EQ(source->counters().summary(), "");
  }
}

TEST(OsfRecording, InertialSamplesOfAScanComeWithItInTheLidarsFrame) {
  const TemporaryFolder folder;
  testing::write_bytes(folder / "drive", made_osf(osf_sensor(), 3, false, true, 10));
  const auto source = open_recording(folder / "drive");
  const Eigen::Matrix3d R = osf_sensor().T_sensor_imu.linear();
  for (int frame = 0; frame < 3; ++frame) {
    const auto read = source->next();
    ASSERT_TRUE(read);
    ASSERT_EQ(read->imu.size(), 8U);  // two of ten are not valid
    for (int i = 0, k = 0; i < 10; ++i) {
      if (i % 5 == 4) continue;
      const testing::MadeOsfSample made = testing::made_osf_sample(osf_sensor(), frame, i);
      const ImuSample& sample = read->imu[static_cast<std::size_t>(k++)];
      EXPECT_EQ(sample.stamp, made.stamp);
      EXPECT_LT((sample.acceleration - R * made.acceleration.cast<double>() * 9.80665).norm(),
                1e-5);
      EXPECT_LT((sample.angular_velocity - R * made.rate.cast<double>() * M_PI / 180).norm(), 1e-6);
    }
  }
  EXPECT_EQ(source->counters().imu_samples, 24);
}

TEST(OsfRecording, AnotherSensorThanTheOneThatIsThereIsRefused) {
  const TemporaryFolder folder;
  testing::write_bytes(folder / "drive", made_osf(osf_sensor(), 1, false));
  RecordingOptions options;
  options.sensor = "1";
  EXPECT_THROW((void)open_recording(folder / "drive", options), Error);
  options.sensor = "122246000293";
  EXPECT_TRUE(open_recording(folder / "drive", options)->next());
}

TEST(OsfRecording, CutOrDamagedFilesNeverThrowPastTheOpening) {
  const TemporaryFolder folder;
  core::Rng rng(9);
  const Bytes whole = made_osf(osf_sensor(), 2, false);
  for (int trial = 0; trial < 200; ++trial) {
    Bytes bytes = whole;
    if (trial % 2 == 0) {
      bytes.resize(static_cast<std::size_t>(rng.index(static_cast<int>(whole.size()))));
    } else {
      for (int i = 0; i < 5; ++i) {
        bytes[static_cast<std::size_t>(rng.index(static_cast<int>(whole.size())))] ^= 0x5A;
      }
    }
    testing::write_bytes(folder / "drive", bytes);
    try {
      OsfRecording source(folder / "drive");
      int frames = 0;
      while (source.next()) ++frames;
      EXPECT_LE(frames, 2);
    } catch (const Error&) {
      // Its head or its metadata were hit.
    }
  }
}

TEST(OsfRecording, AScanWithoutTimesIsAFault) {
  const TemporaryFolder folder;
  testing::write_bytes(folder / "drive", made_osf(osf_sensor(), 1, false, false));
  const auto frame = open_recording(folder / "drive")->next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->fault, "0 columns, expected 512");
}

TEST(OsfImage, OfAnotherSizeOrDamagedIsRefused) {
  const auto ranges = testing::made_ranges(osf_sensor(), 0);
  for (const Bytes& whole :
       {testing::packed32(ranges, 16, 512), testing::png32(ranges, osf_sensor())}) {
    OsfImage image;
    EXPECT_TRUE(unpack_osf_image(whole, 16, 512, image));
    EXPECT_FALSE(unpack_osf_image(whole, 512, 16, image));
    for (std::size_t size = 0; size < whole.size(); size += 97) {
      EXPECT_FALSE(unpack_osf_image(ByteView(whole).first(size), 16, 512, image)) << size;
    }
  }
}

}  // namespace
}  // namespace saker::lidar
