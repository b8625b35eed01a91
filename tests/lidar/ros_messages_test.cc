#include "saker/lidar/bags/ros_messages.h"

#include <gtest/gtest.h>

#include <cmath>

#include "made_messages.h"
#include "saker/core/rng.h"

namespace saker::lidar {
namespace {

using testing::MessageWriter;
using Bytes = std::vector<std::uint8_t>;

TEST(RosMessages, InertialSamplesReadTheSameInEveryEncoding) {
  for (const Encoding encoding : {Encoding::kRos1, Encoding::kCdr}) {
    for (const char* frame : {"imu", "a", "longer_name"}) {  // moves what is aligned behind it
      const auto imu = read_imu(
          testing::made_imu(5'000'000'007, {1, 2, 3}, {4, 5, 6}, encoding, frame), encoding);
      ASSERT_TRUE(imu);
      EXPECT_EQ(imu->header.stamp, 5'000'000'007);
      EXPECT_EQ(imu->header.frame, frame);
      EXPECT_EQ(imu->acceleration, Eigen::Vector3d(1, 2, 3));
      EXPECT_EQ(imu->angular_velocity, Eigen::Vector3d(4, 5, 6));
    }
  }
}

TEST(RosMessages, BigEndianCdrIsRead) {
  MessageWriter writer(Encoding::kCdr, true);
  writer.text("hello");
  const auto text = read_string(writer.done(), Encoding::kCdr);
  ASSERT_TRUE(text);
  EXPECT_EQ(*text, "hello");
}

TEST(RosMessages, CloudsKeepTheirFieldsAndPadding) {
  const auto bytes = testing::made_cloud({{1, 2, 3, 4, 5, 6}}, 9, Encoding::kCdr);
  const auto cloud = read_point_cloud2(bytes, Encoding::kCdr);
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->layout.names(), "x y z intensity t ring");
  EXPECT_EQ(cloud->layout.step, 32U);
  EXPECT_EQ(cloud->columns, 1U);
  EXPECT_EQ(cloud->data.size(), 32U);
}

/// Livox's message of three points, written apart from the reader.
Bytes made_livox(Encoding encoding) {
  MessageWriter writer(encoding);
  writer.header(1'000'000'000, "livox");
  writer.number(std::uint64_t{1'000'000'000});
  writer.number(std::uint32_t{3});
  for (int i = 0; i < 4; ++i) writer.number(std::uint8_t{0});
  writer.number(std::uint32_t{3});
  for (std::uint32_t i = 0; i < 3; ++i) {
    writer.number(i * 40'000'000U);
    for (int k = 0; k < 3; ++k) writer.number(static_cast<float>(i + 1) * 2.0F);
    writer.number(static_cast<std::uint8_t>(100 + i));
    writer.number(std::uint8_t{0});
    writer.number(static_cast<std::uint8_t>(i));
  }
  return writer.done();
}

TEST(RosMessages, LivoxPointsBecomeACloud) {
  for (const Encoding encoding : {Encoding::kRos1, Encoding::kCdr}) {
    const Bytes bytes = made_livox(encoding);
    const auto cloud = read_livox(bytes, encoding);
    ASSERT_TRUE(cloud);
    PointReader reader(cloud->layout, "livox");
    Scan scan;
    ASSERT_EQ(reader.read(cloud->data, cloud->rows, cloud->columns, cloud->row_step,
                          cloud->header.stamp, scan),
              "");
    EXPECT_EQ(scan.stamp, 1'080'000'000);
    EXPECT_EQ(scan.offset_ns, (std::vector<std::int32_t>{-80'000'000, -40'000'000, 0}));
    EXPECT_EQ(scan.points[2], Eigen::Vector3f(6, 6, 6));
    EXPECT_EQ(scan.ring, (std::vector<std::uint16_t>{0, 1, 2}));
  }
}

TEST(RosMessages, CutOrDamagedBytesGiveNothingOrWhatIsThere) {
  core::Rng rng(5);
  for (const Encoding encoding : {Encoding::kRos1, Encoding::kCdr}) {
    const std::vector<Bytes> messages = {
        testing::made_cloud({{1, 2, 3, 4, 5, 6}, {1, 2, 3, 4, 5, 6}}, 9, encoding),
        testing::made_imu(1, {1, 2, 3}, {1, 2, 3}, encoding), made_livox(encoding),
        testing::made_quarter_turn("a", "b", encoding)};
    for (const Bytes& whole : messages) {
      for (std::size_t size = 0; size <= whole.size(); ++size) {
        Bytes bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        if (size > 8 && size == whole.size()) {
          bytes[static_cast<std::size_t>(rng.index(static_cast<int>(size)))] ^= 0xFF;
        }
        (void)read_point_cloud2(bytes, encoding);
        (void)read_imu(bytes, encoding);
        (void)read_livox(bytes, encoding);
        (void)read_transforms(bytes, encoding);
        (void)read_packet(bytes, encoding);
      }
    }
    EXPECT_FALSE(read_imu(Bytes(100, 0), encoding));
  }
}

TEST(RosMessages, TransformsAreFollowedBothWays) {
  TransformMessage base_lidar{"base", "lidar", Eigen::Isometry3d::Identity()};
  base_lidar.T_parent_child.translation() = Eigen::Vector3d(1, 0, 0);
  TransformMessage base_imu{"base", "imu", Eigen::Isometry3d::Identity()};
  base_imu.T_parent_child.translation() = Eigen::Vector3d(0, 2, 0);
  const auto T = find_transform({base_lidar, base_imu}, "lidar", "imu");
  ASSERT_TRUE(T);
  EXPECT_TRUE(T->translation().isApprox(Eigen::Vector3d(-1, 2, 0)));
  EXPECT_FALSE(find_transform({base_lidar}, "lidar", "imu"));
}

TEST(RosMessages, TransformsThatAreNoTurnsAreLeftOut) {
  for (const double bad : {static_cast<double>(NAN), 0.0, 2.0}) {
    testing::MessageWriter writer(Encoding::kRos1);
    writer.number(std::uint32_t{1});
    writer.header(0, "lidar");
    writer.text("imu");
    writer.vector({1, 2, 3});
    for (const double q : {0.0, 0.0, 0.0, bad}) writer.number(q);
    EXPECT_TRUE(read_transforms(writer.done(), Encoding::kRos1).empty()) << bad;
  }
}

TEST(RosMessages, ALengthThatTheBytesCannotHoldTakesNoMemory) {
  testing::MessageWriter writer(Encoding::kRos1);
  writer.header(0, "livox");
  writer.number(std::uint64_t{0});
  writer.number(std::uint32_t{0});
  for (int i = 0; i < 4; ++i) writer.number(std::uint8_t{0});
  writer.number(std::uint32_t{1000});
  Bytes bytes = writer.done();
  bytes.resize(bytes.size() + 1000 * 18);  // a byte less than a point has
  EXPECT_FALSE(read_livox(bytes, Encoding::kRos1));
  bytes.resize(bytes.size() + 1000);
  EXPECT_TRUE(read_livox(bytes, Encoding::kRos1));
}

TEST(RosMessages, NamesOfFieldsStayInTheirLine) {
  testing::MessageWriter writer(Encoding::kRos1);
  writer.header(0, "lidar");
  for (const std::uint32_t number : {1U, 1U, 1U}) writer.number(number);
  writer.text("x\n\x1B[2J");
  writer.number(std::uint32_t{0});
  writer.number(std::uint8_t{7});
  writer.number(std::uint32_t{1});
  writer.number(std::uint8_t{0});
  for (const std::uint32_t number : {4U, 4U}) writer.number(number);
  writer.bytes(Bytes(4, 0));
  const auto cloud = read_point_cloud2(writer.done(), Encoding::kRos1);
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->layout.names(), "x??[2J");
}

}  // namespace
}  // namespace saker::lidar
