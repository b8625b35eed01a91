#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "flight/bus/exchange_messages.h"
#include "flight/executive/health_counters.h"
#include "flight/executive/robot_exchange.h"
#include "saker/core/error.h"
#include "saker/core/files.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;
using Steady = std::chrono::steady_clock;

const char* const kKey = "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f\n";

/// A flight ahead: a keyframe a metre, a trunk measured from each.
slam::History flown(int entries, int classes, std::uint32_t flight) {
  slam::History history{"R1", flight, {}};
  for (int k = 0; k < entries; ++k) {
    slam::HistoryEntry entry;
    entry.stamp = from_seconds(10 + k);
    entry.T_odom_lidar.translation().x() = k;
    entry.motion_covariance = 1e-4 * Matrix6d::Identity();
    objects::Measurement& trunk = entry.measurements.emplace_back();
    trunk.stamp = entry.stamp;
    trunk.class_id = 1;
    trunk.class_probability.assign(static_cast<std::size_t>(classes), 0);
    trunk.class_probability[1] = 1;
    trunk.model = objects::Cylinder{{5, 0.1 * k, -3}, Eigen::Vector3d::UnitZ(), 0.2, 3};
    trunk.covariance = 1e-3 * Eigen::MatrixXd::Identity(6, 6);
    history.entries.push_back(entry);
  }
  return history;
}

/// A robot's executive and a base on a network without sockets.
class ARobotsExchange : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::temp_directory_path() / "saker-robot-exchange" / test->name();
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    config.exchange.key_file = folder / "team.key";
    config.exchange.folder = folder / "robot";
    core::write_file(config.exchange.key_file, kKey);
    std::filesystem::permissions(config.exchange.key_file, std::filesystem::perms::owner_read);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  /// A network of its own for each: what subscribed to it does not outlive it.
  Bus& network() {
    bus.emplace(Bus::in_memory("R1"));
    bus->subscribe_all<exchange_t>([this](const std::string& robot, const exchange_t& message) {
      if (base_in_reach && robot == "R1")
        (void)base().receive(now(), "R1_EXCHANGE", datagram_of(message));
      return true;
    });
    return *bus;
  }

  exchange::Exchange& base() {
    if (!base_) {
      base_.emplace(exchange::PeerConfig{}, "BASE", exchange::read_key(config.exchange.key_file),
                    folder / "base", held);
      base_->add_link("R1_EXCHANGE", exchange::Role::answers);
    }
    return *base_;
  }

  /// Until `done`.
  template <class Done>
  bool run(RobotExchange& robot, const Done& done, milliseconds longest = milliseconds(10000)) {
    for (const auto end = Steady::now() + longest; Steady::now() < end && !done();) {
      robot.step();
      while (base_in_reach) {
        const auto datagram = base().next(now());
        if (!datagram) break;
        bus->publish(to_lcm(system_utime(), datagram->bytes));
      }
      while (bus->handle(milliseconds(0)) > 0) {
      }
      std::this_thread::sleep_for(milliseconds(5));
    }
    return done();
  }

  [[nodiscard]] std::string packed(const slam::History& history) const {
    return exchange::packed(history, config.autonomy.objects.size());
  }
  [[nodiscard]] slam::History flight(int entries, std::uint32_t number) const {
    return flown(entries, config.autonomy.objects.size(), number);
  }
  static Time now() { return Steady::now().time_since_epoch().count(); }
  static exchange::StreamId stream(std::uint32_t flight) {
    return {"R1", exchange::StreamKind::history, flight};
  }

  std::filesystem::path folder;
  ProcessConfig config;
  std::optional<Bus> bus;
  exchange::MemoryStore held;  ///< by the base
  bool base_in_reach = true;

 private:
  std::optional<exchange::Exchange> base_;
};

TEST_F(ARobotsExchange, AFlightThatGrowsIsAtTheBaseByteForByte) {
  RobotExchange robot(config, network());
  const slam::History whole = flight(60, 1);
  slam::History history{"R1", 1, {}};
  for (const slam::HistoryEntry& entry : whole.entries) {
    history.entries.push_back(entry);
    robot.add(history);
    EXPECT_FALSE(robot.settled());
    robot.step();
  }
  EXPECT_TRUE(run(robot, [&] { return robot.handed_over(); }));
  EXPECT_TRUE(held.bytes(stream(1)) == packed(whole));
}

TEST_F(ARobotsExchange, WithoutABaseFlightsWaitInTheFolderUntilOneIsInReach) {
  base_in_reach = false;
  for (const std::uint32_t number : {1U, 2U}) {
    RobotExchange robot(config, network());
    EXPECT_EQ(robot.flight(), number);
    robot.add(flight(20, number));
    EXPECT_TRUE(run(robot, [&] { return robot.settled(); }));
    EXPECT_FALSE(robot.handed_over());
  }
  base_in_reach = true;
  RobotExchange robot(config, network());
  EXPECT_TRUE(run(robot, [&] { return robot.handed_over(); }));
  EXPECT_TRUE(held.bytes(stream(1)) == packed(flight(20, 1)));
  EXPECT_TRUE(held.bytes(stream(2)) == packed(flight(20, 2)));
}

