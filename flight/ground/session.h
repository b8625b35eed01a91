#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "flight/ground/protocol.h"

namespace saker::flight::ground {

using Text = std::shared_ptr<const std::string>;

struct SessionLimits {
  std::size_t most_messages = 256;                        ///< that wait, of one channel
  std::size_t most_bytes = std::size_t{8} << 20;          ///< that wait, of messages
  std::size_t most_answer_bytes = std::size_t{16} << 20;  ///< that wait, of answers
  std::chrono::seconds most_wait{10};                     ///< without anything being taken
};

/// One client: its subscriptions, and what waits to be sent to it. Of messages that wait too long
/// the oldest are dropped and counted; answers are not, so a client that takes nothing is cut.
class Session {
 public:
  using Steady = std::chrono::steady_clock;

  /// One frame of the WebSocket.
  struct Outgoing {
    bool binary = false;
    std::string head;
    Text body;
  };

  /// \param from  address of the client; \param sdk  it chose foxglove.sdk.v1
  Session(std::string from, bool sdk, const SessionLimits& limits = {});

  /// False where the client's id is taken, or the channel already subscribed to.
  bool subscribe(const Subscription& subscription);
  /// \return the channel, where there was one
  std::optional<std::uint64_t> unsubscribe(std::uint32_t id);
  [[nodiscard]] const std::map<std::uint64_t, std::uint32_t>& subscriptions() const {
    return by_channel_;
  }

  /// Answers and what belongs to the protocol.
  void answer(std::string text, bool binary, Steady::time_point now);
  /// The time of a run; it takes the place of one that still waits.
  void tell_time(Time time, Steady::time_point now);
  /// A message of a channel; nothing happens where it is not subscribed to.
  void offer(std::uint64_t channel, Time time, const Text& json, Steady::time_point now);

  /// What to send next: answers first.
  [[nodiscard]] std::optional<Outgoing> take(Steady::time_point now);
  [[nodiscard]] bool has_output() const { return !answers_.empty() || !messages_.empty(); }

  /// Whether it is to be cut: nothing was taken for long, or answers pile up.
  [[nodiscard]] bool is_stuck(Steady::time_point now) const;
  /// Whether more answers wait than may.
  [[nodiscard]] bool is_full() const { return answer_bytes_ > limits_.most_answer_bytes; }

  [[nodiscard]] const std::string& from() const { return from_; }
  [[nodiscard]] bool sdk() const { return sdk_; }
  [[nodiscard]] long dropped() const { return dropped_; }
  /// Tells the client how many messages it did not get, where there are more than it was told of.
  void tell_drops(Steady::time_point now);
  [[nodiscard]] std::size_t waiting_bytes() const { return bytes_ + answer_bytes_; }

 private:
  struct Message {
    std::uint64_t channel;
    Time time;
    Text json;
  };

  void drop(std::deque<Message>::iterator message);
  void begin_wait(Steady::time_point now);

  std::string from_;
  bool sdk_;
  SessionLimits limits_;
  std::map<std::uint64_t, std::uint32_t> by_channel_;  ///< to the client's ids
  std::map<std::uint32_t, std::uint64_t> by_id_;
  std::deque<Outgoing> answers_;
  std::deque<Message> messages_;
  std::map<std::uint64_t, std::size_t> waiting_;  ///< messages by channel
  std::size_t bytes_ = 0, answer_bytes_ = 0;
  long dropped_ = 0, told_drops_ = 0;
  Steady::time_point waits_since_{};
};

}  // namespace saker::flight::ground
