#include "saker/lidar/clouds/cloud_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "made_clouds.h"
#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/core/rng.h"
#include "saker/lidar/bags/decompress.h"
#include "saker/lidar/clouds/cloud_folder.h"

namespace saker::lidar {
namespace {

using testing::MadePoint;
using testing::TemporaryFolder;
using Bytes = std::vector<std::uint8_t>;

/// Point i is (i + 1, −i, 0.5 i), intensity 10 i, ring i.
std::vector<MadePoint> three_points() {
  std::vector<MadePoint> points;
  for (int i = 0; i < 3; ++i) {
    const auto n = static_cast<float>(i);
    points.push_back({n + 1, -n, n / 2, 10 * n, 0, static_cast<std::uint16_t>(i)});
  }
  return points;
}

Bytes pcd(const std::string& data) { return testing::made_pcd(data, three_points()); }
Bytes ply(const std::string& format) { return testing::made_ply(format, three_points()); }

std::string parse(ByteView bytes, Cloud& cloud) {
  switch (cloud_format(bytes)) {
    case CloudFormat::kPcd:
      return parse_pcd(bytes, cloud);
    case CloudFormat::kPly:
      return parse_ply(bytes, cloud);
    case CloudFormat::kNpy:
      return parse_npy(bytes, cloud);
    case CloudFormat::kNone:
      break;
  }
  return "none";
}

std::map<std::string, Bytes> every_kind() {
  return {{"pcd ascii", pcd("ascii")},
          {"pcd binary", pcd("binary")},
          {"pcd compressed", pcd("binary_compressed")},
          {"ply ascii", ply("ascii")},
          {"ply little", ply("binary_little_endian")},
          {"ply big", ply("binary_big_endian")},
          {"npy records", testing::made_npy(three_points())}};
}

TEST(CloudFile, EveryKindGivesTheSamePoints) {
  for (const auto& [name, bytes] : every_kind()) {
    SCOPED_TRACE(name);
    Cloud cloud;
    ASSERT_EQ(parse(bytes, cloud), "");
    PointReader reader(cloud.layout, name);
    Scan scan;
    ASSERT_EQ(reader.read(cloud.bytes, cloud.rows, cloud.columns, cloud.columns * cloud.layout.step,
                          7, scan),
              "");
    ASSERT_EQ(scan.size(), 3U);
    EXPECT_EQ(scan.stamp, 7);
    EXPECT_EQ(scan.points[1], Eigen::Vector3f(2, -1, 0.5F));
    EXPECT_EQ(scan.points[2], Eigen::Vector3f(3, -2, 1));
    EXPECT_FLOAT_EQ(scan.reflectivity[2], 20.0F / 255);
    EXPECT_EQ(scan.ring, (std::vector<std::uint16_t>{0, 1, 2}));
  }
}

TEST(CloudFile, CutAnywhereTheyAreRefusedWithALine) {
  for (const auto& [name, bytes] : every_kind()) {
    if (name.find("ascii") != std::string::npos) continue;  // "2" is a cut "20"
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      Cloud cloud;
      EXPECT_NE(parse(ByteView(bytes).first(size), cloud), "") << name << " " << size;
    }
  }
}

TEST(CloudFile, DamagedBytesNeverReadPastTheEnd) {
  core::Rng rng(3);
  for (const auto& [name, bytes] : every_kind()) {
    for (int trial = 0; trial < 300; ++trial) {
      Bytes damaged = bytes;
      for (int i = 0; i < 3; ++i) {
        damaged[static_cast<std::size_t>(rng.index(static_cast<int>(bytes.size())))] =
            static_cast<std::uint8_t>(rng.index(256));
      }
      Cloud cloud;
      if (!parse(damaged, cloud).empty()) continue;
      EXPECT_LE(cloud.rows * cloud.columns * cloud.layout.step, cloud.bytes.size()) << name;
    }
  }
}

TEST(CloudFile, RowsOfNumpyWithoutNamesAreToldByTheirNumbers) {
  Bytes data;
  for (int i = 0; i < 400; ++i) {
    const auto n = static_cast<double>(i);
    for (const double value : {10 * std::cos(n), 10 * std::sin(n), -1.5, 0.3 + 0.001 * (i % 100)}) {
      testing::put(data, value);
    }
  }
  Cloud cloud;
  ASSERT_EQ(parse_npy(testing::npy_of("'<f8'", "400, 4", data), cloud), "");
  EXPECT_EQ(cloud.layout.names(), "x y z intensity");
  EXPECT_EQ(cloud.columns, 400U);
}

TEST(Lzf, RepeatsWhatWasThere) {
  // "abc", then seven bytes from three back, then ten from one back.
  const Bytes packed = {2, 'a', 'b', 'c', 5 << 5, 2, 7 << 5, 1, 0};
  Bytes bytes;
  ASSERT_TRUE(decompress_lzf(packed, 20, bytes));
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()), "abcabcabcaaaaaaaaaaa");
  EXPECT_FALSE(decompress_lzf(packed, 19, bytes));
  EXPECT_FALSE(decompress_lzf(Bytes{1 << 5, 0}, 3, bytes));  // before the beginning
  EXPECT_FALSE(decompress_lzf(packed, std::size_t{1} << 40, bytes));
}

