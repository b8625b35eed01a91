#include "flight/ground/publisher.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <random>

#include "flight_viewers/made_robot.h"
#include "flight_viewers/scratch_folder.h"
#include "saker/core/error.h"
#include "saker/lidar/bags/mcap_file.h"

namespace saker::flight::ground {
namespace {

using namespace viewers::testing;
using flight::testing::ScratchFolder;
using viewers::RobotViews;
using viewers::Topic;

/// A publisher to a hub with one client, and the robots that it publishes.
struct PublisherTest : ::testing::Test {
  PublisherTest() { static_cast<void>(take()); }

  [[nodiscard]] std::vector<std::string> take() {
    std::vector<std::string> all;
    while (const auto next = hub.take(client, now)) all.push_back(*next->body);
    return all;
  }
  /// {topic: id} of channels that are made known to the client.
  std::map<std::string, std::uint64_t> advertised() {
    std::map<std::string, std::uint64_t> found;
    for (const std::string& text : take()) {
      const Json json = Json::parse(text, nullptr, false);
      if (!json.is_object() || json.value("op", "") != "advertise") continue;
      for (const Json& channel : json["channels"]) found[channel["topic"]] = channel["id"];
    }
    return found;
  }
  void subscribe(std::uint64_t channel) {
    const std::string text =
        Json({{"op", "subscribe"}, {"subscriptions", {{{"id", channel}, {"channelId", channel}}}}})
            .dump();
    EXPECT_TRUE(hub.hear(client, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                         false, now));
  }

