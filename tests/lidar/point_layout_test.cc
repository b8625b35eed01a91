#include "saker/lidar/clouds/point_layout.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "saker/core/error.h"

namespace saker::lidar {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class T>
void put(Bytes& bytes, T value) {
  bytes.resize(bytes.size() + sizeof value);
  std::memcpy(&bytes[bytes.size() - sizeof value], &value, sizeof value);
}

/// Three points of x, y, z and a time of type T.
template <class T>
Scan with_times(const char* name, NumberType type, std::array<T, 3> times, Time stamp) {
  PointLayout layout;
  for (const char* axis : {"x", "y", "z"}) layout.append(axis, NumberType::kF32);
  layout.append(name, type);
  Bytes bytes;
  for (const T time : times) {
    for (int i = 0; i < 3; ++i) put(bytes, 1.0F);
    put(bytes, time);
  }
  PointReader reader(layout, "made");
  Scan scan;
  EXPECT_EQ(reader.read(bytes, 1, 3, bytes.size(), stamp, scan), "");
  return scan;
}

constexpr Time kStamp = 1'700'000'000 * kNanosecondsPerSecond;
const std::vector<std::int32_t> kOffsets = {-100'000'000, -50'000'000, 0};

TEST(PointReader, EveryWayToSayATimeIsUnderstood) {
  struct Case {
    const char* name;
    Scan scan;
  };
  const Case cases[] = {
      {"ns",
       with_times<std::uint32_t>("t", NumberType::kU32, {0, 50'000'000, 100'000'000}, kStamp)},
      {"us", with_times<std::uint32_t>("time", NumberType::kU32, {0, 50'000, 100'000}, kStamp)},
      {"s", with_times<float>("time", NumberType::kF32, {0, 0.05F, 0.1F}, kStamp)},
      {"s double", with_times<double>("timestamp", NumberType::kF64, {0, 0.05, 0.1}, kStamp)},
      {"ms", with_times<double>("timeStamp", NumberType::kF64, {0, 50, 100}, kStamp)},
      {"absolute s", with_times<double>("timestamp", NumberType::kF64,
                                        {1.7e9, 1.7e9 + 0.05, 1.7e9 + 0.1}, kStamp)},
      {"absolute ns",
       with_times<std::uint64_t>(
           "timestamp", NumberType::kU64,
           {1'700'000'000'000'000'000, 1'700'000'000'050'000'000, 1'700'000'000'100'000'000},
           kStamp)},
      {"another clock",
       with_times<double>("timestamp", NumberType::kF64, {500.0, 500.05, 500.1}, kStamp)}};
  for (const Case& c : cases) {
    EXPECT_NEAR(static_cast<double>(c.scan.stamp - kStamp), 1e8, 300) << c.name;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(c.scan.offset_ns[i], kOffsets[i], 300) << c.name;
  }
}

TEST(PointReader, TimesBeforeTheStampAreKept) {
  const Scan scan = with_times<float>("time", NumberType::kF32, {-0.1F, -0.05F, 0}, kStamp);
  EXPECT_EQ(scan.stamp, kStamp);
  EXPECT_NEAR(scan.offset_ns[0], -100'000'000, 300);
}

TEST(PointReader, TimesOfPointsWithoutAReturnSayNothing) {
  PointLayout layout;
  for (const char* axis : {"x", "y", "z"}) layout.append(axis, NumberType::kF32);
  layout.append("t", NumberType::kU64);
  const std::uint64_t begin = static_cast<std::uint64_t>(kStamp);
  for (const std::uint64_t none : {std::uint64_t{0}, ~std::uint64_t{0}, std::uint64_t{1} << 62}) {
    Bytes bytes;
    for (const std::uint64_t time : {none, begin, begin + 50'000'000, begin + 100'000'000, none}) {
      for (int i = 0; i < 3; ++i) put(bytes, time == none ? 0.0F : 1.0F);
      put(bytes, time);
    }
    PointReader reader(layout, "made");
    Scan scan;
    ASSERT_EQ(reader.read(bytes, 1, 5, bytes.size(), kStamp, scan), "");
    EXPECT_EQ(scan.stamp, kStamp + 100'000'000);
    EXPECT_EQ(scan.offset_ns, (std::vector<std::int32_t>{0, -100'000'000, -50'000'000, 0, 0}));
  }
}

TEST(PointReader, TimesThatMakeNoScanAreNone) {
  const Scan scan = with_times<float>("time", NumberType::kF32, {0, 0, 0}, kStamp);
  EXPECT_EQ(scan.stamp, kStamp);
  EXPECT_EQ(scan.offset_ns, (std::vector<std::int32_t>{0, 0, 0}));
}

TEST(PointReader, RowsOfAnOrganisedCloudAreRingsAndNoReturnIsNaN) {
  PointLayout layout;
  for (const char* axis : {"x", "y", "z"}) layout.append(axis, NumberType::kF64);
  Bytes bytes;
  for (int row = 0; row < 2; ++row) {
    for (int i = 0; i < 6; ++i) put(bytes, row == 1 && i < 3 ? 0.0 : 2.5);
    bytes.insert(bytes.end(), 16, 0xCC);  // at the end of a row
  }
  PointReader reader(layout, "made");
  Scan scan;
  ASSERT_EQ(reader.read(bytes, 2, 2, 64, 0, scan), "");
  EXPECT_EQ(scan.ring, (std::vector<std::uint16_t>{0, 0, 1, 1}));
  EXPECT_FALSE(scan.points[2].allFinite());
  EXPECT_EQ(scan.points[3], Eigen::Vector3f(2.5F, 2.5F, 2.5F));
  EXPECT_NE(reader.read(ByteView(bytes).first(100), 2, 2, 64, 0, scan), "");
  EXPECT_NE(reader.read(bytes, 3, 2, 64, 0, scan), "");
  EXPECT_NE(reader.read(bytes, 2, 2, 10, 0, scan), "");
}

TEST(PointReader, FieldsOutsideTheRecordAreRefusedByName) {
  PointLayout layout;
  for (const char* axis : {"x", "y", "z"}) layout.append(axis, NumberType::kF32);
  layout.fields[1].offset = 9;
  try {
    PointReader reader(layout, "made");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("field y at byte 9"), std::string::npos);
  }
}

