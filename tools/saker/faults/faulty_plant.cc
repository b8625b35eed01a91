#include "tools/saker/faults/faulty_plant.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "saker/lidar/imu_packet.h"

namespace saker::tools {
namespace {

constexpr double kLeastLeft = 0.05;  // of the charge: with less the rotors stop, and nothing helps

}  // namespace

FaultyPlant::FaultyPlant(simulation::SimulatedVehicle& vehicle, const FaultSchedule& schedule,
                         Ears ears)
    : vehicle_(vehicle),
      plant_(vehicle),
      schedule_(schedule),
      ears_(std::move(ears)),
      begin_(vehicle.now()),
      packet_faults_(schedule, vehicle.sensor()),
      rng_(11),
      lidar_(schedule, FaultPlace::lidar),
      imu_(schedule, FaultPlace::imu),
      states_(schedule, FaultPlace::state),
      acks_(schedule, FaultPlace::ack),
      odometry_(schedule, FaultPlace::odometry),
      setpoints_(schedule, FaultPlace::setpoint),
      commands_(schedule, FaultPlace::command) {}

void FaultyPlant::step_to(Time time) {
  plant_.step_to(time);
  deliver();
  const double t_s = mission_s();
  if (const auto state = plant_.take_state()) {
    state_ = *state;
    states_.put(t_s, told(*state));
  }
  for (CommandAck& ack : plant_.take_acks()) {
    ears_.ack(ack);
    acks_.put(t_s, std::move(ack));
  }
  for (autonomy::SensorPacket& packet : plant_.take_packets()) {
    auto& line = lidar::is_imu_packet(packet.payload) ? imu_ : lidar_;
    packet_faults_.apply(t_s, packet.payload);
    for (auto& other : packet_faults_.company(t_s, packet.payload)) {
      line.put(t_s, {packet.received, std::move(other)});
    }
    line.put(t_s, std::move(packet));
  }
  ears_.step(vehicle_.truth(), state_);
}

/// As the flight controller's messages say it where they fail.
VehicleState FaultyPlant::told(VehicleState state) {
  const double t_s = mission_s();
  if (const Fault* drop = acting(schedule_, FaultKind::battery_drop, FaultPlace::none, t_s)) {
    state.battery_share = std::max(kLeastLeft, state.battery_share - drop->strength);
  }
  if (acts(FaultKind::battery_unknown)) state.battery_share = NAN;
  if (acts(FaultKind::stick, FaultPlace::state)) {
    if (!stuck_state_) stuck_state_ = state;
    const Time stamp = state.stamp;
    state = *stuck_state_;
    state.stamp = stamp;
  } else {
    stuck_state_.reset();
  }
  const Fault* nonsense = acting(schedule_, FaultKind::garbage, FaultPlace::state, t_s);
  if (nonsense == nullptr || !rng_.chance(nonsense->strength)) return state;
  state.attitude.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
  state.height_m = rng_.chance(0.5) ? NAN : rng_.uniform(-1e6, 1e6);
  state.battery_share = rng_.chance(0.5) ? NAN : rng_.uniform(-10, 10);
  return state;
}

std::vector<autonomy::SensorPacket> FaultyPlant::take_packets() {
  const double t_s = mission_s();
  std::vector<autonomy::SensorPacket> packets = imu_.take(t_s);
  for (autonomy::SensorPacket& packet : lidar_.take(t_s)) packets.push_back(std::move(packet));
  std::ranges::stable_sort(packets, {}, &autonomy::SensorPacket::received);
  return packets;
}

std::optional<VehicleState> FaultyPlant::take_state() {
  const std::vector<VehicleState> states = states_.take(mission_s());
  return states.empty() ? std::nullopt : std::optional(states.back());
}

std::vector<CommandAck> FaultyPlant::take_acks() { return acks_.take(mission_s()); }

void FaultyPlant::send(const VehicleOdometry& odometry) {
  ears_.odometry(odometry);
  VehicleOdometry sent = odometry;
  if (acts(FaultKind::stick, FaultPlace::odometry)) {
    if (!stuck_odometry_) stuck_odometry_ = odometry;
    sent = *stuck_odometry_;
    sent.stamp = odometry.stamp;
  } else {
    stuck_odometry_.reset();
  }
  odometry_.put(mission_s(), sent);
  deliver();
}

void FaultyPlant::send(const Setpoint& setpoint) {
  setpoints_.put(mission_s(), setpoint);
  deliver();
}

void FaultyPlant::send(const Command& command) {
  commands_.put(mission_s(), command);
  deliver();
}

void FaultyPlant::deliver() {
  const double t_s = mission_s();
  for (const VehicleOdometry& odometry : odometry_.take(t_s)) plant_.send(odometry);
  for (const Setpoint& setpoint : setpoints_.take(t_s)) plant_.send(setpoint);
  for (const Command& command : commands_.take(t_s)) plant_.send(command);
}

}  // namespace saker::tools
