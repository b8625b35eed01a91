#include "saker/odometry/imu_buffer.h"

#include <gtest/gtest.h>

namespace saker::odometry {
namespace {

std::vector<lidar::ImuSample> at(const std::vector<Time>& stamps) {
  std::vector<lidar::ImuSample> samples;
  for (const Time stamp : stamps) samples.push_back({stamp});
  return samples;
}

std::vector<Time> stamps(const ImuBuffer& buffer) {
  std::vector<Time> stamps;
  for (const lidar::ImuSample& sample : buffer.samples()) stamps.push_back(sample.stamp);
  return stamps;
}

TEST(ImuBuffer, KeepsTheOrderOfTimeWhateverComesTwiceOrLate) {
  ImuBuffer buffer;
  buffer.add(at({1, 3, 2, 3, 5}), 0);
  buffer.add(at({4, 5, 6}), 0);
  EXPECT_EQ(stamps(buffer), (std::vector<Time>{1, 3, 5, 6}));
}

TEST(ImuBuffer, DropsWhatIsOlderThanAsked) {
  ImuBuffer buffer;
  buffer.add(at({1, 2, 3, 4}), 0);
  buffer.add(at({5}), 3);
  EXPECT_EQ(stamps(buffer), (std::vector<Time>{3, 4, 5}));
  buffer.add(at({6, 7, 8}), 8);
  EXPECT_EQ(stamps(buffer), (std::vector<Time>{8}));
}

TEST(ImuBuffer, HoldsAtMostItsCeiling) {
  ImuBuffer buffer;
  std::vector<Time> many;
  for (Time stamp = 0; stamp < 10000; ++stamp) many.push_back(stamp);
  buffer.add(at(many), 0);
  EXPECT_EQ(buffer.samples().size(), ImuBuffer::kMost);
  buffer.add(at({20000}), 5000);
  EXPECT_EQ(stamps(buffer).front(), 5000);
  EXPECT_EQ(stamps(buffer).back(), 20000);
}

TEST(ImuBuffer, OfNothingIsEmpty) {
  ImuBuffer buffer;
  buffer.add({}, 0);
  EXPECT_TRUE(buffer.samples().empty());
}

}  // namespace
}  // namespace saker::odometry
