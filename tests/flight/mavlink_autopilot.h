#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "flight/mavlink/bridge.h"
#include "made_craft.h"
#include "tools/sim/mavlink/autopilot.h"

namespace saker::flight::mavlink {

constexpr Time kMs = kNanosecondsPerSecond / 1000;

/// The simulator's autopilot over a made vehicle on the other end of the line, and an executive's
/// side, in made time. It booted 30 s ago.
class Flown {
 public:
  static constexpr Time kBegin = 100 * kNanosecondsPerSecond, kBoot = 70 * kNanosecondsPerSecond;

  explicit Flown(Autopilot kind, BridgeConfig config = {})
      : Flown(kind, tools::quirks_of(kind), config) {}
  Flown(Autopilot kind, tools::Quirks quirks, BridgeConfig config = {})
      : bridge_((config.autopilot = kind, config)), quirks_(std::move(quirks)) {
    autopilot_.emplace(quirks_, kBoot);
  }

  /// Steps of 10 ms; odometry at 100 Hz, and setpoints where `setpoints` says so.
  void run(Time span) {
    for (const Time end = now_ + span; now_ < end;) {
      now_ += 10 * kMs;
      if (odometry_runs && bridge_lives) say_odometry();
      if (setpoints_run && bridge_lives) say_setpoint();
      if (speaks) fly();
      if (!bridge_lives) continue;
      bridge_.step(now_, 0);
      for (const auto& answer : bridge_.take_answers(now_)) answers.push_back(answer);
      for (const FrameBytes& frame : bridge_.take_frames()) hear(frame);
    }
  }

  void order(CommandKind kind, double height_m = NAN) {
    ++last_id_;
    order_again(kind, height_m);
  }
  /// With the id of the last one.
  void order_again(CommandKind kind, double height_m = NAN) {
    Command command;
    command.stamp = now_;
    command.id = last_id_;
    command.kind = kind;
    command.height_m = height_m;
    bridge_.hear(command, now_);
  }

  /// To `in air`, by the executive's orders.
  void take_off() {
    run(3000 * kMs);
    order(CommandKind::arm);
    run(500 * kMs);
    order(CommandKind::takeoff, 3);
    run(8000 * kMs);
  }

  [[nodiscard]] Bridge& bridge() { return bridge_; }
  [[nodiscard]] tools::SimulatedAutopilot& autopilot() { return *autopilot_; }
  [[nodiscard]] const tools::MadeCraft& craft() const { return craft_; }
  [[nodiscard]] Time now() const { return now_; }
  [[nodiscard]] bool in_air() const { return autopilot_->landed() == Landed::in_air; }
  [[nodiscard]] bool armed() const { return autopilot_->armed(); }
  [[nodiscard]] std::uint32_t mode() const { return autopilot_->mode(); }
  /// All that it knew is gone.
  void reboot() { autopilot_.emplace(quirks_, now_); }
  /// How many of a message were sent so far.
  template <class Message>
  [[nodiscard]] int sent() const {
    int count = 0;
    for (const Frame& frame : heard) count += frame.id == Message::kId;
    return count;
  }
  template <class Message>
  [[nodiscard]] Message last() const {
    for (auto frame = heard.rbegin(); frame != heard.rend(); ++frame)
      if (frame->id == Message::kId) return decode<Message>(frame->bytes());
    return {};
  }

  bool odometry_runs = true, setpoints_run = false, speaks = true;
  bool silent = false;  ///< hears no command
  bool bridge_lives = true;
  bool line_cut = false;         ///< both ways
  bool odometry_stands = false;  ///< the same pose again and again, in flight
  double battery_share = 0.9;
  double odom_offset = 0;
  int reset_counter = 0;
  /// By the bridge, on the line.
  long sent_frames = 0, sent_bytes = 0, received_frames = 0, received_bytes = 0;
  std::vector<saker::CommandAck> answers;
  std::vector<Frame> heard;
  std::vector<std::pair<Time, std::uint16_t>> commands;

 private:
  void fly() {
    craft_.step(0.01);
    tools::CraftState state = craft_.state();
    state.vehicle.battery_share = battery_share;
    autopilot_->step(now_, state);
    craft_.obey(autopilot_->take_orders());
    for (const FrameBytes& frame : autopilot_->take_frames()) {
      ++received_frames;
      received_bytes += static_cast<long>(frame.length);
      if (bridge_lives && !line_cut) bridge_.hear_bytes(frame.span(), now_, 0);
    }
  }

  void say_odometry() {
    VehicleOdometry odometry;
    odometry.stamp = now_;
    if (!odometry_stands) said_ = craft_.place();
    odometry.T_odom_body.translation() = said_ + Eigen::Vector3d(odom_offset, 0, 0);
    odometry.velocity = craft_.velocity();
    odometry.angular_velocity.setZero();
    odometry.covariance = Matrix6d::Identity() * 1e-4;
    odometry.status = VehicleOdometryStatus::ok;
    odometry.reset_counter = reset_counter;
    bridge_.hear(odometry, now_);
  }

  /// Onwards at half a metre a second.
  void say_setpoint() {
    Setpoint setpoint;
    setpoint.stamp = now_;
    setpoint.expiry = now_ + 200 * kMs;
    setpoint.position = craft_.place() + Eigen::Vector3d(odom_offset, 0, 0);
    setpoint.position.z() = 3;
    setpoint.velocity = {0.5, 0, 0};
    setpoint.acceleration.setZero();
    setpoint.yaw = 0;
    setpoint.yaw_rate = 0;
    bridge_.hear(setpoint, now_);
  }

  void hear(const FrameBytes& bytes) {
    ++sent_frames;
    sent_bytes += static_cast<long>(bytes.length);
    if (line_cut) return;
    reader_.push(bytes.span());
    while (const auto frame = reader_.next()) {
      heard.push_back(*frame);
      const bool command = frame->id == CommandLong::kId;
      if (command) commands.emplace_back(now_, decode<CommandLong>(frame->bytes()).command);
      if (!command || !silent) autopilot_->hear_bytes(bytes.span(), now_);
    }
  }

  Bridge bridge_;
  tools::Quirks quirks_;
  std::optional<tools::SimulatedAutopilot> autopilot_;
  tools::MadeCraft craft_;
  FrameReader reader_;
  Eigen::Vector3d said_ = Eigen::Vector3d::Zero();  // by odometry
  Time now_ = kBegin;
  std::int64_t last_id_ = 0;
};

}  // namespace saker::flight::mavlink
