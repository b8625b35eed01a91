#include "saker/lidar/scan_assembler.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "made_sensor.h"
#include "saker/core/rng.h"

namespace saker::lidar {
namespace {

using testing::Bytes;
using testing::made_packets;
using testing::made_ranges;
using testing::made_time;

SensorInfo small_sensor() {
  return SensorInfo::make_os1(16, 512, PacketProfile::kRng19Rfl8Sig16Nir16);
}

std::vector<AssembledScan> all_of(ScanAssembler& assembler) {
  std::vector<AssembledScan> scans;
  while (auto scan = assembler.take()) scans.push_back(std::move(*scan));
  return scans;
}

void add(ScanAssembler& assembler, const std::vector<Bytes>& packets) {
  for (const Bytes& packet : packets) assembler.add(packet);
}

void add_frames(ScanAssembler& assembler, const SensorInfo& info, int first, int count) {
  for (int frame = 0; frame < count; ++frame) {
    add(assembler, made_packets(info, frame, (first + frame) % 65536));
  }
}

/// Profile, rows, columns, whether the window wraps.
using Shape = std::tuple<PacketProfile, int, int, bool>;
class EveryShape : public ::testing::TestWithParam<Shape> {
 protected:
  [[nodiscard]] static SensorInfo sensor() {
    const auto [profile, rows, columns, wraps] = GetParam();
    SensorInfo info = SensorInfo::make_os1(rows, columns, profile);
    if (wraps) info.column_window = {columns - 75, 100};
    return info;
  }
};
INSTANTIATE_TEST_SUITE_P(ScanAssembler, EveryShape,
                         ::testing::Combine(::testing::ValuesIn(packet_profiles()),
                                            ::testing::Values(16, 32, 64, 128),
                                            ::testing::Values(512, 1024, 2048), ::testing::Bool()));

TEST_P(EveryShape, GivesBackWhatWasSent) {
  const SensorInfo info = sensor();
  ScanAssembler assembler(info, true);
  add_frames(assembler, info, 7, 2);
  const auto scans = all_of(assembler);
  ASSERT_EQ(scans.size(), 2U);
  for (int frame = 0; frame < 2; ++frame) {
    EXPECT_EQ(scans[frame].frame_id, 7 + frame);
    EXPECT_EQ(scans[frame].valid_columns, info.column_window.size(info.columns));
    EXPECT_EQ(scans[frame].ranges_mm, made_ranges(info, frame));
  }
  EXPECT_EQ(assembler.counters().missing_columns, 0);
}

TEST_P(EveryShape, APointLiesOnItsRayWithItsTimeAndReflectivity) {
  const SensorInfo info = sensor();
  ScanAssembler assembler(info);
  add_frames(assembler, info, 0, 1);
  assembler.finish();
  const auto scans = all_of(assembler);
  ASSERT_EQ(scans.size(), 1U);
  const Scan& scan = scans[0].scan;
  const RayTable rays(info);
  const auto ranges = made_ranges(info, 0);
  int returns = 0;
  for (int row = 0; row < info.rows; ++row) {
    for (int column = 0; column < info.columns; ++column) {
      const int to = (column + info.pixel_shift_by_row[row]) % info.columns;
      const std::size_t at = static_cast<std::size_t>(row) * info.columns + to;
      const std::uint32_t range = ranges[static_cast<std::size_t>(row) * info.columns + column];
      ASSERT_LE(scan.offset_ns[at], 0);
      if (range == 0) {
        ASSERT_TRUE(scan.points[at].array().isNaN().all());
        continue;
      }
      ++returns;
      const RayTable::Ray& ray = rays.ray(row, column);
      const Eigen::Vector3f from_origin = scan.points[at] - ray.origin;
      ASSERT_NEAR(from_origin.norm(), static_cast<float>(range) * 1e-3F, 1e-4F);
      ASSERT_LT(from_origin.cross(ray.direction).norm(), 1e-4F);
      ASSERT_EQ(scan.time_of(at), made_time(info, 0, column));
      ASSERT_FLOAT_EQ(scan.reflectivity[at],
                      static_cast<float>(testing::made_reflectivity(row, column)) / 255.0F);
    }
  }
  EXPECT_EQ(scans[0].returns, returns);
}

TEST(ScanAssembler, TheStampIsTheTimeOfTheLastColumn) {
  const SensorInfo info = small_sensor();
  ScanAssembler assembler(info);
  add_frames(assembler, info, 0, 1);
  const auto scans = all_of(assembler);
  ASSERT_EQ(scans.size(), 1U);  // full: it need not wait for the next frame
  EXPECT_EQ(scans[0].scan.stamp, made_time(info, 0, 511));
  EXPECT_EQ(scans[0].first_column, made_time(info, 0, 0));
}

TEST(ScanAssembler, LostPacketsLeaveTheirColumnsEmptyAndAreCounted) {
  const SensorInfo info = small_sensor();
  ScanAssembler assembler(info, true);
  add_frames(assembler, info, 0, 1);
  auto packets = made_packets(info, 1, 1);
  packets.erase(packets.begin() + 4, packets.begin() + 6);
  add(assembler, packets);
  add(assembler, made_packets(info, 2, 2));
  const auto scans = all_of(assembler);
  ASSERT_EQ(scans.size(), 3U);
  EXPECT_EQ(scans[1].valid_columns, 512 - 32);
  EXPECT_EQ(assembler.counters().missing_columns, 32);
  EXPECT_EQ(scans[1].ranges_mm[64], 0U);
  EXPECT_EQ(scans[1].ranges_mm[63], testing::made_range(1, 0, 63));
  EXPECT_EQ(scans[2].ranges_mm, made_ranges(info, 2));
}

TEST(ScanAssembler, PacketsOfAFrameMayComeInAnyOrderAndTwice) {
  const SensorInfo info = small_sensor();
  core::Rng rng(3);
  auto packets = made_packets(info, 0, 0);
  packets.push_back(packets[3]);
  for (std::size_t i = packets.size() - 1; i > 0; --i) {
    std::swap(packets[i], packets[rng.index(static_cast<int>(i) + 1)]);
  }
  ScanAssembler assembler(info, true);
  add(assembler, packets);
  const auto scans = all_of(assembler);
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(scans[0].ranges_mm, made_ranges(info, 0));
  const AssemblerCounters& counters = assembler.counters();
  EXPECT_EQ(counters.repeated_columns / 16 + counters.late_packets, 1);
}

TEST(ScanAssembler, APacketOfAnEndedFrameIsDroppedAndCounted) {
  const SensorInfo info = small_sensor();
  ScanAssembler assembler(info, true);
  auto first = made_packets(info, 0, 65535);
  const Bytes late = first.back();
  first.pop_back();
  const auto second = made_packets(info, 1, 0);  // the number wraps
  add(assembler, first);
  assembler.add(second[0]);
  assembler.add(late);
  add(assembler, {second.begin() + 1, second.end()});
  const auto scans = all_of(assembler);
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_EQ(assembler.counters().late_packets, 1);
  EXPECT_EQ(scans[0].valid_columns, 512 - 16);
  EXPECT_EQ(scans[1].ranges_mm, made_ranges(info, 1));
}

TEST(ScanAssembler, FrameNumbersWrapWithoutALoss) {
  const SensorInfo info = small_sensor();
  ScanAssembler assembler(info);
  add_frames(assembler, info, 65533, 6);
  const auto scans = all_of(assembler);
  ASSERT_EQ(scans.size(), 6U);
  EXPECT_EQ(scans[2].frame_id, 65535);
  EXPECT_EQ(scans[3].frame_id, 0);
  EXPECT_EQ(assembler.counters().lost_frames, 0);
  EXPECT_EQ(assembler.counters().late_packets, 0);
}

TEST(ScanAssembler, FramesOfWhichNothingCameAreCounted) {
  const SensorInfo info = small_sensor();
  ScanAssembler assembler(info);
  add(assembler, made_packets(info, 0, 10));
  add(assembler, made_packets(info, 4, 14));
  EXPECT_EQ(all_of(assembler).size(), 2U);
  EXPECT_EQ(assembler.counters().lost_frames, 3);
}

TEST(ScanAssembler, ASensorThatRestartsIsFollowed) {
  const SensorInfo info = small_sensor();
  ScanAssembler assembler(info);
  add(assembler, made_packets(info, 0, 5000));
  add(assembler, made_packets(info, 1, 0));
  EXPECT_EQ(all_of(assembler).size(), 2U);
  EXPECT_EQ(assembler.counters().late_packets, 0);
}

TEST(ScanAssembler, PartialFirstAndLastFramesAreGivenAndNothingIsMissingFromThem) {
  const SensorInfo info = small_sensor();
  ScanAssembler assembler(info);
  const auto first = made_packets(info, 0, 0);
  const auto last = made_packets(info, 2, 2);
  add(assembler, {first.begin() + 20, first.end()});
  add(assembler, made_packets(info, 1, 1));
  add(assembler, {last.begin(), last.begin() + 3});
  assembler.finish();
  const auto scans = all_of(assembler);
  ASSERT_EQ(scans.size(), 3U);
  EXPECT_EQ(scans[0].valid_columns, 12 * 16);
  EXPECT_EQ(scans[2].valid_columns, 3 * 16);
  EXPECT_EQ(scans[2].scan.stamp, made_time(info, 2, 47));
  EXPECT_EQ(assembler.counters().missing_columns, 0);
}

TEST(ScanAssembler, WrongSizesAndColumnsThatDoNotExistAreCounted) {
  const SensorInfo info = small_sensor();
  ScanAssembler assembler(info);
  assembler.add({});
  assembler.add(Bytes(100, 1));
  Column beyond = testing::made_column(info, 0, 0, 3);
  beyond.measurement_id = 512;
  assembler.add(PacketFormat(info).encode({&beyond, 1}));
  EXPECT_EQ(assembler.counters().bad_packets, 2);
  EXPECT_EQ(assembler.counters().bad_columns, 1);
}

TEST(ScanAssembler, AColumnSecondsAwayFromItsFrameIsDropped) {
  const SensorInfo info = small_sensor();
  ScanAssembler assembler(info);
  std::vector<Column> columns = {testing::made_column(info, 0, 0, 0),
                                 testing::made_column(info, 0, 0, 1)};
  columns[1].time += 10 * kNanosecondsPerSecond;
  assembler.add(PacketFormat(info).encode(columns));
  assembler.finish();
  const auto scans = all_of(assembler);
  ASSERT_EQ(scans.size(), 1U);
  EXPECT_EQ(scans[0].valid_columns, 1);
  EXPECT_EQ(assembler.counters().bad_columns, 1);
}

void damage(Bytes& packet, core::Rng& rng) {
  for (int flips = rng.index(12); flips > 0; --flips) {
    packet[rng.index(static_cast<int>(packet.size()))] = static_cast<std::uint8_t>(rng.index(256));
  }
  if (rng.chance(0.1)) packet.resize(rng.index(static_cast<int>(packet.size())));
}

TEST(ScanAssembler, DamagedPacketsNeverGiveAPointThatIsNotAReturn) {
  core::Rng rng(11);
  for (const PacketProfile profile : packet_profiles()) {
    SensorInfo info = SensorInfo::make_os1(16, 512, profile);
    info.column_window = {400, 99};
    ScanAssembler assembler(info, true);
    for (int frame = 0; frame < 12; ++frame) {
      auto packets = made_packets(info, frame, frame);
      for (Bytes& packet : packets) damage(packet, rng);
      add(assembler, packets);
      for (const AssembledScan& scan : all_of(assembler)) {
        ASSERT_EQ(scan.scan.points.size(), 16U * 512U);
        int finite = 0;
        for (std::size_t i = 0; i < scan.scan.size(); ++i) {
          finite += scan.scan.points[i].allFinite();
          ASSERT_LE(scan.scan.offset_ns[i], 0);
        }
        ASSERT_EQ(finite, scan.returns);
      }
    }
  }
}

}  // namespace
}  // namespace saker::lidar
