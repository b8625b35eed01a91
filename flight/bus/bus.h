#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bus/channels.h"
#include "core/config.h"

namespace saker::flight {

struct BusConfig {
  std::string control_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string bulk_url = "udpm://239.255.76.67:7668?ttl=0";
  int receive_buffer_kb = 2048;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("control_url", control_url, "",
            "LCM network of all channels but scans and occupancy; ttl=1 reaches other machines");
    v.field("bulk_url", bulk_url, "",
            "LCM network of scans and occupancy; another port, never leaves the machine");
    v.field("receive_buffer_kb", receive_buffer_kb, {64, 1 << 20}, "kB",
            "of each socket; a scan of 64x1024 is 0.4 MB at once, two and a block of occupancy "
            "wait while a reader is busy");
  }
};

/// The LCM networks of one robot: a channel a message type (channels.h).
///
/// Subscribe first, then let one thread call `handle`: the handlers run there and only put what
/// they decode into mailboxes and queues. Any thread may publish. After the constructor nothing
/// throws: what cannot be decoded and what a handler refuses is counted and forgotten.
class Bus {
 public:
  /// What a handler is given is not what it expects when it returns false.
  template <class Message>
  using Handler = std::function<bool(const Message&)>;

  struct Counters {
    std::string channel;
    long received = 0;   ///< whole ones
    long malformed = 0;  ///< another type, another version or cut
    long refused = 0;    ///< by the handler
  };

  /// Throws Error in one line when the robot's name is not of capitals and digits, when there is no
  /// multicast route (it names the command that mends it) or no large enough receive buffer.
  Bus(const BusConfig& config, const std::string& robot);

  /// The twin without a network, for tests of logic: hears what it publishes itself.
  [[nodiscard]] static Bus in_memory(const std::string& robot);

  template <class Message>
  void subscribe(Handler<Message> handler);

  /// False when the network does not take it. Blocks no longer than the kernel's copy.
  template <class Message>
  bool publish(const Message& message);

  /// Waits up to `timeout` for the first message, then handles all that is there; how many. A
  /// negative number: the network is gone.
  int handle(std::chrono::milliseconds timeout);

  [[nodiscard]] const std::string& robot() const { return robot_; }
  /// One entry a subscription. To be called by any thread.
  [[nodiscard]] std::vector<Counters> counters() const;

 private:
  struct Subscription {
    std::string channel;
    std::function<bool(const lcm::ReceiveBuffer&, bool& refused)> decode;
    std::atomic<long> received = 0, malformed = 0, refused = 0;
  };

  Bus(std::unique_ptr<lcm::LCM> control, std::unique_ptr<lcm::LCM> bulk, const std::string& robot);

  static void on_message(const lcm::ReceiveBuffer* bytes, const std::string& channel,
                         Subscription* subscription);
  void subscribe(Network network, std::unique_ptr<Subscription> subscription);
  [[nodiscard]] lcm::LCM& on(Network network) {
    return network == Network::control || !bulk_ ? *control_ : *bulk_;
  }

  std::string robot_;
  std::unique_ptr<lcm::LCM> control_, bulk_;  // bulk_ is null in memory
  std::vector<std::unique_ptr<Subscription>> subscriptions_;
};

template <class Message>
void Bus::subscribe(Handler<Message> handler) {
  auto subscription = std::make_unique<Subscription>();
  subscription->channel = channel_name<Message>(robot_);
  subscription->decode = [handler = std::move(handler)](const lcm::ReceiveBuffer& bytes,
                                                        bool& refused) {
    Message message{};
    if (message.decode(bytes.data, 0, static_cast<int>(bytes.data_size)) < 0) return false;
    refused = !handler(message);
    return true;
  };
  subscribe(kChannel<Message>.network, std::move(subscription));
}

template <class Message>
bool Bus::publish(const Message& message) {
  return on(kChannel<Message>.network).publish(channel_name<Message>(robot_), &message) == 0;
}

}  // namespace saker::flight
