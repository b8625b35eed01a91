#pragma once

#include <deque>
#include <string>
#include <vector>

#include "flight/mavlink/bridge.h"

namespace saker::flight::mavlink {

constexpr Time kMs = kNanosecondsPerSecond / 1000;

/// An autopilot's side of the line and an executive's, in made time: modes, arming, a take-off that
/// setpoints cancel, acknowledgements, HEARTBEAT at 1 Hz and at each change, as recorded.
class Flown {
 public:
  explicit Flown(Autopilot kind, BridgeConfig config = {})
      : dialect_(dialect_of(kind)), bridge_((config.autopilot = kind, config)) {}

  /// Steps of 10 ms; odometry at 100 Hz, and setpoints where `setpoints` says so.
  void run(Time span) {
    for (const Time end = now_ + span; now_ < end;) {
      now_ += 10 * kMs;
      if (odometry_runs) say_odometry();
      if (setpoints_run) say_setpoint();
      if (speaks) say_state();
      bridge_.step(now_, 0);
      for (const auto& answer : bridge_.take_answers(now_)) answers.push_back(answer);
      for (const FrameBytes& frame : bridge_.take_frames()) hear(frame);
    }
  }

  void order(CommandKind kind, double height_m = NAN) {
    Command command;
    command.stamp = now_;
    command.id = ++last_id_;
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

  void text(int severity, const std::string& words) {
    Statustext message;
    message.severity = static_cast<std::uint8_t>(severity);
    write_text(words, message.text);
    say(message);
  }
  void change_mode(std::uint32_t mode, std::uint8_t status = 4) {
    custom_mode = mode;
    system_status = status;
    say_heartbeat();
  }

  [[nodiscard]] Bridge& bridge() { return bridge_; }
  [[nodiscard]] Time now() const { return now_; }
  [[nodiscard]] bool in_air() const { return landed == Landed::in_air; }
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
  bool armed = false, takeoff_cancelled = false;
  std::uint32_t custom_mode = 0;
  std::uint8_t system_status = 3;
  Landed landed = Landed::on_ground;
  double height = 0, north = 0;
  int reset_counter = 0;
  std::vector<std::string> refuse_arming;  ///< causes, one a try
  std::vector<saker::CommandAck> answers;
  std::vector<Frame> heard;
  std::vector<std::pair<Time, std::uint16_t>> commands;

 private:
  template <class Message>
  void say(const Message& message) {
    const auto frame = writer_.write(message);
    bridge_.hear_bytes(frame->span(), now_, 0);
  }

  void say_heartbeat() {
    Heartbeat message;
    message.autopilot = dialect_.heartbeat_kind;
    message.custom_mode = custom_mode;
    message.base_mode = static_cast<std::uint8_t>(kCustomModeFlag | (armed ? kArmedFlag : 0));
    message.system_status = system_status;
    say(message);
  }

  void say_state() {
    fly();
    if (now_ % (1000 * kMs) == 0) say_heartbeat();
    if (now_ % (200 * kMs) != 0) return;
    ExtendedSysState state;
    state.landed_state = static_cast<std::uint8_t>(landed);
    say(state);
  }

  void fly() {
    const bool landing = armed && custom_mode == dialect_.land.custom;
    if (landing && landed != Landed::on_ground) landed = Landed::landing;
    if (landed == Landed::takeoff) height += 0.01;
    if (landed == Landed::landing) height -= 0.02;
    if (landed == Landed::takeoff && height >= target_ && dialect_.own_takeoff)
      landed = Landed::in_air;
    if (landed == Landed::landing && height <= 0) {
      landed = Landed::on_ground;
      armed = false;
      say_heartbeat();
    }
  }

  void say_odometry() {
    VehicleOdometry odometry;
    odometry.stamp = now_;
    odometry.T_odom_body.translation() = Eigen::Vector3d(north + odom_offset, 0, height);
    odometry.velocity.setZero();
    odometry.angular_velocity.setZero();
    odometry.covariance = Matrix6d::Identity() * 1e-4;
    odometry.status = VehicleOdometryStatus::ok;
    odometry.reset_counter = reset_counter;
    bridge_.hear(odometry, now_);
  }

  void say_setpoint() {
    Setpoint setpoint;
    setpoint.stamp = now_;
    setpoint.expiry = now_ + 200 * kMs;
    setpoint.position = {north + odom_offset, 0, 3};
    setpoint.velocity = {0.5, 0, 0};
    setpoint.acceleration.setZero();
    setpoint.yaw = 0;
    setpoint.yaw_rate = 0;
    bridge_.hear(setpoint, now_);
  }

  void hear(const FrameBytes& bytes) {
    reader_.push(bytes.span());
    while (const auto frame = reader_.next()) {
      heard.push_back(*frame);
      if (frame->id == CommandLong::kId) obey(decode<CommandLong>(frame->bytes()));
      if (frame->id != SetPositionTargetLocalNed::kId) continue;
      last_setpoint_ = now_;
      if (dialect_.own_takeoff && landed == Landed::takeoff) takeoff_cancelled = true;
      if (!dialect_.own_takeoff && armed && custom_mode == dialect_.guided.custom) climb(*frame);
    }
  }

  void climb(const Frame& frame) {
    height = -static_cast<double>(decode<SetPositionTargetLocalNed>(frame.bytes()).z);
    if (height > 0.1) landed = Landed::in_air;
  }

  void obey(const CommandLong& command) {
    commands.emplace_back(now_, command.command);
    flight::mavlink::CommandAck ack;
    ack.command = command.command;
    ack.target_system = 255;
    ack.target_component = 191;
    if (silent) return;
    if (command.command == kArmDisarm) {
      if (!refuse_arming.empty()) {
        text(2, refuse_arming.front());
        refuse_arming.erase(refuse_arming.begin());
        ack.result = 4;
        return say(ack);
      }
      armed = command.param1 == 1;
    }
    if (command.command == kNavTakeoff) {
      landed = Landed::takeoff;
      target_ = static_cast<double>(command.param7);
    }
    if (command.command == kDoSetMode) set_mode(command, ack);
    say(ack);
    if (command.command != kSetMessageInterval) say_heartbeat();
  }

  /// PX4 takes offboard only after setpoints.
  void set_mode(const CommandLong& command, flight::mavlink::CommandAck& ack) {
    for (const ModeNumber& mode : {dialect_.guided, dialect_.hold, dialect_.land})
      if (command.param2 == mode.main && command.param3 == mode.sub) custom_mode = mode.custom;
    if (custom_mode == dialect_.guided.custom && !dialect_.own_takeoff &&
        now_ - last_setpoint_ > 500 * kMs) {
      ack.result = 1;
      custom_mode = dialect_.hold.custom;
    }
  }

 public:
  bool silent = false;  ///< answers no command
  double odom_offset = 0;

 private:
  Dialect dialect_;
  Bridge bridge_;
  FrameReader reader_;
  FrameWriter writer_{1, 1};
  Time now_ = 10 * kNanosecondsPerSecond;
  Time last_setpoint_ = 0;
  double target_ = 0;
  std::int64_t last_id_ = 0;
};

}  // namespace saker::flight::mavlink
