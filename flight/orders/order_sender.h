#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>

#include "flight/bus/bus.h"
#include "flight/orders/order_messages.h"

/// The ground's end of orders: seals them, sends them until MISSION acknowledges them.
namespace saker::flight {

struct OrderSenderConfig {
  std::chrono::milliseconds repeat{300};     ///< messages get lost
  std::chrono::milliseconds deadline{5000};  ///< for the acknowledgement
};

/// Never waits; one thread. Say what was heard by `hear`, call `step` ten times a second or more.
class OrderSender {
 public:
  using Steady = std::chrono::steady_clock;

  enum class State {
    sending,  ///< no answer yet
    waiting,  ///< the robot has it and asks its flight controller
    accepted,
    refused,    ///< by the robot
    overtaken,  ///< a later order to the robot took its place before there was an answer
    unanswered  ///< within the deadline
  };
  struct Progress {
    State state = State::unanswered;
    std::string text;  ///< what the robot says to it, or what is wrong here
  };

  /// \param bus   has to outlive this; orders go to the channel of each robot
  /// \param name  under which this process seals, of its own in the team: capitals and digits
  /// \param folder  where the seal's counter is kept, as order-NAME.counter; has to exist
  /// Throws Error where the folder cannot be used.
  OrderSender(const OrderSenderConfig& config, Bus& bus, const exchange::Key& key,
              const std::string& name, const std::filesystem::path& folder);

  /// Sends it at once and, by `step`, again. \return its id, ascending
  std::int64_t send(const std::string& robot, autonomy::OrderKind kind, Steady::time_point now);
  /// MISSION of a robot.
  void hear(const std::string& robot, const mission_t& message);
  void step(Steady::time_point now);

  /// Of one of the last orders; unanswered for one that is not known.
  [[nodiscard]] Progress progress(std::int64_t id) const;

 private:
  struct Sent {
    std::string robot;
    autonomy::Order order;
    Progress progress;
    Steady::time_point begun, again;
  };
  static constexpr std::size_t kMost = 256;  // kept to be asked for

  void publish(Sent& sent, Steady::time_point now);

  OrderSenderConfig config_;
  Bus& bus_;
  exchange::Sealer sealer_;
  std::int64_t last_id_ = 0;
  std::map<std::int64_t, Sent> sent_;  // by id
};

/// One that is over: nothing more will be heard of it.
[[nodiscard]] bool is_over(OrderSender::State state);

}  // namespace saker::flight
