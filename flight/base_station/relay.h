#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "flight/base_station/config.h"
#include "flight/bus/bus.h"

namespace saker::flight {

/// Carries chosen channels between the robots' network and the ground's, the bytes as they are: up
/// what robots say of themselves, down only what the team's key sealed.
///
/// A channel passes in one direction, so nothing comes back through this relay; what another relay
/// carries back is known by its bytes and dropped. Of what comes faster than a channel's rate the
/// newest passes. One thread: handlers keep the newest message, `step` sends what is due.
class Relay {
 public:
  using Steady = std::chrono::steady_clock;
  /// What a sealed message of `channel` says; nothing when it is not the team's.
  using Open = std::function<std::optional<std::vector<std::uint8_t>>(const std::string& channel,
                                                                      Bus::Bytes sealed)>;

  struct Counters {
    struct Way {
      long messages = 0, bytes = 0;
    };
    Way up, down;
    long replaced = 0;   ///< by a newer one before it was due
    long echoes = 0;     ///< carried back by another relay
    long not_ours = 0;   ///< from the ground, without the team's seal
    long oversized = 0;  ///< larger than a message may be
    long crowded = 0;    ///< of more channels than there may be
    long not_sent = 0;   ///< not taken by the network
  };

  /// Subscribes to both, which have to outlive this. Throws Error on a wrong value, and where a
  /// channel is to pass in both directions or must not pass at all.
  Relay(const RelayConfig& config, Bus& robots, Bus& ground, Open open);

  /// Sends what is due.
  void step(Steady::time_point now);

  /// Until when there is nothing to send, unless something is heard.
  [[nodiscard]] Steady::time_point next_due() const;

  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  struct Sent {
    std::uint64_t hash = 0;
    Steady::time_point when;
  };

  /// One channel of one robot.
  struct Passage {
    Bus* to = nullptr;
    Counters::Way* way = nullptr;
    Steady::duration period{};
    Steady::time_point next{};  ///< before which nothing is sent
    std::optional<std::vector<std::uint8_t>> waiting;
    std::array<Sent, 16> sent{};  ///< the last ones, as a ring
    std::size_t sent_count = 0;
    bool echoed = false;  ///< was carried back once
  };

  void subscribe(const std::vector<RelayedChannel>& channels, Bus& from, Bus& to,
                 Counters::Way& way);
  bool hear(const std::string& channel, Bus::Bytes bytes, const Passage& fresh);
  [[nodiscard]] bool is_echo(const Passage& passage, Bus::Bytes bytes) const;
  void send(const std::string& channel, Passage& passage, Steady::time_point now);

  RelayConfig config_;
  Bus& robots_;
  Bus& ground_;
  Open open_;
  std::map<std::string, Passage> passages_;
  Steady::time_point now_{};  // of the last step
  Counters counters_;
};

}  // namespace saker::flight
