#include "saker/lidar/clouds/cloud_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>

#include "made_sensor.h"
#include "saker/core/error.h"
#include "saker/core/rng.h"
#include "saker/lidar/bags/decompress.h"
#include "saker/lidar/clouds/cloud_folder.h"

namespace saker::lidar {
namespace {

using testing::TemporaryFolder;
using Bytes = std::vector<std::uint8_t>;

Bytes bytes_of_text(const std::string& text) { return {text.begin(), text.end()}; }

template <class T>
void put(Bytes& bytes, T value, bool big_endian = false) {
  std::uint8_t raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big_endian) std::reverse(raw, raw + sizeof(T));
  bytes.insert(bytes.end(), raw, raw + sizeof(T));
}

const std::string kPcdHead =
    "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z intensity ring\n"
    "SIZE 4 4 4 4 2\nTYPE F F F F U\nCOUNT 1 1 1 1 1\nWIDTH 3\nHEIGHT 1\n"
    "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 3\n";

/// Point i is (i + 1, −i, 0.5 i), intensity 10 i, ring i.
Bytes records(bool planes, bool big_endian = false) {
  Bytes bytes;
  const auto number = [&](int i, int field) {
    const auto n = static_cast<float>(i);
    if (field == 4) return put(bytes, static_cast<std::uint16_t>(i), big_endian);
    put(bytes, field == 0 ? n + 1 : field == 1 ? -n : field == 2 ? n / 2 : 10 * n, big_endian);
  };
  if (planes) {
    for (int field = 0; field < 5; ++field) {
      for (int i = 0; i < 3; ++i) number(i, field);
    }
  } else {
    for (int i = 0; i < 3; ++i) {
      for (int field = 0; field < 5; ++field) number(i, field);
    }
  }
  return bytes;
}

/// Literals only, as a packer may write them.
Bytes lzf_of(const Bytes& bytes) {
  Bytes packed;
  for (std::size_t at = 0; at < bytes.size(); at += 32) {
    const std::size_t count = std::min<std::size_t>(32, bytes.size() - at);
    packed.push_back(static_cast<std::uint8_t>(count - 1));
    packed.insert(packed.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                  bytes.begin() + static_cast<std::ptrdiff_t>(at + count));
  }
  return packed;
}

Bytes pcd(const std::string& kind) {
  Bytes file = bytes_of_text(kPcdHead + "DATA " + kind + "\n");
  if (kind == "ascii") {
    const Bytes text = bytes_of_text("1 0 0 0 0\n2 -1 0.5 10 1\n3 -2 1 20 2\n");
    file.insert(file.end(), text.begin(), text.end());
  } else if (kind == "binary") {
    const Bytes data = records(false);
    file.insert(file.end(), data.begin(), data.end());
  } else {
    const Bytes planes = records(true), packed = lzf_of(planes);
    put(file, static_cast<std::uint32_t>(packed.size()));
    put(file, static_cast<std::uint32_t>(planes.size()));
    file.insert(file.end(), packed.begin(), packed.end());
  }
  return file;
}

Bytes ply(const std::string& format) {
  Bytes file = bytes_of_text("ply\nformat " + format +
                             " 1.0\ncomment made\nelement vertex 3\nproperty float x\nproperty "
                             "float y\nproperty float z\nproperty float scalar_Intensity\nproperty "
                             "ushort ring\nelement face 0\nproperty list uchar int vertex_indices\n"
                             "end_header\n");
  const Bytes data = format == "ascii" ? bytes_of_text("1 0 0 0 0\n2 -1 0.5 10 1\n3 -2 1 20 2\n")
                                       : records(false, format == "binary_big_endian");
  file.insert(file.end(), data.begin(), data.end());
  return file;
}

Bytes npy(const std::string& descr, const std::string& shape, const Bytes& data) {
  const std::string head =
      "{'descr': " + descr + ", 'fortran_order': False, 'shape': (" + shape + "), }\n";
  Bytes file = bytes_of_text("\x93NUMPY");
  put(file, std::uint8_t{1});
  put(file, std::uint8_t{0});
  put(file, static_cast<std::uint16_t>(head.size()));
  file.insert(file.end(), head.begin(), head.end());
  file.insert(file.end(), data.begin(), data.end());
  return file;
}

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
          {"npy records", npy("[('x', '<f4'), ('y', '<f4'), ('z', '<f4'), ('intensity', '<f4'), "
                              "('ring', '<u2')]",
                              "3,", records(false))}};
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
      put(data, value);
    }
  }
  Cloud cloud;
  ASSERT_EQ(parse_npy(npy("'<f8'", "400, 4", data), cloud), "");
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

}  // namespace
}  // namespace saker::lidar
