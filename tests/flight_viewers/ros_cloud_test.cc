#include "flight/viewers/ros_cloud.h"

#include <gtest/gtest.h>

#include <cstring>

#include "flight_viewers/made_robot.h"

namespace saker::flight::viewers {
namespace {

using namespace testing;

/// Reads CDR, little endian, as the OMG's specification has it: numbers at multiples of their size
/// after the head of four bytes.
class Cdr {
 public:
  explicit Cdr(const std::string& bytes) : bytes_(bytes) {}

  std::uint32_t number() {
    at_ = (at_ + 3) / 4 * 4;
    std::uint32_t value = 0;
    std::memcpy(&value, bytes_.data() + 4 + at_, 4);
    at_ += 4;
    return value;
  }
  float real() {
    const std::uint32_t bits = number();
    float value = 0;
    std::memcpy(&value, &bits, 4);
    return value;
  }
  std::uint8_t byte() { return static_cast<std::uint8_t>(bytes_.at(4 + at_++)); }
  std::string text() {
    const std::uint32_t size = number();
    const std::string value = bytes_.substr(4 + at_, size);
    at_ += size;
    return value;
  }
  /// Bytes as they lie there, without alignment.
  std::string bytes(std::size_t size) {
    const std::string value = bytes_.substr(4 + at_, size);
    at_ += size;
    return value;
  }
  [[nodiscard]] bool over() const { return 4 + at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

/// What a cloud says before its points.
struct Head {
  std::uint32_t sec, nanosec, width, step, row, data;
};

Head head(Cdr& cdr, const std::string& frame) {
  Head h{};
  h.sec = cdr.number();
  h.nanosec = cdr.number();
  EXPECT_EQ(cdr.text(), frame + '\0');
  EXPECT_EQ(cdr.number(), 1u);  // height
  h.width = cdr.number();
  EXPECT_EQ(cdr.number(), 4u);  // fields
  std::uint32_t offset = 0;
  for (const std::string name : {"x", "y", "z", "intensity"}) {
    EXPECT_EQ(cdr.text(), name + '\0');
    EXPECT_EQ(cdr.number(), offset);
    EXPECT_EQ(cdr.byte(), 7);  // FLOAT32
    EXPECT_EQ(cdr.number(), 1u);
    offset += 4;
  }
  EXPECT_EQ(cdr.byte(), 0);  // little endian
  h.step = cdr.number();
  h.row = cdr.number();
  h.data = cdr.number();
  return h;
}

std::vector<float> points(Cdr& cdr, std::size_t count) {
  const std::string bytes = cdr.bytes(16 * count);
  std::vector<float> values(4 * count);
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

TEST(RosCloud, IsAPointCloud2WhateverTheLengthOfItsFrame) {
  for (const std::string frame : {"", "a", "ab", "abc", "R1/lidar"}) {
    Cdr cdr(ros_cloud(made_scan(3), frame));
    const Head h = head(cdr, frame);
    EXPECT_EQ(h.sec, 7u);
    EXPECT_EQ(h.nanosec, 0u);
    EXPECT_EQ(h.width, 3u);
    EXPECT_EQ(h.step, 16u);
    EXPECT_EQ(h.row, 48u);
    EXPECT_EQ(h.data, 48u);
    const std::vector<float> xyzi = points(cdr, 3);
    EXPECT_FLOAT_EQ(xyzi[4], 1.001f);
    EXPECT_EQ(xyzi[5], 2);
    EXPECT_EQ(xyzi[7], 1);
    EXPECT_EQ(cdr.byte(), 1);  // dense
    EXPECT_TRUE(cdr.over());
  }
}

TEST(RosCloud, BeginsWithTheHeadOfLittleEndianCdr) {
  EXPECT_EQ(ros_cloud(made_scan(1), "a").substr(0, 4), std::string("\0\1\0\0", 4));
}

TEST(RosCloud, BeamsWithoutAnAnswerAreLeftOut) {
  auto scan = made_scan(3);
  auto cloud = std::make_shared<std::vector<Eigen::Vector3f>>(*scan.points);
  (*cloud)[1] = {200, 0, 0};
  scan.points = cloud;
  Cdr cdr(ros_cloud(scan, "a"));
  const Head h = head(cdr, "a");
  EXPECT_EQ(h.width, 2u);
  EXPECT_EQ(h.data, 32u);
  EXPECT_FLOAT_EQ(points(cdr, 2)[4], 1.002f);
}

TEST(RosCloud, WithoutReflectivityTheIntensityIsZero) {
  auto scan = made_scan(2);
  scan.reflectivity = nullptr;
  Cdr cdr(ros_cloud(scan, "a"));
  static_cast<void>(head(cdr, "a"));
  const std::vector<float> xyzi = points(cdr, 2);
  EXPECT_EQ(xyzi[3], 0);
  EXPECT_EQ(xyzi[7], 0);
}

TEST(RosCloud, ReflectivityOfAnotherNumberOfPointsIsNone) {
  auto scan = made_scan(2);
  scan.reflectivity = std::make_shared<std::vector<float>>(1, 1.0f);
  Cdr cdr(ros_cloud(scan, "a"));
  static_cast<void>(head(cdr, "a"));
  EXPECT_EQ(points(cdr, 2)[3], 0);
}

TEST(RosCloud, AStampKeepsItsNanoseconds) {
  auto scan = made_scan(0);
  scan.stamp = 1700000000123456789;
  Cdr cdr(ros_cloud(scan, "a"));
  const Head h = head(cdr, "a");
  EXPECT_EQ(h.sec, 1700000000u);
  EXPECT_EQ(h.nanosec, 123456789u);
  EXPECT_EQ(h.width, 0u);
}

/// 2 beams of 2 columns, 10 ms apart; the second beam of the first column has no return.
lidar::Scan made_sensed() {
  lidar::Scan scan;
  scan.stamp = 7 * kNanosecondsPerSecond;
  scan.rows = scan.columns = 2;
  scan.points = {{1, 0, 0}, {2, 0, 0}, {NAN, NAN, NAN}, {4, 0, 0}};
  scan.reflectivity = {0.25f, 0.5f, 0, 1};
  scan.offset_ns = {-10'000'000, 0, -10'000'000, 0};
  return scan;
}

struct SensedHead {
  std::uint32_t sec, nanosec, width, step;
  std::vector<std::string> fields;
};

SensedHead sensed_head(Cdr& cdr) {
  SensedHead h{};
  h.sec = cdr.number();
  h.nanosec = cdr.number();
  static_cast<void>(cdr.text());
  static_cast<void>(cdr.number());  // height
  h.width = cdr.number();
  for (std::uint32_t left = cdr.number(); left > 0; --left) {
    h.fields.push_back(cdr.text());
    h.fields.back().pop_back();
    static_cast<void>(cdr.number());
    static_cast<void>(cdr.byte());
    static_cast<void>(cdr.number());
  }
  static_cast<void>(cdr.byte());
  h.step = cdr.number();
  static_cast<void>(cdr.number());
  EXPECT_EQ(cdr.number(), h.width * h.step);
  return h;
}

TEST(RosCloud, OfASensedScanTheStampIsTheFirstPointsTime) {
  Cdr cdr(ros_cloud(made_sensed(), "a"));
  const SensedHead h = sensed_head(cdr);
  EXPECT_EQ(h.sec, 6u);
  EXPECT_EQ(h.nanosec, 990'000'000u);
  EXPECT_EQ(h.width, 3u);
  EXPECT_EQ(h.fields, (std::vector<std::string>{"x", "y", "z", "intensity", "t", "ring"}));
  EXPECT_EQ(h.step, 22u);
}

TEST(RosCloud, EachPointOfASensedScanHasItsTimeAndBeam) {
  Cdr cdr(ros_cloud(made_sensed(), "a"));
  const SensedHead h = sensed_head(cdr);
  const std::string data = cdr.bytes(h.width * h.step);
  const auto at = [&](std::size_t point, std::size_t offset, auto value) {
    std::memcpy(&value, data.data() + 22 * point + offset, sizeof(value));
    return value;
  };
  EXPECT_EQ(at(2, 0, 0.0f), 4);
  EXPECT_EQ(at(1, 12, 0.0f), 0.5f);
  EXPECT_EQ(at(0, 16, std::uint32_t{0}), 0u);
  EXPECT_EQ(at(2, 16, std::uint32_t{0}), 10'000'000u);
  EXPECT_EQ(at(0, 20, std::uint16_t{0}), 0);
  EXPECT_EQ(at(2, 20, std::uint16_t{0}), 1);
  EXPECT_EQ(cdr.byte(), 1);
  EXPECT_TRUE(cdr.over());
}

TEST(RosCloud, AScanWhoseBeamsAreNotKnownHasNoRing) {
  lidar::Scan scan = made_sensed();
  scan.rows = scan.columns = 0;
  Cdr cdr(ros_cloud(scan, "a"));
  const SensedHead h = sensed_head(cdr);
  EXPECT_EQ(h.fields.back(), "t");
  EXPECT_EQ(h.step, 20u);
}

}  // namespace
}  // namespace saker::flight::viewers
