#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <initializer_list>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "flight/bus/channels.h"
#include "flight/bus/priority_mutex.h"
#include "saker/core/config.h"

namespace saker::flight {

struct BusConfig {
  std::string control_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string bulk_url = "udpm://239.255.76.67:7668?ttl=0";
  int receive_buffer_kb = 2048;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("control_url", control_url, "",
              "LCM network of all channels but scans and occupancy: never leaves the machine.");
    v.setting("bulk_url", bulk_url, "",
              "LCM network of scans and occupancy: another port, never leaves the machine.");
    v.setting("receive_buffer_kb", receive_buffer_kb, {64, 1 << 20}, "kB",
              "Each socket has a receive buffer of this size; a scan of 64x1024 is 0.4 MB.");
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
  /// The same for the messages of every robot.
  template <class Message>
  using HandlerOfAll = std::function<bool(const std::string& robot, const Message&)>;
  /// Of whatever is on a channel.
  using Bytes = std::span<const std::uint8_t>;
  using RawHandler = std::function<bool(const std::string& channel, Bytes bytes)>;

  struct Counters {
    std::string channel;
    long received = 0;   ///< whole ones
    long malformed = 0;  ///< another type, another version or cut
    long refused = 0;    ///< by the handler
  };

  /// Throws Error in one line when the robot's name is not of capitals and digits, when messages
  /// would leave the machine, when there is no multicast route (it names the command that mends it)
  /// or no large enough receive buffer. What other machines send does not come in, on whatever
  /// interface (multicast.h).
  Bus(const BusConfig& config, const std::string& robot);

  /// The control network alone, checked as by the constructor: scans cost to receive, and some have
  /// nothing to do with them.
  [[nodiscard]] static Bus of_control(const BusConfig& config, const std::string& robot);

  /// One network alone: what belongs to the bulk network goes there too. Throws as the constructor,
  /// but for a network that is to leave the machine (ttl above 0): that one hears others as well.
  [[nodiscard]] static Bus on_network(const std::string& url, int receive_buffer_kb,
                                      const std::string& robot);

  /// The twin without a network, for tests of logic: hears what it publishes itself.
  [[nodiscard]] static Bus in_memory(const std::string& robot);

  template <class Message>
  void subscribe(Handler<Message> handler);
  template <class Message>
  void subscribe_all(HandlerOfAll<Message> handler);
  /// Bytes as they are: of every robot's channel that ends in `suffix` ("_STATE"), on control.
  void subscribe_raw(const std::string& suffix, RawHandler handler);

  /// False when the network does not take it. Blocks no longer than the kernel's copy: its own, and
  /// that of another thread, which has this one's priority meanwhile.
  template <class Message>
  bool publish(const Message& message) {
    return publish_as(robot_, message);
  }
  /// On the channel of another robot.
  template <class Message>
  bool publish_as(const std::string& robot, const Message& message);
  bool publish_raw(const std::string& channel, Bytes bytes);

  /// Messages of up to so many bytes are published without allocating: what guidance and safety
  /// say, and poses.
  static constexpr std::size_t kSmall = 512;
  static constexpr int kMostAtOnce = 1024;  ///< of a network

  /// Waits up to `timeout` for the first message, then handles what is there, `most` of each
  /// network; how many. A negative number: the network is gone.
  int handle(std::chrono::milliseconds timeout, int most = kMostAtOnce) {
    return handle({this}, timeout, -1, most);
  }
  /// The same for several at once, of which null ones are none. Returns, too, when there is
  /// something to read on the descriptor `other`.
  static int handle(std::initializer_list<Bus*> buses, std::chrono::milliseconds timeout,
                    int other = -1, int most = kMostAtOnce);

  [[nodiscard]] const std::string& robot() const { return robot_; }
  /// One entry a subscription. To be called by any thread.
  [[nodiscard]] std::vector<Counters> counters() const;

 private:
  using Decode =
      std::function<bool(const lcm::ReceiveBuffer&, const std::string& channel, bool& refused)>;

  struct Subscription {
    std::string channel;
    Decode decode;
    std::atomic<long> received = 0, malformed = 0, refused = 0;
  };

  Bus(std::unique_ptr<lcm::LCM> control, std::unique_ptr<lcm::LCM> bulk, const std::string& robot);

  template <class Message>
  static bool decoded(const lcm::ReceiveBuffer& bytes, Message& message) {
    return message.decode(bytes.data, 0, static_cast<int>(bytes.data_size)) >= 0;
  }
  static void on_message(const lcm::ReceiveBuffer* bytes, const std::string& channel,
                         Subscription* subscription);
  void subscribe(Network network, const std::string& channel, Decode decode);
  [[nodiscard]] lcm::LCM& on(Network network) {
    return network == Network::control || !bulk_ ? *control_ : *bulk_;
  }

  bool send(Network network, const char* channel, Bytes bytes);

  std::string robot_;
  std::unique_ptr<lcm::LCM> control_, bulk_;  // bulk_ is null in memory
  // Of each network: LCM's own lock lends nobody its priority, so that one is taken before it.
  std::unique_ptr<std::array<PriorityMutex, 2>> sending_ =
      std::make_unique<std::array<PriorityMutex, 2>>();
  std::vector<std::unique_ptr<Subscription>> subscriptions_;
};

template <class Message>
void Bus::subscribe(Handler<Message> handler) {
  subscribe(kChannel<Message>.network, channel_name<Message>(robot_),
            [handler = std::move(handler)](const lcm::ReceiveBuffer& bytes, const std::string&,
                                           bool& refused) {
              Message message{};
              if (!decoded(bytes, message)) return false;
              refused = !handler(message);
              return true;
            });
}

template <class Message>
void Bus::subscribe_all(HandlerOfAll<Message> handler) {
  subscribe(kChannel<Message>.network, kAnyRobot + channel_name<Message>(""),
            [handler = std::move(handler)](const lcm::ReceiveBuffer& bytes,
                                           const std::string& channel, bool& refused) {
              Message message{};
              if (!decoded(bytes, message)) return false;
              refused = !handler(robot_of(channel), message);
              return true;
            });
}

template <class Message>
bool Bus::publish_as(const std::string& robot, const Message& message) {
  const auto size = static_cast<std::size_t>(message.getEncodedSize());
  std::array<std::uint8_t, kSmall> small;
  std::vector<std::uint8_t> large(size > kSmall ? size : 0);
  std::uint8_t* const bytes = large.empty() ? small.data() : large.data();
  if (message.encode(bytes, 0, static_cast<int>(size)) < 0) return false;
  return send(kChannel<Message>.network, ChannelName(robot, kChannel<Message>.suffix).c_str(),
              {bytes, size});
}

}  // namespace saker::flight