TEST_F(ARobotsExchange, HearsOfEveryFlightThatTheBaseHasAndThenThatThereIsNoMore) {
  slam::History other = flight(30, 7);
  other.robot = "R2";
  const exchange::StreamId stream{"R2", exchange::StreamKind::history, 7};
  ASSERT_TRUE(held.append(stream, packed(other)));
  RobotExchange robot(config, network());
  EXPECT_FALSE(robot.heard_all());
  EXPECT_TRUE(run(robot, [&] { return robot.heard_all(); }));
  const auto told = robot.told_flights();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].history.robot, "R2");
  EXPECT_EQ(told[0].history.flight, 7U);
  EXPECT_EQ(told[0].history.entries.size(), 30U);
}

TEST_F(ARobotsExchange, OutOfReachThereIsNobodyToHear) {
  base_in_reach = false;
  RobotExchange robot(config, network());
  EXPECT_FALSE(run(
      robot, [&] { return robot.heard_all(); }, milliseconds(1500)));
  EXPECT_FALSE(robot.in_reach());
}

TEST_F(ARobotsExchange, BytesThatAreNoFlightOrAnotherRobotsAreNotTakenForOne) {
  ASSERT_TRUE(held.append({"R2", exchange::StreamKind::history, 1}, std::string(500, 'x')));
  slam::History other = flight(5, 1);
  other.robot = "R4";  // told under the name of R3
  ASSERT_TRUE(held.append({"R3", exchange::StreamKind::history, 1}, packed(other)));
  RobotExchange robot(config, network());
  EXPECT_TRUE(run(robot, [&] { return robot.heard_all(); }));
  EXPECT_TRUE(robot.told_flights().empty());
}

TEST_F(ARobotsExchange, WhatIsPublishedIsAtTheBaseOnceHoweverManyFlights) {
  for (int i = 0; i < 2; ++i) {
    RobotExchange robot(config, network());
    EXPECT_TRUE(robot.publish(exchange::StreamKind::prior_map, "a map"));
    robot.add(flight(1, robot.flight()));
    EXPECT_TRUE(run(robot, [&] { return robot.handed_over(); }));
  }
  EXPECT_EQ(held.bytes({"R1", exchange::StreamKind::prior_map, 1}), "a map");
  EXPECT_EQ(exchange::newest_version(held, "R1", exchange::StreamKind::prior_map), 1U);
}

TEST_F(ARobotsExchange, TheFlightSaysWhereItBegan) {
  config.team.takeoff.position_m = {1, 2, 3};
  RobotExchange robot(config, network());
  robot.add(flight(3, 1));
  EXPECT_TRUE(run(robot, [&] { return robot.handed_over(); }));
  const auto told = exchange::unpacked(held.bytes(stream(1)));
  ASSERT_TRUE(told && told->takeoff);
  EXPECT_TRUE(told->takeoff->pose.translation().isApprox(Eigen::Vector3d(1, 2, 3)));
}

TEST_F(ARobotsExchange, WhatAnotherRobotSaidIsKeptForTheNextFlight) {
  const exchange::StreamId other{"R2", exchange::StreamKind::history, 7};
  ASSERT_TRUE(held.append(other, std::string(5000, 'x')));
  {
    RobotExchange robot(config, network());
    robot.add(flight(1, 1));
    exchange::Exchange& end = base();
    EXPECT_TRUE(run(robot, [&] { return end.contacts(now()).front().all_sent; }));
  }
  const exchange::JournalStore kept(std::filesystem::path(config.exchange.folder) /
                                    "streams.journal");
  EXPECT_TRUE(kept.bytes(other) == std::string(5000, 'x'));
}

TEST_F(ARobotsExchange, ItsFiguresFitIntoHealth) {
  RobotExchange robot(config, network());
  EXPECT_TRUE(run(robot, [&] { return !robot.figures().empty(); }));
  // Orders, the sensor's, and the briefing's.
  constexpr std::size_t kOthers = 1 + HealthFigures::kMostSensor + 3;
  EXPECT_LE(robot.figures().size() + kOthers, static_cast<std::size_t>(health_t::MAX_COUNTERS));
  for (const auto& [name, value] : robot.figures())
    EXPECT_LE(name.size(), static_cast<std::size_t>(counter_t::MAX_NAME)) << name;
}

TEST_F(ARobotsExchange, WithoutTheTeamsKeyThereIsNone) {
  std::filesystem::remove(config.exchange.key_file);
  EXPECT_EQ(make_exchange(config, network()), nullptr);
}

TEST_F(ARobotsExchange, AKeyThatEverybodyMayReadIsRefused) {
  std::filesystem::permissions(config.exchange.key_file, std::filesystem::perms::others_read,
                               std::filesystem::perm_options::add);
  EXPECT_THROW((void)make_exchange(config, network()), Error);
}

}  // namespace
}  // namespace saker::flight
