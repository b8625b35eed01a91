#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "flight/link/config.h"

namespace saker::flight {

/// What waits at one end for one counterpart. Of a channel the newest message, or as many as its
/// `keep` says, never more; each channel at its rate, all together at the link's. Channels take
/// turns, a datagram each, so that a large message holds up no other channel.
class Outbox {
 public:
  using Steady = std::chrono::steady_clock;

  struct Counters {
    long messages = 0, bytes = 0;  ///< that went out
    long replaced = 0;             ///< by newer ones of their channel, before they were due
  };

  Outbox(const std::vector<LinkedChannel>& channels, double rate_kb_s);

  /// \param channel  one of those given
  void put(const std::string& channel, std::string message);

  /// The next piece that is due (fragments.h); nothing: none is, or the rate is used up.
  [[nodiscard]] std::optional<std::string> next(Steady::time_point now);

  /// When `next` is to be asked again, unless something is put in; never: the end of time.
  [[nodiscard]] Steady::time_point next_due() const;

  /// Nobody hears: of channels that keep more than the newest nothing is kept.
  void forget_events();

  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  struct Line {
    std::size_t keep = 1;
    Steady::duration period{};
    Steady::time_point next{};  // before which no message begins
    std::deque<std::string> waiting{};
    std::string sending{};
    std::uint16_t index = 0, count = 0;  // the next piece of it, how many; 0: nothing is sent
    std::uint32_t number = 0;
  };

  [[nodiscard]] static bool is_due(const Line& line, Steady::time_point now);
  void begin(Line& line, Steady::time_point now);
  [[nodiscard]] static std::string piece(const std::string& channel, Line& line);

  double rate_;  // bytes a second
  std::map<std::string, Line> lines_;
  std::string last_;   // the channel whose turn it was
  double tokens_ = 0;  // bytes
  Steady::time_point tokens_at_{};
  Counters counters_;
};

}  // namespace saker::flight
