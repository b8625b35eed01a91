#include "tools/sim/real_time.h"

#include <spdlog/spdlog.h>

#include <ctime>
#include <thread>

#include "flight/bus/messages.h"
#include "saker/core/error.h"

namespace saker::tools {
namespace {

constexpr std::chrono::milliseconds kPeriod{2};
constexpr double kMostBehind = 0.1;  ///< s that are caught up with; more are lost
constexpr double kLinger = 2;        ///< s after landing, so that everybody hears of it

double process_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

std::string names_of(std::uint32_t faults) {
  constexpr std::pair<std::uint32_t, const char*> kNames[] = {
      {kNoOdometry, "no odometry"},
      {kOdometryRejected, "odometry rejected"},
      {kSetpointExpired, "setpoint expired"},
      {kBatteryLow, "battery low"},
      {kCollision, "collision"}};
  std::string names;
  for (const auto& [bit, name] : kNames) {
    if ((faults & bit) != 0) names += (names.empty() ? "" : ", ") + std::string(name);
  }
  return names.empty() ? "none" : names;
}

}  // namespace

RealTime::RealTime(simulation::SimulatedVehicle& vehicle, flight::Bus& bus,
                   flight::Presence& presence, const RealTimeOptions& options, MavlinkLine* mavlink)
    : vehicle_(vehicle),
      bus_(bus),
      presence_(presence),
      options_(options),
      mavlink_(mavlink),
      lidar_(options.lidar_port),
      imu_(options.imu_port),
      begin_(vehicle.now()) {
  if (!mavlink_) subscribe();
}

void RealTime::subscribe() {
  const auto pass_on = [this](const auto& message) {
    const auto read = flight::from_lcm(message);
    if (read) vehicle_.send(*read);
    return read.has_value();
  };
  bus_.subscribe<command_t>(pass_on);
  bus_.subscribe<setpoint_t>(pass_on);
  bus_.subscribe<odometry_t>(pass_on);
}

/// To the time that it should be.
void RealTime::advance() {
  const std::chrono::duration<double> wall = Steady::now() - origin_;
  const Time wanted = begin_ + from_seconds(options_.factor * wall.count());
  const Time most = vehicle_.now() + from_seconds(options_.factor * kMostBehind);
  if (wanted > most) {
    const double late = to_seconds(wanted - most) / options_.factor;
    behind_s_ += late;
    origin_ += std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(late));
  }
  vehicle_.step_to(std::min(wanted, most));
}

void RealTime::send_packets() {
  const int lidar_port = vehicle_.sensor().lidar_port;
  for (const simulation::SensorDatagram& datagram : vehicle_.take_packets())
    (datagram.port == lidar_port ? lidar_ : imu_).send(datagram.payload);
}

void RealTime::send_states() {
  for (const CommandAck& ack : vehicle_.take_acks()) {
    spdlog::info("command {}: {}", ack.id, ack.accepted ? "accepted" : "refused: " + ack.reason);
    if (!mavlink_) bus_.publish(flight::to_lcm(ack));
  }
  if (auto state = vehicle_.take_state()) {
    inner_state_ = *state;
    if (mavlink_) state->armed = mavlink_->autopilot().armed();
    log_change(*state);
    last_state_ = *state;
    if (!mavlink_) bus_.publish(flight::to_lcm(*state));
  }
}

void RealTime::serve_mavlink() {
  if (mavlink_ && inner_state_.stamp != 0) mavlink_->step(vehicle_, inner_state_);
}

void RealTime::log_change(const VehicleState& state) {
  const VehicleState& last = last_state_;
  if (state.mode == last.mode && state.faults == last.faults && state.armed == last.armed) return;
  const char* doubt = vehicle_.odometry_doubt();
  const bool rejected = (state.faults & kOdometryRejected) != 0;
  spdlog::info("{}, {}, faults: {}{}", state.armed ? "armed" : "disarmed", to_string(state.mode),
               names_of(state.faults), rejected ? std::string(" (") + doubt + ")" : "");
  if (last.armed && !state.armed && vehicle_.truth().has_flown) disarmed_at_ = vehicle_.now();
}

void RealTime::log_events() {
  const int begun = vehicle_.truth().events_begun;
  if (begun == events_begun_) return;
  events_begun_ = begun;
  spdlog::info("event {} of the scenario", begun);
}

bool RealTime::is_over() const {
  return disarmed_at_ != 0 && to_seconds(vehicle_.now() - disarmed_at_) > kLinger;
}

SimRecorder::Run RealTime::run(SimRecorder& recorder, const std::function<bool()>& stop) {
  const Steady::time_point start = origin_ = Steady::now();
  const double cpu_before = process_seconds();
  Steady::time_point next = start, next_announcement = start;
  while (!stop() && !is_over()) {
    if (bus_.handle(std::chrono::milliseconds{0}) < 0) throw Error("the LCM network is gone");
    advance();
    send_packets();
    send_states();
    serve_mavlink();
    recorder.record(vehicle_, last_state_);
    log_events();
    if (Steady::now() >= next_announcement) {
      presence_.announce();
      next_announcement += flight::Presence::kPeriod;
    }
    next = std::max(next + kPeriod, Steady::now() - kPeriod);
    std::this_thread::sleep_until(next);
  }
  SimRecorder::Run run;
  run.factor = options_.factor;
  run.wall_s = std::chrono::duration<double>(Steady::now() - start).count();
  run.cpu_s = process_seconds() - cpu_before;
  run.behind_s = behind_s_;
  run.packets = lidar_.sent() + imu_.sent();
  run.packets_refused = lidar_.refused() + imu_.refused();
  run.landed = disarmed_at_ != 0;
  return run;
}

}  // namespace saker::tools
