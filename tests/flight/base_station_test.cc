#include "flight/base_station/base_station.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

#include "flight/bus/exchange_messages.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;
using Steady = BaseStation::Steady;

const exchange::StreamId kFlight{"R1", exchange::StreamKind::history, 1};

/// A base on a network without sockets, robots on the same and one over the radio.
class ABaseStation : public testing::Test {
 protected:
  /// A robot's end of the exchange, under a name, on a channel.
  struct Robot {
    Robot(ABaseStation& test, const std::string& name, const std::string& channel_of)
        : bus(test.robots),
          channel(channel_of + "_EXCHANGE"),
          link({}, name, test.key, test.folder / name, store) {
      link.add_link(channel, exchange::Role::calls);
      bus.subscribe_all<exchange_t>([this](const std::string& robot, const exchange_t& message) {
        if (robot + "_EXCHANGE" != channel) return false;
        return link.receive(now(), channel, datagram_of(message)) == exchange::Verdict::genuine;
      });
    }

    void send() {
      while (const auto datagram = link.next(now())) {
        bus.publish_as(robot_of(datagram->channel), to_lcm(0, datagram->bytes));
      }
    }

    static Time now() { return Steady::now().time_since_epoch().count(); }

    Bus& bus;
    std::string channel;
    exchange::MemoryStore store;
    exchange::Exchange link;
  };

