#include <tuple>
#include <utility>

#include "flight/bus/exchange_messages.h"
#include "flight/bus/messages.h"
#include "flight/bus/object_messages.h"
#include "flight/orders/order_messages.h"
#include "fuzz.h"
#include "lcm_bytes.h"
#include "saker/objects/class_table.h"

/// Every message of LCM: the first byte chooses its type, the others are the message. What can be
/// read can be said again, and read again.
namespace saker {
namespace {

using namespace flight;
using lidar::fuzz::expect;

using Messages = std::tuple<vehicle_state_t, command_t, command_ack_t, setpoint_t, odometry_t,
                            trajectory_t, verdict_t, map_object_t, detections_t, object_map_t,
                            mission_t, exchange_t, order_t, plan_t, health_t, presence_t>;

const int kClasses = objects::ClassTable().size();

/// Of most types: as it came, said and read once more.
template <class Message>
void convert(const Message& message) {
  if constexpr (requires { from_lcm(message); }) {
    const auto read = from_lcm(message);
    if constexpr (requires { to_lcm(*read); }) {
      if (read) expect(from_lcm(to_lcm(*read)).has_value());
    }
  }
}

void convert(const trajectory_t& message) {
  const auto trajectory = from_lcm(message);
  if (!trajectory) return;
  expect(trajectory->end() >= trajectory->start);
  const auto again = to_lcm(*trajectory, 0);
  expect(again.has_value() && from_lcm(*again).has_value());
}

void convert(const map_object_t& message) {
  const auto object = from_lcm(message, kClasses);
  if (object) expect(from_lcm(to_lcm(*object), kClasses).has_value());
}

void convert(const detections_t& message) {
  const auto detections = from_lcm(message, kClasses);
  if (detections) expect(from_lcm(to_lcm(*detections), kClasses).has_value());
}

void convert(const object_map_t& message) {
  constexpr std::size_t kMost = 10;
  objects::ObjectMap map;
  (void)merge(message, kClasses, kMost, map);
  (void)merge(message, kClasses, kMost, map);
  expect(map.objects.size() <= kMost);
}

void convert(const mission_t& message) {
  const auto reply = reply_of(message);
  if (!reply) return;
  mission_t again{};
  write_reply(*reply, again);
  expect(reply_of(again).has_value());
}

void convert(const exchange_t& message) {
  expect(datagram_of(message).size() == static_cast<std::size_t>(message.num_data));
}

template <class Message>
void hear(lidar::ByteView body) {
  const auto message = lidar::fuzz::decoded<Message>(body);
  if (!message) return;
  const auto again = lidar::fuzz::body_of(*message);
  expect(again.size() <= body.size());
  convert(*message);
}

template <std::size_t... I>
void hear_one(std::size_t which, lidar::ByteView body, std::index_sequence<I...>) {
  ((which == I ? hear<std::tuple_element_t<I, Messages>>(body) : void()), ...);
}

}  // namespace

void lidar::fuzz::run(ByteView input) {
  constexpr std::size_t kTypes = std::tuple_size_v<Messages>;
  if (input.empty()) return;
  hear_one(input[0] % kTypes, input.subspan(1), std::make_index_sequence<kTypes>());
}

}  // namespace saker