  Hub::Steady::time_point now = Hub::Steady::now();
  Hub hub{{.mode = "live", .version = "1", .session = "s", .begin = {}, .end = {}}};
  Hub::SessionId client = hub.open("", false, now);
  RobotViews views{made_site(), 1.5};
};

TEST(ViewersTime, IsInNanosecondsToTheMicrosecond) {
  EXPECT_EQ(viewers_time(0), 0);
  EXPECT_EQ(viewers_time(1.5), 1500000000);
  EXPECT_EQ(viewers_time(-2), -2000000000);
  EXPECT_EQ(viewers_time(0.0000014), 1000);
  EXPECT_EQ(viewers_time(1700000000.123456), 1700000000123456000);  // a system clock's
}

TEST_F(PublisherTest, ARobotsTopicsAreMadeKnownTogetherAndOnce) {
  Publisher publisher(hub, nullptr, true);
  publisher.publish_due(views, 1);
  EXPECT_TRUE(advertised().empty());
  views.of("R1")->hear(made_state(), 1);
  publisher.publish_due(views, 1);
  const auto channels = advertised();
  EXPECT_EQ(channels.size(), static_cast<std::size_t>(viewers::kTopics) - 1);
  EXPECT_TRUE(channels.contains("/R1/objects"));
  publisher.publish_due(views, 2);
  EXPECT_TRUE(advertised().empty());
}

TEST_F(PublisherTest, LiveThereAreNoFigures) {
  Publisher publisher(hub, nullptr, true);
  views.of("R1");
  publisher.publish_due(views, 1);
  const auto channels = advertised();
  EXPECT_TRUE(channels.contains("/R1/link"));
  EXPECT_TRUE(channels.contains("/R1/orders"));
  EXPECT_FALSE(channels.contains("/R1/figures"));
}

TEST_F(PublisherTest, ARunHasNeitherLinkNorOrders) {
  Publisher publisher(hub, nullptr, false);
  views.of("R1");
  publisher.publish_due(views, 1);
  const auto channels = advertised();
  EXPECT_FALSE(channels.contains("/R1/link"));
  EXPECT_FALSE(channels.contains("/R1/orders"));
  EXPECT_TRUE(channels.contains("/R1/figures"));
}

TEST_F(PublisherTest, WhatARobotSaysGoesToItsChannelWithItsTime) {
  Publisher publisher(hub, nullptr, true);
  views.of("R1");
  views.of("R2")->hear(made_state(), 4);
  publisher.publish_due(views, 4);
  const auto channels = advertised();
  subscribe(channels.at("/R2/state"));
  const auto next = hub.take(client, now);
  ASSERT_TRUE(next);
  EXPECT_EQ(Json::parse(*next->body)["mode"], "guided");
  EXPECT_EQ(next->head,
            message_head(static_cast<std::uint32_t>(channels.at("/R2/state")), 4000000000));
  subscribe(channels.at("/R1/state"));
  EXPECT_TRUE(take().empty());
}

TEST_F(PublisherTest, AHeavyTopicIsMadeForThoseWhoWantIt) {
  Publisher publisher(hub, nullptr, true);
  views.of("R1")->hear(made_scan(100), 1);
  publisher.publish_due(views, 1);
  const auto channels = advertised();
  EXPECT_FALSE(publisher.wanted(Topic::points));
  subscribe(channels.at("/R1/points"));
  EXPECT_TRUE(take().empty());  // nothing was made before
  EXPECT_TRUE(publisher.wanted(Topic::points));
  EXPECT_FALSE(publisher.wanted(Topic::occupancy));
  publisher.publish_due(views, 2);
  ASSERT_EQ(take().size(), 1u);
  hub.close(client);
  EXPECT_FALSE(publisher.wanted(Topic::points));
}

TEST_F(PublisherTest, ARecordingWantsEverything) {
  const ScratchFolder folder;
  viewers::Recording recording(folder / "a.mcap");
  const Publisher publisher(hub, &recording, true);
  for (int i = 0; i < viewers::kTopics; ++i)
    EXPECT_TRUE(publisher.wanted(static_cast<Topic>(i))) << i;
}

TEST_F(PublisherTest, ARecordingHoldsWhatWasSaid) {
  const ScratchFolder folder;
  viewers::Recording recording(folder / "a.mcap");
  Publisher publisher(hub, &recording, true);
  for (int i = 0; i < 10; ++i) {
    views.of("R1")->hear(made_state(), 1 + i);
    views.of("R1")->hear(made_scan(10), 1 + i);
    publisher.publish_due(views, 1 + i);
  }
  recording.finish();
  const lidar::McapFile file(folder / "a.mcap");
  std::map<std::string, long> counted;
  for (const lidar::Topic& topic : file.topics()) counted[topic.name] = topic.messages;
  EXPECT_EQ(counted["/R1/state"], 10);
  EXPECT_EQ(counted["/R1/scan"], 10);
  EXPECT_EQ(counted["/R1/points"], 10);
}

/// Files of this process end at so many bytes, as on a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

/// Letters that zstd cannot make much shorter.
std::string noise(std::size_t size) {
  static std::mt19937 random(1);
  std::string text;
  for (std::size_t i = 0; i < size; ++i) text += static_cast<char>('!' + random() % 90);
  return text;
}

TEST_F(PublisherTest, AFullDiskEndsTheRecordingAndNobodyElse) {
  const ScratchFolder folder;
  viewers::Recording recording(folder / "a.mcap");
  Publisher publisher(hub, &recording, true);
  views.of("R1")->hear(made_state(), 1);
  publisher.publish_due(views, 1);
  const std::uint64_t log = advertised().at("/R1/log");
  subscribe(log);
  {
    const FullDisk full(4096);
    for (int i = 0; i < 300; ++i)
      views.of("R1")->log(viewers::LogLevel::info, noise(8000), 2);  // more than a chunk
    EXPECT_NO_THROW(publisher.publish_due(views, 2));
  }
  EXPECT_GT(take().size(), 100u);                    // the client gets them
  EXPECT_FALSE(publisher.wanted(Topic::occupancy));  // the recording wants no more
  EXPECT_THROW(recording.finish(), Error);           // a file with a hole is none
  EXPECT_FALSE(std::filesystem::exists(folder / "a.mcap"));
}

}  // namespace
}  // namespace saker::flight::ground
