#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "exchange/lossy_link.h"
#include "flight/link/link_end.h"

namespace saker::flight {

inline const Address kGround{0x0A4C0101, 7670};  // 10.76.1.1

/// Two robots' ends and the ground's, with a LCM in memory each, over radio that may lose, repeat
/// and reorder; steps of 10 ms. Whatever crosses the air is recorded.
class MadeLink : public testing::Test {
 protected:
  using Steady = LinkEnd::Steady;
  using Message = std::pair<std::string, std::string>;  // channel, bytes
  using Datagram = std::pair<Address, std::string>;     // from

  struct Robot {
    Robot(MadeLink& made, const std::string& name, std::uint32_t number,
          const exchange::Key& its_key)
        : address{kGround.ip + number, 4000},
          bus(std::make_unique<Bus>(Bus::in_memory(name))),
          up(made.air, core::Rng(2 * number)),
          down(made.air, core::Rng(2 * number + 1)),
          key(its_key) {
      start(made);
    }

    void start(MadeLink& made) {
      LinkConfig config;
      config.ground = to_string(kGround);
      end.reset();
      bus = std::make_unique<Bus>(Bus::in_memory(bus->robot()));
      listen(*bus, heard);
      end.emplace(config, LinkEnd::End::robot, key, *bus, 1,
                  [this, &made](const Address& to, std::string_view datagram) {
                    EXPECT_EQ(to, kGround);
                    made.recorded.emplace_back(address, datagram);
                    up.send(made.time(), std::string(datagram));
                    return true;
                  });
    }

    Address address;
    std::unique_ptr<Bus> bus;
    exchange::LossyLink up, down;
    exchange::Key key;
    std::vector<Message> heard{};
    std::optional<LinkEnd> end{};
  };

  void SetUp() override {
    for (std::size_t i = 0; i < team.size(); ++i) team[i] = static_cast<std::uint8_t>(3 * i + 1);
    start_ground();
  }

  void start_ground() {
    ground.reset();
    ground_bus = std::make_unique<Bus>(Bus::in_memory("BASE"));
    listen(*ground_bus, heard);
    ground.emplace(LinkConfig{}, LinkEnd::End::ground, team, *ground_bus, 4,
                   [this](const Address& to, std::string_view datagram) {
                     for (Robot* const robot : robots)
                       if (robot->address == to) robot->down.send(time(), std::string(datagram));
                     answered.push_back(to);
                     return true;
                   });
  }

  static void listen(Bus& bus, std::vector<Message>& into) {
    for (const char* suffix : {"_STATE", "_TRAJECTORY", "_MISSION", "_EXCHANGE", "_ORDER",
                               "_SETPOINT", "_COMMAND", "_VERDICT", "_PRESENCE"}) {
      bus.subscribe_raw(suffix, [&into](const std::string& channel, Bus::Bytes bytes) {
        into.emplace_back(channel, std::string(bytes.begin(), bytes.end()));
        return true;
      });
    }
  }

  static void say(Bus& bus, const std::string& channel, const std::string& text) {
    bus.publish_raw(channel, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }

  void step() {
    now += std::chrono::milliseconds(10);
    Bus::handle({ground_bus.get()}, std::chrono::milliseconds(0));
    for (Robot* const robot : robots) {
      while (const auto datagram = robot->up.receive(time()))
        if (in_reach) ground->receive(now, robot->address, *datagram);
      while (const auto datagram = robot->down.receive(time()))
        if (in_reach) robot->end->receive(now, kGround, *datagram);
      Bus::handle({robot->bus.get()}, std::chrono::milliseconds(0));
      robot->end->step(now);
    }
    ground->step(now);
    Bus::handle({ground_bus.get()}, std::chrono::milliseconds(0));
  }
  void run(double seconds) {
    for (const auto end = now + std::chrono::duration<double>(seconds); now < end;) step();
  }

  [[nodiscard]] Time time() const { return now.time_since_epoch().count(); }

  /// What was heard on a channel.
  [[nodiscard]] static std::vector<std::string> on(const std::vector<Message>& all,
                                                   const std::string& channel) {
    std::vector<std::string> texts;
    for (const auto& [name, text] : all)
      if (name == channel) texts.push_back(text);
    return texts;
  }

  exchange::Key team{};
  exchange::LossConfig air{.loss = 0, .repeated = 0, .jitter_s = 0};
  Steady::time_point now = Steady::now();
  std::vector<Robot*> robots;
  std::unique_ptr<Bus> ground_bus;
  std::vector<Message> heard;      // on the ground's LCM
  std::vector<Datagram> recorded;  // of what robots sent
  std::vector<Address> answered;   // where the ground sent something
  std::optional<LinkEnd> ground;
  bool in_reach = true;
};

}  // namespace saker::flight
