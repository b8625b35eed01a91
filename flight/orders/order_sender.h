#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "flight/bus/bus.h"
#include "flight/orders/order_messages.h"

/// The ground's end of orders: seals them, sends them until MISSION acknowledges them.
namespace saker::flight {

struct OrderSenderConfig {
  std::chrono::milliseconds repeat{300};     ///< messages get lost
  std::chrono::milliseconds deadline{5000};  ///< for the acknowledgement
};

/// Where an installed base has its key, and its processes what they keep (docs/deploy.md).
struct InstalledBase {
  std::filesystem::path key = "/etc/saker/team.key";
  std::filesystem::path folder = "/var/lib/saker";
};

struct SenderFiles {
  std::filesystem::path key;
  std::filesystem::path folder;  ///< of the seal's epochs
};

/// Of who orders by hand: the key that is configured or, where that is not there, the installed
/// base's; what else this team's member keeps or, without that, the installed base's folder beside
/// its key, the folder of any other key.
[[nodiscard]] SenderFiles sender_files(const std::filesystem::path& key,
                                       const std::filesystem::path& folder,
                                       const InstalledBase& installed = {});

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
  /// \param key_file  read again before an order where it was written since: a key was renewed
  /// \param name  under which this process seals, of its own in the team: capitals and digits
  /// \param folder  where the seal's epoch is kept, as order-NAME.epoch; has to exist
  /// Throws Error where key or folder cannot be used.
  OrderSender(const OrderSenderConfig& config, Bus& bus, std::filesystem::path key_file,
              const std::string& name, const std::filesystem::path& folder);

  /// Sends it at once and, by `step`, again. \return its id, ascending
  std::int64_t send(const std::string& robot, autonomy::OrderKind kind, Steady::time_point now);
  /// MISSION of a robot.
  void hear(const std::string& robot, const mission_t& message);
  /// ORDER of whoever is on this network. Of two processes of one name robots believe the one that
  /// began last: this one's open orders are overtaken; with its next order it is the last.
  void hear(const std::string& robot, const order_t& message);
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

  /// Which file it is, and when it was written.
  using KeyFile = std::array<std::int64_t, 3>;

  void publish(Sent& sent, Steady::time_point now);
  void begin_life();
  void renew_life();
  [[nodiscard]] KeyFile key_there() const;

  OrderSenderConfig config_;
  Bus& bus_;
  std::filesystem::path key_file_;
  std::string name_;
  std::filesystem::path folder_;
  KeyFile key_read_;
  std::unique_ptr<exchange::Sealer> sealer_;
  bool superseded_ = false;  // by another process of this name
  std::int64_t last_id_ = 0;
  std::map<std::int64_t, Sent> sent_;  // by id
};

/// One that is over: nothing more will be heard of it.
[[nodiscard]] bool is_over(OrderSender::State state);

}  // namespace saker::flight
