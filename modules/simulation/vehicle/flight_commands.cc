#include "saker/simulation/vehicle/flight_controller.h"

/// How the flight controller answers commands.
namespace saker::simulation {
namespace {

constexpr std::size_t kMostAcks = 64;    ///< that wait to be taken; the oldest go first
constexpr double kMostArmingTilt = 0.3;  ///< rad
constexpr const char* kNotTrusted = "odometry contradicts inertial unit and barometer";

}  // namespace

void FlightController::receive(const Command& command) {
  if (!last_ack_ || command.id != last_ack_->id) {
    const bool old = last_ack_ && command.id < last_ack_->id;
    const char* reason = old ? "older than the last command" : refusal(command);
    const CommandAck ack{now_, command.id, reason == nullptr, reason == nullptr ? "" : reason};
    if (reason == nullptr) obey(command);
    acks_.push_back(ack);
    if (!old) last_ack_ = ack;
  } else {
    acks_.push_back(*last_ack_);
    acks_.back().stamp = now_;
  }
  if (acks_.size() > kMostAcks) acks_.pop_front();
}

std::vector<CommandAck> FlightController::take_acks() {
  std::vector<CommandAck> taken(acks_.begin(), acks_.end());
  acks_.clear();
  return taken;
}

const char* FlightController::arm_refusal() const {
  if (armed_) return nullptr;
  if (!estimator_.inertial().ready()) return "no inertial readings or no barometer";
  if ((estimator_.faults() & kNoOdometry) != 0) return "no odometry";
  if ((estimator_.faults() & kOdometryRejected) != 0) return kNotTrusted;
  if (battery_share_ < config_.battery_low) return "battery low";
  const double upright = estimator_.inertial().attitude()(2, 2);
  return upright < std::cos(kMostArmingTilt) ? "not level" : nullptr;
}

const char* FlightController::takeoff_refusal(double height_m) const {
  if (!armed_) return "not armed";
  if (flying()) return "in flight already";
  if (!estimator_.trusted()) return "no odometry";
  const bool possible = height_m >= config_.least_takeoff_m && height_m <= config_.most_takeoff_m;
  return possible ? nullptr : "height out of its limits";
}

const char* FlightController::refusal(const Command& command) const {
  switch (command.kind) {
    case CommandKind::arm:
      return arm_refusal();
    case CommandKind::disarm:
      return flying() ? "in flight" : nullptr;
    case CommandKind::takeoff:
      return takeoff_refusal(command.height_m);
    case CommandKind::hold:
      if (!flying()) return "on the ground";
      return mode_ == VehicleMode::descend ? "no odometry to hold by" : nullptr;
    case CommandKind::land:
      return flying() ? nullptr : "on the ground";
    case CommandKind::resume:
      return "nobody took it over";
  }
  return "unknown command";
}

void FlightController::obey(const Command& command) {
  switch (command.kind) {
    case CommandKind::arm:
      if (armed_) return;
      armed_ = true;
      armed_height_ = estimator_.inertial().height();
      return enter(VehicleMode::idle);
    case CommandKind::disarm:
      return disarm();
    case CommandKind::takeoff:
      return start_takeoff(command.height_m);
    case CommandKind::hold:
      setpoints_after_ = command.stamp;
      return enter(VehicleMode::hold);
    case CommandKind::land:
      if (mode_ != VehicleMode::descend) enter(VehicleMode::land);
      return;
    case CommandKind::resume:
      return;
  }
}

void FlightController::start_takeoff(double height_m) {
  controller_.forget();
  reference_ = {};
  reference_.position = estimator_.odometry().position();
  reference_.yaw = core::yaw(estimator_.odometry().attitude());
  takeoff_to_ = reference_.position.z() + height_m;
  enter(VehicleMode::takeoff);
}

}  // namespace saker::simulation