  void SetUp() override {
    std::string form = (std::filesystem::temp_directory_path() / "saker_base_XXXXXX").string();
    ASSERT_NE(mkdtemp(form.data()), nullptr);
    folder = form;
    config.exchange.key_file = (folder / "team.key").string();
    exchange::make_key_file(config.exchange.key_file);
    key = exchange::read_key(config.exchange.key_file);
    config.base.folder = (folder / "base").string();
    std::filesystem::create_directory(config.base.folder);
    config.base.most_robots = 2;
    store.emplace(store_file(config.base), 100);
    link.emplace(config.link, LinkEnd::End::ground, key, robots, 2,
                 [](const Address&, std::string_view) { return true; });
    base.emplace(config, *store, robots, [this] { return link->report(); });
    robots.subscribe<health_t>([this](const health_t& message) {
      health = message;
      return true;
    });
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  /// Until `done`, at most a few seconds.
  template <class Done>
  bool run(std::initializer_list<Robot*> with, const Done& done) {
    for (const auto end = Steady::now() + milliseconds(8000); Steady::now() < end && !done();) {
      for (Robot* const robot : with) robot->send();
      Bus::handle({&robots}, milliseconds(5));
      base->step(Steady::now());
    }
    return done();
  }
  void run_for(milliseconds time, std::initializer_list<Robot*> with) {
    const auto end = Steady::now() + time;
    run(with, [end] { return Steady::now() >= end; });
  }

  [[nodiscard]] long counted(const std::string& name) const {
    if (!health) return 0;
    for (const counter_t& counter : health->counters)
      if (counter.name == name) return counter.value;
    ADD_FAILURE() << "no counter " << name;
    return -1;
  }

  std::filesystem::path folder;
  ProcessConfig config;
  exchange::Key key{};
  std::optional<DatabaseStore> store;
  Bus robots = Bus::in_memory("BASE");
  std::optional<LinkEnd> link;
  std::optional<BaseStation> base;
  std::optional<health_t> health;
};

TEST_F(ABaseStation, TakesARobotInAndKeepsWhatItSays) {
  Robot robot(*this, "R1", "R1");
  const std::string bytes(5000, 'a');
  ASSERT_TRUE(robot.store.append(kFlight, bytes));
  EXPECT_TRUE(run({&robot}, [&] { return store->size(kFlight) == bytes.size(); }));
  EXPECT_TRUE(store->bytes(kFlight) == bytes);
}

TEST_F(ABaseStation, HandsOneRobotsHistoryToAnother) {
  ASSERT_TRUE(store->append(kFlight, std::string(5000, 'a')));
  Robot robot(*this, "R2", "R2");
  EXPECT_TRUE(run({&robot}, [&] { return robot.store.size(kFlight) == 5000; }));
  EXPECT_TRUE(robot.store.bytes(kFlight) == std::string(5000, 'a'));
}

TEST_F(ABaseStation, ARobotDoesNotSpeakOnTheChannelOfAnother) {
  Robot robot(*this, "R2", "R1");
  ASSERT_TRUE(robot.store.append(kFlight, std::string(5000, 'a')));
  run_for(milliseconds(2500), {&robot});
  EXPECT_EQ(store->size(kFlight), 0u);
}

TEST_F(ABaseStation, WhatIsNotSealedTakesNobodysPlace) {
  for (int i = 0; i < 100; ++i) {
    exchange_t message{};
    message.data.assign(100, static_cast<std::uint8_t>(i));
    message.num_data = 100;
    robots.publish_as(fmt::format("X{}", i), message);
    Bus::handle({&robots}, milliseconds(0));
  }
  Robot first(*this, "R1", "R1"), second(*this, "R2", "R2");
  ASSERT_TRUE(second.store.append({"R2", exchange::StreamKind::history, 1}, "abc"));
  EXPECT_TRUE(run({&first, &second}, [&] {
    return store->size({"R2", exchange::StreamKind::history, 1}) == 3;
  }));
}

TEST_F(ABaseStation, MoreRobotsThanTheCeilingAreRefusedAndCounted) {
  Robot first(*this, "R1", "R1"), second(*this, "R2", "R2"), third(*this, "R3", "R3");
  run_for(milliseconds(1500), {&first, &second});
  ASSERT_TRUE(third.store.append({"R3", exchange::StreamKind::history, 1}, "abc"));
  EXPECT_TRUE(run({&first, &second, &third}, [&] { return counted("robots_refused") > 0; }));
  EXPECT_TRUE(store->extents().empty());
}

TEST_F(ABaseStation, SaysWhomItRefusesWhereItKnowsAsManyNamesAsItCan) {
  std::ostringstream log;
  const auto before = spdlog::default_logger();
  spdlog::set_default_logger(std::make_shared<spdlog::logger>(
      "test", std::make_shared<spdlog::sinks::ostream_sink_mt>(log)));
  for (std::size_t i = 0; i < exchange::kMostSenders + 2; ++i) {
    const std::string name = fmt::format("X{}", i);
    exchange::Sealer sealer(key, name, "");
    for (int again = 0; again < 2; ++again) {
      robots.publish_as(name, to_lcm(0, sealer.seal(name + "_EXCHANGE", "hello").value()));
      Bus::handle({&robots}, milliseconds(0));
    }
  }
  spdlog::set_default_logger(before);
  EXPECT_EQ(log.str().find("X63 is refused"), std::string::npos) << log.str();
  for (const char* line : {"X64 is refused: 64 names were heard here", "X65 is refused"}) {
    const std::size_t at = log.str().find(line);
    ASSERT_NE(at, std::string::npos) << log.str();
    EXPECT_EQ(log.str().find(line, at + 1), std::string::npos) << "said twice";
  }
}

TEST_F(ABaseStation, MoreRobotsThanItCanTellApartAreNoSetting) {
  config.base.most_robots = static_cast<int>(exchange::kMostSenders) + 1;
  EXPECT_THROW(BaseStation(config, *store, robots, {}), Error);
}

TEST_F(ABaseStation, SaysHealthWithinTheMessagesLimits) {
  Robot robot(*this, "R1", "R1");
  ASSERT_TRUE(robot.store.append(kFlight, std::string(5000, 'a')));
  EXPECT_TRUE(run({&robot}, [&] { return counted("exchange_sent_bytes") > 0; }));
  EXPECT_EQ(health->process, "saker-base");
  EXPECT_LE(health->num_counters, health_t::MAX_COUNTERS);
  for (const counter_t& counter : health->counters)
    EXPECT_LE(counter.name.size(), static_cast<std::size_t>(counter_t::MAX_NAME));
  EXPECT_GT(counted("store_bytes"), 0);
  EXPECT_EQ(counted("store_full"), 0);
  link->receive(Steady::now(), {}, "no datagram of ours");
  EXPECT_TRUE(run({&robot}, [&] { return counted("link_refused") == 1; }));
}

TEST_F(ABaseStation, ARobotWithItsOwnKeyIsTakenInToo) {
  key = exchange::key_of(key, "R1").value();
  Robot robot(*this, "R1", "R1");
  ASSERT_TRUE(robot.store.append(kFlight, std::string(5000, 'a')));
  EXPECT_TRUE(run({&robot}, [&] { return store->size(kFlight) == 5000; }));
}

}  // namespace
}  // namespace saker::flight
