#include "saker/lidar/bags/topic_choice.h"

#include <gtest/gtest.h>

#include "saker/core/error.h"

namespace saker::lidar {
namespace {

constexpr Encoding kRos1 = Encoding::kRos1;

Topic cloud(const std::string& name, long messages = 5) {
  return {name, "sensor_msgs/PointCloud2", kRos1, messages};
}
Topic imu(const std::string& name) { return {name, "sensor_msgs/Imu", kRos1, 50}; }
Topic packets(const std::string& name) { return {name, "ouster_ros/PacketMsg", kRos1, 100}; }

TEST(TopicChoice, TheOnlyCloudsAreTaken) {
  const TopicChoice choice =
      choose_topics({{"/odom", "nav_msgs/Odometry", kRos1, 9}, cloud("/a")}, {}, "");
  EXPECT_EQ(choice.kind, ScanMessage::kPointCloud2);
  EXPECT_EQ(choice.scans, std::vector<std::size_t>{1});
  EXPECT_LT(choice.imu, 0);
}

TEST(TopicChoice, TopicsWithoutAMessageDoNotCount) {
  EXPECT_EQ(choose_topics({cloud("/empty", 0), cloud("/full")}, {}, "").name, "/full");
  EXPECT_EQ(choose_topics({cloud("/empty", 0)}, {}, "").name, "/empty");
}

TEST(TopicChoice, OfSeveralInertialUnitsTheOneNamedLikeTheScansIsTaken) {
  const std::vector<Topic> topics = {imu("/camera/imu"), cloud("/lidar/points"), imu("/lidar/imu")};
  EXPECT_EQ(choose_topics(topics, {}, "").imu_name, "/lidar/imu");
  EXPECT_EQ(choose_topics(topics, {"/camera/imu"}, "").imu_name, "/camera/imu");
}

TEST(TopicChoice, PacketsOfOneSensorAreOneChoiceAndOfTwoAreTwo) {
  const std::vector<Topic> one = {packets("/a/imu_packets"), packets("/a/lidar_packets")};
  const TopicChoice choice = choose_topics(one, {}, "");
  EXPECT_EQ(choice.kind, ScanMessage::kOusterPackets);
  EXPECT_EQ(choice.scans, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(choice.name, "/a/lidar_packets");
  const std::vector<Topic> two = {packets("/a/lidar_packets"), packets("/b/lidar_packets")};
  EXPECT_THROW((void)choose_topics(two, {}, ""), Error);
  EXPECT_EQ(choose_topics(two, {"/b/lidar_packets"}, "").scans, std::vector<std::size_t>{1});
}

TEST(TopicChoice, CloudsInAnEncodingThatIsNotReadAreNone) {
  Topic topic = cloud("/a");
  topic.encoding = Encoding::kOther;
  EXPECT_THROW((void)choose_topics({topic}, {}, ""), Error);
}

TEST(TopicChoice, StaticTransformsAreToldByTypeAndName) {
  EXPECT_TRUE(is_static_transform({"/tf_static", "tf2_msgs/TFMessage", kRos1, 1}));
  EXPECT_FALSE(is_static_transform({"/tf", "tf2_msgs/TFMessage", kRos1, 1}));
  EXPECT_FALSE(is_static_transform({"/tf_static", "std_msgs/String", kRos1, 1}));
}

}  // namespace
}  // namespace saker::lidar
