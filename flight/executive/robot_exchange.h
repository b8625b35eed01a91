#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "flight/bus/bus.h"
#include "flight/bus/mailbox.h"
#include "flight/process/configuration.h"
#include "saker/exchange/exchange.h"
#include "saker/exchange/journal_store.h"
#include "saker/exchange/packed_history.h"
#include "saker/slam/history.h"

namespace saker::flight {

/// The robot's end of the exchange with the base station, before, in and after a flight, as long as
/// it is in reach. `step` has a loop of its own, so that nothing that flies waits for the disk; the
/// other threads only put into its queues.
class RobotExchange {
 public:
  /// Subscribes to `bus`, which has to outlive this. Throws Error where the team's key, the folder
  /// or what is in it cannot be used.
  RobotExchange(const ProcessConfig& config, Bus& bus);

  /// A whole file that the team is to have: a new version, unless it has the newest one already.
  /// Before `step` has a thread of its own. False where the disk does not take it.
  [[nodiscard]] bool publish(exchange::StreamKind kind, std::string_view bytes);
  /// What is new in this flight's history. On the mapping thread.
  void add(const slam::History& history);
  /// On its own loop, 50 Hz.
  void step();

  // Before `step` has a thread of its own, or when it has ended.

  /// A base answers.
  [[nodiscard]] bool in_reach() const { return in_reach_; }
  /// A base in reach had nothing more to tell for a second.
  [[nodiscard]] bool heard_all() const;
  /// All flights that are kept here, but this one.
  [[nodiscard]] std::vector<exchange::UnpackedHistory> told_flights() const;

  /// This flight's number, counted from 1: none before it in the folder has it.
  [[nodiscard]] std::uint32_t flight() const { return flight_.version; }

  // Any thread.

  /// All that was added is on the disk, and nobody in reach lacks any of it.
  [[nodiscard]] bool settled() const { return state_ != State::busy; }
  /// The base has this whole flight.
  [[nodiscard]] bool handed_over() const { return state_ == State::handed_over; }
  /// Datagrams that came faster than they were looked at.
  [[nodiscard]] long dropped() const { return heard_.dropped(); }
  /// For `_HEALTH`.
  [[nodiscard]] std::vector<std::pair<std::string, long>> figures() const;

 private:
  using Steady = std::chrono::steady_clock;
  enum class State { idle, busy, handed_over };

  bool hear(const exchange_t& message);
  void write_down();
  [[nodiscard]] State looked_at(Time now);
  void say_figures();

  Bus& bus_;
  const std::string channel_;
  exchange::JournalStore store_;
  const exchange::StreamId flight_;
  exchange::Exchange exchange_;
  exchange::HistoryPacker packer_;
  std::size_t queued_ = 0;  // entries, by the mapping thread

  BoundedQueue<slam::HistoryEntry> entries_;
  BoundedQueue<std::string> heard_;
  Mailbox<std::vector<std::pair<std::string, long>>> figures_;
  std::atomic<State> state_ = State::idle;
  long unkept_ = 0;  // entries of this flight that are told to nobody
  Steady::time_point said_;
  bool in_reach_ = false;
  std::size_t kept_bytes_ = 0;      // of all streams, at the last step
  Steady::time_point lacked_ = {};  // when a base in reach was last known to have more
};

/// The robot's end of the exchange; none, in one line of the log, where there is no folder for it
/// or no key. Throws Error as the constructor does.
[[nodiscard]] std::unique_ptr<RobotExchange> make_exchange(const ProcessConfig& config, Bus& bus);

}  // namespace saker::flight
