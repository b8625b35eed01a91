#include "flight/bus/bus.h"

#include <poll.h>

#include <algorithm>
#include <exception>
#include <mutex>
#include <regex>

#include "flight/bus/multicast.h"
#include "flight/bus/priority.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

// LCM drops the newest message of a full queue; `handle` drains, so that this many are a burst.
constexpr int kQueueCapacity = 256;
constexpr int kReceiverPriority = 52;  // of LCM's thread: above those who read what it copies

void check_network(const std::string& url, int buffer_kb) {
  const MulticastGroup group = multicast_group(url);
  if (const std::string fault = multicast_fault(group); !fault.empty()) {
    throw Error("no multicast to " + group.address + " (" + fault +
                "), mend with: " + multicast_remedy(group));
  }
  const int granted = granted_receive_buffer(buffer_kb * 1024);
  if (granted < buffer_kb * 1024) {
    throw Error("a socket's receive buffer is " + std::to_string(granted / 1024) +
                " kB, expected " + std::to_string(buffer_kb) +
                " kB, mend with: sysctl -w net.core.rmem_max=" + std::to_string(buffer_kb * 1024));
  }
}

std::unique_ptr<lcm::LCM> opened(const std::string& url, int buffer_kb) {
  check_network(url, buffer_kb);
  const std::string separator = url.find('?') == std::string::npos ? "?" : "&";
  auto network = std::make_unique<lcm::LCM>(url + separator +
                                            "recv_buf_size=" + std::to_string(buffer_kb * 1024));
  // Asking for the descriptor starts the receiver and its test. It only copies, and must not wait.
  const RaisedPriority raised(kReceiverPriority);
  if (!network->good() || network->getFileno() < 0) {
    throw Error("LCM cannot be opened on " + url + "; saker doctor says more");
  }
  if (stays_on_machine(url)) hear_this_machine_alone(multicast_group(url).port);
  return network;
}

/// Of a network with a message. How many were handled; negative: the network is gone.
int drain(lcm::LCM& network, int most) {
  if (network.handle() < 0) return -1;
  for (int handled = 1; handled < most; ++handled) {
    const int status = network.handleTimeout(0);
    if (status < 0) return -1;
    if (status == 0) return handled;
  }
  return most;
}

const std::string& checked_name(const std::string& robot) {
  static const std::regex kName(kAnyRobot);
  if (std::regex_match(robot, kName)) return robot;
  throw Error("robot " + robot + ", expected up to 16 capitals and digits, as in R1");
}

}  // namespace

Bus::Bus(const BusConfig& config, const std::string& robot)
    : Bus(nullptr, nullptr, checked_name(robot)) {
  const BusConfig valid = core::checked(config, "bus");
  require_on_machine("bus.control_url", valid.control_url);
  require_on_machine("bus.bulk_url", valid.bulk_url);
  control_ = opened(valid.control_url, valid.receive_buffer_kb);
  bulk_ = opened(valid.bulk_url, valid.receive_buffer_kb);
}

Bus::Bus(std::unique_ptr<lcm::LCM> control, std::unique_ptr<lcm::LCM> bulk,
         const std::string& robot)
    : robot_(checked_name(robot)), control_(std::move(control)), bulk_(std::move(bulk)) {}

Bus Bus::of_control(const BusConfig& config, const std::string& robot) {
  const BusConfig valid = core::checked(config, "bus");
  require_on_machine("bus.control_url", valid.control_url);
  return on_network(valid.control_url, valid.receive_buffer_kb, robot);
}

Bus Bus::on_network(const std::string& url, int receive_buffer_kb, const std::string& robot) {
  return Bus(opened(url, receive_buffer_kb), nullptr, robot);
}

Bus Bus::in_memory(const std::string& robot) {
  return Bus(std::make_unique<lcm::LCM>("memq://"), nullptr, robot);
}

void Bus::subscribe(Network network, const std::string& channel, Decode decode) {
  auto subscription = std::make_unique<Subscription>();
  subscription->channel = channel;
  subscription->decode = std::move(decode);
  lcm::Subscription* const handle =
      on(network).subscribeFunction(channel, &Bus::on_message, subscription.get());
  handle->setQueueCapacity(kQueueCapacity);
  subscriptions_.push_back(std::move(subscription));
}

void Bus::subscribe_raw(const std::string& suffix, RawHandler handler) {
  subscribe(Network::control, kAnyRobot + suffix,
            [handler = std::move(handler)](const lcm::ReceiveBuffer& bytes,
                                           const std::string& channel, bool& refused) {
              const auto* data = static_cast<const std::uint8_t*>(bytes.data);
              refused = !handler(channel, {data, bytes.data_size});
              return true;
            });
}

bool Bus::publish_raw(const std::string& channel, Bytes bytes) {
  return send(Network::control, channel.c_str(), bytes);
}

bool Bus::send(Network network, const char* channel, Bytes bytes) {
  const std::lock_guard lock((*sending_)[network == Network::control ? 0 : 1]);
  return lcm_publish(on(network).getUnderlyingLCM(), channel, bytes.data(),
                     static_cast<unsigned int>(bytes.size())) == 0;
}

void Bus::on_message(const lcm::ReceiveBuffer* bytes, const std::string& channel,
                     Subscription* subscription) {
  bool refused = false;
  bool whole = false;
  try {
    whole = subscription->decode(*bytes, channel, refused);
  } catch (const std::exception&) {  // memory that cannot be had must not end the process
  }
  ++(whole ? subscription->received : subscription->malformed);
  if (refused) ++subscription->refused;
}

int Bus::handle(std::initializer_list<Bus*> buses, std::chrono::milliseconds timeout, int other,
                int most) {
  std::vector<lcm::LCM*> networks;
  std::vector<pollfd> ready;
  for (Bus* const bus : buses) {
    for (lcm::LCM* const network : {bus ? bus->control_.get() : nullptr,  //
                                    bus ? bus->bulk_.get() : nullptr}) {
      if (network == nullptr) continue;
      networks.push_back(network);
      ready.push_back({network->getFileno(), POLLIN, 0});
    }
  }
  ready.push_back({other, POLLIN, 0});  // a negative one is none
  const auto wait = static_cast<int>(std::max<std::int64_t>(0, timeout.count()));
  if (::poll(ready.data(), ready.size(), wait) <= 0) return 0;
  int handled = 0;
  for (std::size_t i = 0; i < networks.size(); ++i) {
    if (ready[i].revents == 0) continue;
    const int count = drain(*networks[i], most);
    if (count < 0) return -1;
    handled += count;
  }
  return handled;
}

std::vector<Bus::Counters> Bus::counters() const {
  std::vector<Counters> result;
  for (const auto& s : subscriptions_) {
    result.push_back({s->channel, s->received, s->malformed, s->refused});
  }
  return result;
}

}  // namespace saker::flight
