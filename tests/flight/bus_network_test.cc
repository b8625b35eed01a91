#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <thread>

#include "flight/bus/machine.h"
#include "flight/bus/messages.h"
#include "flight/bus/multicast.h"
#include "flight/bus/occupancy_messages.h"
#include "flight/bus/presence.h"
#include "flight/bus/scan_messages.h"
#include "saker/core/error.h"

// Real LCM over UDP. Runs by tests/flight/in_namespace.sh, which sets SAKER_NAMESPACE to whether
// there is a route.
namespace saker::flight {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class Network : public testing::TestWithParam<const char*> {
 protected:
  void require(const std::string& route) {
    const char* here = std::getenv("SAKER_NAMESPACE");
    if (!here || here != route) GTEST_SKIP() << "runs in a namespace, route: " << route;
  }
};

class WithRoute : public Network {
 protected:
  void SetUp() override { require("yes"); }
};

class WithoutRoute : public Network {
 protected:
  void SetUp() override { require("no"); }
};

/// Handles both until `done` or two seconds are over.
void handle_until(Bus& bus, const std::function<bool()>& done) {
  const auto end = steady_clock::now() + std::chrono::seconds(2);
  while (!done() && steady_clock::now() < end) bus.handle(milliseconds(20));
}

TEST_F(WithoutRoute, TheBusSaysSoAndNamesTheCommand) {
  const std::string line = message_of([] { Bus(BusConfig{}, "R1"); });
  EXPECT_NE(line.find("no multicast to 239.255.76.67"), std::string::npos) << line;
  EXPECT_NE(line.find("ip route add 239.255.76.67/32 dev lo"), std::string::npos) << line;
  EXPECT_EQ(line.find('\n'), std::string::npos);
}

TEST_F(WithoutRoute, TheMachineIsGrounded) {
  EXPECT_EQ(check_multicast("multicast route", BusConfig{}.control_url).weight, Weight::grounding);
}

TEST_F(WithRoute, TheRouteIsFine) {
  EXPECT_EQ(check_multicast("multicast route", BusConfig{}.control_url).weight, Weight::fine);
}

TEST_F(WithRoute, BuffersThatAreNotGrantedAreRefusedWithTheCommand) {
  BusConfig config;
  config.receive_buffer_kb = 1 << 20;
  const std::string line = message_of([&] { Bus(config, "R1"); });
  EXPECT_NE(line.find("sysctl -w net.core.rmem_max=1073741824"), std::string::npos) << line;
}

TEST_F(WithRoute, AMessageOfOneProcessReachesAnother) {
  Bus sender(BusConfig{}, "R1"), receiver(BusConfig{}, "R1"), stranger(BusConfig{}, "R2");
  std::atomic<int> heard = 0, overheard = 0;
  receiver.subscribe<setpoint_t>([&](const setpoint_t&) { return ++heard > 0; });
  stranger.subscribe<setpoint_t>([&](const setpoint_t&) { return ++overheard > 0; });
  EXPECT_TRUE(sender.publish(setpoint_t{}));
  handle_until(receiver, [&] { return heard > 0; });
  stranger.handle(milliseconds(20));
  EXPECT_EQ(heard, 1);
  EXPECT_EQ(overheard, 0);
}

TEST_F(WithRoute, TenScansOf64x1024AndABlockArriveWhole) {
  Bus sender(BusConfig{}, "R1"), receiver(BusConfig{}, "R1");
  ScanJoiner scan_joiner;
  OccupancyJoiner grid_joiner;
  int scans = 0, grids = 0;
  receiver.subscribe<scan_t>([&](const scan_t& chunk) {
    scans += scan_joiner.add(chunk).has_value();
    return scan_joiner.accepted();
  });
  receiver.subscribe<occupancy_t>([&](const occupancy_t& chunk) {
    grids += grid_joiner.add(chunk).has_value();
    return grid_joiner.accepted();
  });
  const auto cloud =
      std::make_shared<std::vector<Eigen::Vector3f>>(65536, Eigen::Vector3f(1, 2, 3));
  occupancy::OccupancyGrid grid{
      .stamp = 1, .resolution_m = 0.25, .origin = {0, 0, 0}, .size = {80, 80, 80}, .cells = {}};
  for (int i = 0; i < grid.size.prod(); ++i)
    grid.cells.push_back(static_cast<occupancy::Cell>(i % 3));
  for (const auto& chunk : to_lcm(grid, 0)) sender.publish(chunk);
  handle_until(receiver, [&] { return grids == 1; });
  for (int i = 0; i < 10; ++i) {
    for (const auto& chunk : to_lcm({.stamp = (i + 1) * 100'000'000, .points = cloud}, i)) {
      sender.publish(chunk);
    }
    handle_until(receiver, [&] { return scans == i + 1; });
  }
  EXPECT_EQ(scans, 10);
  EXPECT_EQ(grids, 1);
  for (const auto& counters : receiver.counters())
    EXPECT_EQ(counters.malformed + counters.refused, 0);
}

TEST_F(WithRoute, BulkDoesNotTravelOnTheNetworkOfControl) {
  BusConfig elsewhere;
  elsewhere.bulk_url = "udpm://239.255.76.67:7700?ttl=0";
  Bus sender(BusConfig{}, "R1"), receiver(elsewhere, "R1");
  int heard = 0;
  receiver.subscribe<scan_t>([&](const scan_t&) { return ++heard > 0; });
  sender.publish(scan_t{});
  receiver.handle(milliseconds(100));
  EXPECT_EQ(heard, 0);
}

TEST_F(WithRoute, OfControlAloneNothingOfBulkIsHeard) {
  Bus sender(BusConfig{}, "R1"), receiver = Bus::of_control(BusConfig{}, "R1");
  int scans = 0, setpoints = 0;
  receiver.subscribe<scan_t>([&](const scan_t&) { return ++scans > 0; });
  receiver.subscribe<setpoint_t>([&](const setpoint_t&) { return ++setpoints > 0; });
  sender.publish(scan_t{});
  sender.publish(setpoint_t{});
  handle_until(receiver, [&] { return setpoints == 1; });
  receiver.handle(milliseconds(100));
  EXPECT_EQ(setpoints, 1);
  EXPECT_EQ(scans, 0);
}

TEST_F(WithRoute, OfControlAloneNothingLeavesTheMachineEither) {
  BusConfig radio;
  radio.control_url = "udpm://239.255.76.67:7700?ttl=1";
  EXPECT_EQ(message_of([&] { (void)Bus::of_control(radio, "R1"); }),
            message_of([&] { Bus(radio, "R1"); }));
  EXPECT_NE(message_of([&] { (void)Bus::of_control(radio, "R1"); }), "");
}

/// What a receiver that subscribed to everything hears of what LCM sends to `sent`.
std::vector<std::string> heard_of(const std::vector<std::string>& sent,
                                  const std::vector<std::string>& let_in, std::size_t bytes = 8) {
  lcm::LCM sender(BusConfig{}.control_url), receiver(BusConfig{}.control_url);
  std::vector<std::string> heard;
  receiver
      .subscribeFunction(
          ".*",
          +[](const lcm::ReceiveBuffer*, const std::string& channel,
              std::vector<std::string>* all) { all->push_back(channel); },
          &heard)
      ->setQueueCapacity(100);
  (void)receiver.getFileno();
  hear_channels_alone(multicast_group(BusConfig{}.control_url).port, let_in);
  const std::string data(bytes, 'x');
  for (const std::string& channel : sent)
    sender.publish(channel, data.data(), static_cast<unsigned int>(data.size()));
  while (receiver.handleTimeout(200) > 0) {
  }
  return heard;
}

TEST_F(WithRoute, OfChannelsThoseAloneAreHeardThatAreLetIn) {
  const std::vector<std::string> sent = {"R1_STATE",    "R1_SETPOINT", "R1_SETPOINTS", "R1_SETPOIN",
                                         "R2_SETPOINT", "R1_ODOMETRY", "R1_COMMAND"};
  const std::vector<std::string> wanted = {"R1_SETPOINT", "R1_ODOMETRY", "R1_COMMAND"};
  EXPECT_EQ(heard_of(sent, wanted), wanted);
}

TEST_F(WithRoute, APatternOfNamesIsRefused) {
  EXPECT_EQ(message_of([] {
              hear_channels_alone(7667, {"R1_STATE", ".*_STATE"});
            }),
            "channel .*_STATE to hear alone, expected capitals, digits and _");
}

TEST_F(WithRoute, AMessageShorterThanALongNameIsHeard) {
  EXPECT_EQ(heard_of({"A", "AB"}, {std::string(60, 'L'), "A"}, 1), std::vector<std::string>{"A"});
}

TEST_F(WithRoute, NamesOfEveryLengthAreLetIn) {
  std::vector<std::string> names;
  for (std::size_t length = 1; length <= 40; ++length) names.emplace_back(length, 'N');
  EXPECT_EQ(heard_of(names, names), names);
}

TEST_F(WithRoute, MessagesOfSeveralDatagramsAreNotLost) {
  EXPECT_EQ(heard_of({"R1_OBJECTS"}, {"R1_OBJECTS"}, 200'000),
            std::vector<std::string>{"R1_OBJECTS"});
}

TEST_F(WithRoute, WhatIsNoMessageIsCountedAndForgotten) {
  Bus receiver(BusConfig{}, "R1");
  int heard = 0;
  receiver.subscribe<setpoint_t>([&](const setpoint_t&) { return ++heard > 0; });
  lcm::LCM other(BusConfig{}.control_url);
  const char junk[] = "this is no setpoint";
  other.publish("R1_SETPOINT", junk, sizeof junk);
  handle_until(receiver, [&] { return receiver.counters()[0].malformed > 0; });
  EXPECT_EQ(receiver.counters()[0].malformed, 1);
  EXPECT_EQ(heard, 0);
}

/// A process that runs until it is destroyed.
class Running {
 public:
  explicit Running(const std::string& robot, const std::string& role)
      : bus_(BusConfig{}, robot), presence_(bus_, role) {
    presence_.claim(milliseconds(100));
    thread_ = std::thread([this] {
      while (!stop_) {
        presence_.announce();
        bus_.handle(milliseconds(50));
      }
    });
  }
  ~Running() {
    stop_ = true;
    thread_.join();
  }

 private:
  Bus bus_;
  Presence presence_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

std::string claim(const std::string& robot, const std::string& role) {
  Bus bus(BusConfig{}, robot);
  Presence presence(bus, role);
  return message_of([&] { presence.claim(milliseconds(400)); });
}

TEST_F(WithRoute, ASecondExecutiveOfTheSameRobotGivesWay) {
  const Running first("R1", "saker-flight");
  const std::string line = claim("R1", "saker-flight");
  EXPECT_EQ(line.rfind("a second saker-flight of robot R1 is on the network (process ", 0), 0u)
      << line;
}

TEST_F(WithRoute, AnotherRobotOrAnotherRoleIsNoSecond) {
  const Running first("R1", "saker-flight");
  EXPECT_EQ(claim("R2", "saker-flight"), "");
  EXPECT_EQ(claim("R1", "saker-collision-checker"), "");
}

TEST_F(WithRoute, OfTwoThatStartTogetherExactlyOneGoesOn) {
  std::string first, second;
  std::thread other([&] { first = claim("R1", "saker-flight"); });
  second = claim("R1", "saker-flight");
  other.join();
  EXPECT_NE(first.empty(), second.empty()) << first << second;
}

TEST_F(WithRoute, WhereOneIsEnoughForAllRobotsASecondOfAnotherNameGivesWay) {
  const Running first("BASE", "saker-base");
  Bus bus(BusConfig{}, "BASE2");
  Presence presence(bus, "saker-base", Presence::Among::whole_network);
  const std::string line = message_of([&] { presence.claim(milliseconds(400)); });
  EXPECT_EQ(line.rfind("a second saker-base of robot BASE is on the network (process ", 0), 0u)
      << line;
}

TEST_F(WithRoute, OfTwoThatMeetAfterTheirStartsTheYoungerIsOutranked) {
  Bus first_bus(BusConfig{}, "R1"), second_bus(BusConfig{}, "R1");
  Presence first(first_bus, "saker-base");
  first.claim(milliseconds(0));  // as on networks that are still apart
  Presence second(second_bus, "saker-base");
  second.claim(milliseconds(0));
  handle_until(first_bus, [&] {
    second.announce();
    return first.contested();
  });
  handle_until(second_bus, [&] {
    first.announce();
    return second.contested();
  });
  EXPECT_FALSE(first.outranked());
  EXPECT_TRUE(second.outranked());
}

TEST_F(WithRoute, OneThatStartsAnnouncesItselfEvery50MsThoughItHearsItself) {
  Bus bus(BusConfig{}, "R1"), listener(BusConfig{}, "R1");
  int heard = 0;
  listener.subscribe<presence_t>([&](const presence_t&) { return ++heard > 0; });
  Presence presence(bus, "saker-flight");
  presence.claim(milliseconds(500));
  handle_until(listener, [&] { return heard >= 10; });
  listener.handle(milliseconds(50));
  EXPECT_GE(heard, 5);
  EXPECT_LE(heard, 11);
}

TEST_F(WithRoute, OneThatIsHeardAfterTheStartIsReported) {
  Bus bus(BusConfig{}, "R1"), intruder(BusConfig{}, "R1");
  Presence presence(bus, "saker-flight");
  presence.claim(milliseconds(50));
  EXPECT_FALSE(presence.contested());
  presence_t message{};
  message.role = "saker-flight";
  message.instance = 1;
  message.running = true;
  intruder.publish(message);
  handle_until(bus, [&] { return presence.contested(); });
  EXPECT_TRUE(presence.contested());
}

}  // namespace
}  // namespace saker::flight