TEST(PointReader, IntensitiesAreScaledByTheFirstScansLargest) {
  PointLayout layout;
  for (const char* axis : {"x", "y", "z"}) layout.append(axis, NumberType::kF32);
  layout.append("intensity", NumberType::kU16);
  PointReader reader(layout, "made");
  for (const auto& [value, expected] :
       std::vector<std::pair<std::uint16_t, float>>{{200, 200.0F / 255}, {1000, 1}}) {
    Bytes bytes;
    for (int i = 0; i < 3; ++i) put(bytes, 1.0F);
    put(bytes, value);
    Scan scan;
    ASSERT_EQ(reader.read(bytes, 1, 1, bytes.size(), 0, scan), "");
    EXPECT_FLOAT_EQ(scan.reflectivity[0], expected);
  }
}

TEST(PointReader, ReflectivitiesAreNeverBelowZeroNorNaN) {
  PointLayout layout;
  for (const char* field : {"x", "y", "z", "intensity"}) layout.append(field, NumberType::kF32);
  Bytes bytes;
  for (const float intensity : {-5.0F, static_cast<float>(NAN), 0.0F}) {
    for (const float value : {1.0F, 2.0F, 3.0F, intensity}) put(bytes, value);
  }
  PointReader reader(layout, "made");
  Scan scan;
  ASSERT_EQ(reader.read(bytes, 1, 3, bytes.size(), 0, scan), "");
  EXPECT_EQ(scan.reflectivity, (std::vector<float>{0, 0, 0}));
}

}  // namespace
}  // namespace saker::lidar
