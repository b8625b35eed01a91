#include <gtest/gtest.h>

#include "flight/bus/bus.h"
#include "flight/bus/mailbox.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;

verdict_t verdict(std::int64_t id) {
  verdict_t message{};
  message.trajectory_id = id;
  return message;
}

TEST(BusInMemory, HandsOverWhatWasPublished) {
  Bus bus = Bus::in_memory("R1");
  Mailbox<verdict_t> box;
  bus.subscribe<verdict_t>([&](const verdict_t& message) {
    box.put(message);
    return true;
  });
  EXPECT_TRUE(bus.publish(verdict(5)));
  EXPECT_EQ(bus.handle(milliseconds(100)), 1);
  EXPECT_EQ(box.take()->trajectory_id, 5);
}

TEST(BusInMemory, HandlesAllThatIsThereInItsOrder) {
  Bus bus = Bus::in_memory("R1");
  std::vector<std::int64_t> heard;
  bus.subscribe<verdict_t>([&](const verdict_t& message) {
    heard.push_back(message.trajectory_id);
    return true;
  });
  for (const int id : {1, 2, 3}) bus.publish(verdict(id));
  EXPECT_EQ(bus.handle(milliseconds(100)), 3);
  EXPECT_EQ(heard, (std::vector<std::int64_t>{1, 2, 3}));
}

TEST(BusInMemory, WaitsNoLongerThanAsked) {
  Bus bus = Bus::in_memory("R1");
  EXPECT_EQ(bus.handle(milliseconds(1)), 0);
}

TEST(BusInMemory, CarriesBulkChannelsToo) {
  Bus bus = Bus::in_memory("R1");
  int chunks = 0;
  bus.subscribe<scan_t>([&](const scan_t&) { return ++chunks > 0; });
  bus.publish(scan_t{});
  bus.handle(milliseconds(100));
  EXPECT_EQ(chunks, 1);
}

TEST(BusInMemory, HandsOverTheMessagesOfEveryRobotWithItsName) {
  Bus bus = Bus::in_memory("BASE");
  std::vector<std::string> heard;
  bus.subscribe_all<verdict_t>([&](const std::string& robot, const verdict_t& message) {
    heard.push_back(robot + std::to_string(message.trajectory_id));
    return true;
  });
  bus.publish_as("R1", verdict(1));
  bus.publish_as("DRONE7", verdict(2));
  bus.publish_as("r1", verdict(3));  // no name of a robot
  bus.publish_as("R1_X", verdict(4));
  bus.handle(milliseconds(100));
  EXPECT_EQ(heard, (std::vector<std::string>{"R11", "DRONE72"}));
}

TEST(BusInMemory, HandsOverBytesAsTheyAre) {
  Bus bus = Bus::in_memory("BASE");
  std::vector<std::uint8_t> heard;
  bus.subscribe_raw("_ANYTHING", [&](const std::string& channel, Bus::Bytes bytes) {
    heard.assign(bytes.begin(), bytes.end());
    return channel == "R1_ANYTHING";
  });
  const std::vector<std::uint8_t> said = {0, 255, 0, 1};
  EXPECT_TRUE(bus.publish_raw("R1_ANYTHING", said));
  bus.handle(milliseconds(100));
  EXPECT_EQ(heard, said);
}

TEST(BusInMemory, SeveralAreHandledAtOnce) {
  Bus first = Bus::in_memory("R1"), second = Bus::in_memory("R1");
  int heard = 0;
  for (Bus* const bus : {&first, &second})
    bus->subscribe<verdict_t>([&](const verdict_t&) { return ++heard > 0; });
  first.publish(verdict(1));
  second.publish(verdict(2));
  EXPECT_EQ(Bus::handle({&first, nullptr, &second}, milliseconds(100)), 2);
  EXPECT_EQ(heard, 2);
}

TEST(BusInMemory, CountsWhatAHandlerRefuses) {
  Bus bus = Bus::in_memory("R1");
  bus.subscribe<verdict_t>([](const verdict_t& message) { return message.trajectory_id > 0; });
  bus.publish(verdict(0));
  bus.publish(verdict(1));
  bus.handle(milliseconds(100));
  const auto counters = bus.counters();
  ASSERT_EQ(counters.size(), 1u);
  EXPECT_EQ(counters[0].channel, "R1_VERDICT");
  EXPECT_EQ(counters[0].received, 2);
  EXPECT_EQ(counters[0].refused, 1);
  EXPECT_EQ(counters[0].malformed, 0);
}

TEST(BusInMemory, AHandlerThatThrowsDoesNotEndTheLoop) {
  Bus bus = Bus::in_memory("R1");
  bus.subscribe<verdict_t>([](const verdict_t&) -> bool { throw std::bad_alloc(); });
  bus.publish(verdict(1));
  EXPECT_EQ(bus.handle(milliseconds(100)), 1);
  EXPECT_EQ(bus.counters()[0].malformed, 1);
}

TEST(Bus, RefusesANameThatIsNoneOfARobot) {
  for (const char* name : {"", "r1", "R-1", "1R", "R1_STATE", "ABCDEFGHIJKLMNOPQ"}) {
    EXPECT_THROW((void)Bus::in_memory(name), Error) << name;
  }
}

TEST(Bus, RefusesAUrlThatIsNoMulticastGroup) {
  for (const char* url : {"", "udpm://", "udpm://10.0.0.1:7667", "udpm://239.255.76.67:0",
                          "udpm://239.255.76.67:70000", "memq://", "udpm://239.255.76.678:7667"}) {
    BusConfig config;
    config.control_url = url;
    EXPECT_THROW(Bus(config, "R1"), Error) << url;
  }
}

}  // namespace
}  // namespace saker::flight
