#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "flight/bus/bus.h"

namespace saker::flight {

/// Keeps a second process of the same robot and role from flying: two executives on one vehicle
/// send setpoints against each other.
///
/// Each process says on `_PRESENCE` who it is. One that starts listens first and gives way to one
/// that runs; of two that start together the one with the lower instance number goes on.
class Presence {
 public:
  static constexpr std::chrono::milliseconds kListen{1500};  ///< three announcements of another
  static constexpr std::chrono::milliseconds kPeriod{500};

  /// Whose names count.
  enum class Among {
    same_robot,
    whole_network,  ///< one of this role is enough for all robots
  };

  /// \param role  the program: "saker-flight". Subscribes to `bus`, which has to outlive this.
  Presence(Bus& bus, const std::string& role, Among among = Among::same_robot);

  /// Handles the bus for `listen`. Throws Error when another one is there: "a second saker-flight
  /// of robot R1 is on the network (process 123)".
  void claim(std::chrono::milliseconds listen = kListen);

  /// To be called every kPeriod after `claim`, by the thread that handles the bus.
  void announce();

  /// Somebody of the same role was heard after `claim`: a network that came together in flight.
  [[nodiscard]] bool contested() const;

  /// After `claim`, of two that run: whether it is this one that has to end. The lower instance
  /// number goes on.
  [[nodiscard]] bool outranked() const;

  /// Who the other one is: "a second saker-base of robot BASE is on the network (process 123)".
  [[nodiscard]] std::string other() const;

 private:
  struct Other {
    std::mutex mutex;
    bool heard = false;
    std::string robot;
    presence_t last{};
  };

  void listen_until(std::chrono::steady_clock::time_point until);
  [[nodiscard]] presence_t own() const;
  [[nodiscard]] bool must_give_way() const;

  Bus& bus_;
  const std::string role_;
  const std::int64_t instance_;
  bool running_ = false;
  std::shared_ptr<Other> other_ = std::make_shared<Other>();
};

}  // namespace saker::flight
