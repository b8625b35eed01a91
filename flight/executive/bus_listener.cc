#include "flight/executive/bus_listener.h"

#include <algorithm>
#include <utility>

#include "flight/bus/messages.h"

namespace saker::flight {

BusListener::BusListener(Blackboard& board, Bus& bus) : board_(board) {
  keep<vehicle_state_t>(bus, board_.vehicle);
  keep<verdict_t>(bus, board_.verdict);
  bus.subscribe<command_ack_t>([this](const command_ack_t& message) {
    auto ack = from_lcm(message);
    if (ack) board_.acks.push(std::move(*ack));
    return ack.has_value();
  });
  bus.subscribe<occupancy_t>([this](const occupancy_t& chunk) { return join(chunk); });
}

std::optional<Time> BusListener::at_arrival(Time stamp) {
  const Time now = board_.clock.now();
  if (now == 0) return std::nullopt;
  if (stamp - now > kMostAhead) {
    ++ahead_;
    return std::nullopt;
  }
  return std::min(stamp, now);
}

template <class Message, class Box>
void BusListener::keep(Bus& bus, Box& box) {
  bus.subscribe<Message>([this, &box](const Message& message) {
    auto value = from_lcm(message);
    if (!value) return false;
    if (const auto stamp = at_arrival(value->stamp)) {
      value->stamp = *stamp;
      box.put(std::move(*value));
    }
    return true;
  });
}

bool BusListener::join(const occupancy_t& chunk) {
  if (auto grid = grid_joiner_.add(chunk)) {
    if (const auto stamp = at_arrival(grid->stamp)) {
      grid->stamp = *stamp;
      board_.grid.put(std::move(*grid));
      board_.newest_grid = *stamp;
    }
  }
  return grid_joiner_.accepted();
}

}  // namespace saker::flight