TEST(CloudFolder, GivesScansInNaturalOrderAndGoesOnAfterABadOne) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name, const Bytes& bytes) {
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  };
  Bytes cut = pcd("binary");
  cut.resize(cut.size() - 5);
  write("2.pcd", cut);
  write("10.pcd", pcd("binary"));
  write("1.pcd", pcd("binary"));
  write("11.pcd", pcd("ascii"));  // other fields than the first
  const auto source = open_recording(folder.path());
  std::vector<std::string> names, faults;
  while (const auto frame = source->next()) {
    names.push_back(frame->name);
    faults.push_back(frame->fault);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"1", "2", "10", "11"}));
  EXPECT_EQ(faults[0], "");
  EXPECT_NE(faults[1].find("cut"), std::string::npos) << faults[1];
  EXPECT_EQ(faults[2], "");
  EXPECT_EQ(source->counters().faulty_scans, 1 + !faults[3].empty());
}

TEST(CloudFolder, ACloudWithoutXYZIsRefusedByItsFields) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.pcd") << "FIELDS a b\nSIZE 4 4\nTYPE F F\nWIDTH 1\nDATA ascii\n1 2\n";
  try {
    (void)open_recording(folder / "a.pcd");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("fields a b"), std::string::npos) << error.what();
  }
}

/// The fault of a head with these lines, behind which hardly anything stands.
std::string fault_of(const std::string& head) {
  Cloud cloud;
  const std::string file = "FIELDS x y z\n" + head + "\n1 2 3\n";
  return parse_pcd(Bytes(file.begin(), file.end()), cloud);
}

TEST(PcdFile, PointsThatItsBytesCannotHoldTakeNoMemory) {
  EXPECT_NE(fault_of("WIDTH 20000000\nDATA ascii"), "");
  EXPECT_NE(fault_of("COUNT 4096 4096 4096\nWIDTH 6\nDATA ascii"), "");
  EXPECT_NE(fault_of("COUNT 4096 4096 4096\nWIDTH 20000000\nDATA binary"), "");
  EXPECT_NE(fault_of("WIDTH 20000001\nDATA ascii").find("expected 0 to 20000000"),
            std::string::npos);
}

TEST(PcdFile, WithoutAUsableSizeIsRefused) {
  for (const char* size : {"", "WIDTH a", "WIDTH -1\nHEIGHT -1", "WIDTH 1\nHEIGHT b"}) {
    EXPECT_NE(fault_of(size + std::string("\nDATA ascii")).find("WIDTH and HEIGHT"),
              std::string::npos)
        << size;
  }
}

TEST(PcdFile, OfRowsAndColumnsKeepsThem) {
  Cloud cloud;
  const std::string file =
      "FIELDS x y z\nWIDTH 2\nHEIGHT 3\nPOINTS 6\nDATA ascii\n1 1 1\n2 1 1\n1 2 1\n2 2 1\n"
      "1 3 1\n2 3 1\n";
  ASSERT_EQ(parse_pcd(Bytes(file.begin(), file.end()), cloud), "");
  EXPECT_EQ(cloud.rows, 3U);
  EXPECT_EQ(cloud.columns, 2U);
}

}  // namespace
}  // namespace saker::lidar
