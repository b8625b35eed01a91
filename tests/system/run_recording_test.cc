#include "tools/saker/record/run_recording.h"

#include <gtest/gtest.h>

#include "flight_viewers/scratch_folder.h"
#include "saker/autonomy/config.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/lidar/bags/mcap_file.h"
#include "saker/lidar/recording.h"

/// What a run's recording holds is read by saker's own reader of bags.
namespace saker::tools {
namespace {

using flight::testing::ScratchFolder;
namespace fs = std::filesystem;

constexpr Time kMs = 1'000'000;

/// 3 beams of 4 columns, 10 ms apart; beam 1 of column 2 has no return.
lidar::Scan made_scan(Time stamp) {
  lidar::Scan scan;
  scan.stamp = stamp;
  scan.rows = 3;
  scan.columns = 4;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      const bool none = row == 1 && column == 2;
      scan.points.emplace_back(none ? NAN : 5.0F + static_cast<float>(column),
                               0.25F * static_cast<float>(row), 0.125F);
      scan.reflectivity.push_back(0.05F * static_cast<float>(row + column));
      scan.offset_ns.push_back((column - 3) * 10 * static_cast<std::int32_t>(kMs));
    }
  }
  return scan;
}

/// A folder of a run of 2 s.
void make_run(const fs::path& folder) {
  core::write_file(folder / "trajectory.txt",
                   "100.0 0 0 0 0 0 0 1\n101.0 1 0 0 0 0 0 1\n102.0 2 0 0 0 0 0 1\n");
}

autonomy::RegisteredScan some_points(double t) {
  return {
      .stamp = from_seconds(t),
      .points = std::make_shared<const std::vector<Eigen::Vector3f>>(3, Eigen::Vector3f(1, 2, 3))};
}

class RunRecordings : public ::testing::Test {
 protected:
  /// Of the run, with scans at 100.0, 100.1, … s.
  [[nodiscard]] fs::path record(int scans) const {
    make_run(scratch_.path());
    const fs::path file = scratch_ / "run.mcap";
    RunRecording recording(file, "R1");
    for (int i = 0; i < scans; ++i) recording.add(made_scan(from_seconds(100 + 0.1 * i)));
    recording.finish(scratch_.path(), flight::viewers::site_of({}, {}),
                     {some_points(100.2), some_points(101.4)});
    return file;
  }

  ScratchFolder scratch_;
};

TEST_F(RunRecordings, ScansAreReadAgainAsTheyWere) {
  const auto source = lidar::open_recording(record(4).string());
  for (int k = 0; k < 4; ++k) {
    const auto frame = source->next();
    ASSERT_TRUE(frame) << k;
    const lidar::Scan was = made_scan(from_seconds(100 + 0.1 * k));
    EXPECT_EQ(frame->fault, "");
    EXPECT_EQ(frame->scan.stamp, was.stamp);
    std::size_t at = 0;
    for (std::size_t i = 0; i < was.size(); ++i) {
      if (!was.points[i].allFinite()) continue;
      ASSERT_LT(at, frame->scan.size());
      EXPECT_EQ(frame->scan.points[at], was.points[i]);
      EXPECT_EQ(frame->scan.reflectivity[at], was.reflectivity[i]);
      EXPECT_EQ(frame->scan.time_of(at), was.time_of(i));
      EXPECT_EQ(frame->scan.ring[at], i / 4);
      ++at;
    }
    EXPECT_EQ(frame->scan.size(), at);
  }
  EXPECT_FALSE(source->next());
}

TEST_F(RunRecordings, ThereIsOneMessageOfAScanEach) {
  lidar::McapFile file(record(4));
  std::map<std::string, int> counts;
  while (const auto message = file.next()) ++counts[file.topics()[message->topic].name];
  EXPECT_EQ(counts["/R1/scan"], 4);
  EXPECT_GE(counts["/R1/points"], 2);  // some of the scans' points, for viewers
  EXPECT_GT(counts["/R1/odometry"], 0);
  EXPECT_GT(counts["/R1/tf"], 0);
}

TEST_F(RunRecordings, AScanWithoutPointsIsLeftOut) {
  make_run(scratch_.path());
  RunRecording recording(scratch_ / "run.mcap", "R1");
  recording.add(lidar::Scan());
  recording.add(made_scan(from_seconds(100.1)));
  recording.finish(scratch_.path(), flight::viewers::site_of({}, {}), {});
  const auto source = lidar::open_recording((scratch_ / "run.mcap").string());
  EXPECT_TRUE(source->next());
  EXPECT_FALSE(source->next());
}

TEST_F(RunRecordings, WhatIsNotFinishedLeavesNothing) {
  { RunRecording(scratch_ / "run.mcap", "R1").add(made_scan(from_seconds(100))); }
  EXPECT_TRUE(fs::is_empty(scratch_.path()));
}

TEST_F(RunRecordings, AFileThatIsThereIsReplacedOnlyByForce) {
  const fs::path file = scratch_ / "run.mcap";
  core::write_file(file, "old");
  EXPECT_THROW(static_cast<void>(record_file(file.string(), false)), Error);
  EXPECT_EQ(record_file(file.string(), true), file);
  EXPECT_EQ(record_file("", false), std::nullopt);
}

TEST_F(RunRecordings, AnotherEndingIsRefused) {
  EXPECT_THROW(static_cast<void>(record_file((scratch_ / "run.bag").string(), false)), Error);
}

}  // namespace
}  // namespace saker::tools
