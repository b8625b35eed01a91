#include <algorithm>
#include <cmath>

#include "flight/mavlink/codec.h"
#include "flight/mavlink/frames.h"
#include "saker/core/se3.h"
#include "tools/sim/mavlink/autopilot.h"

/// What the autopilot hears and says, message by message.
namespace saker::tools {
namespace {

using namespace flight::mavlink;

constexpr std::uint8_t kQuadrotor = 2, kVersion = 3, kStandby = 3, kActive = 4;
constexpr std::uint8_t kGroundStation = 255;
constexpr std::uint16_t kPauseContinue = 193;
constexpr std::uint16_t kNoCell = 0xFFFF, kVolts = 12600;  // mV
constexpr std::int16_t kNoTemperature = 0x7FFF, kNoCurrent = -1;
constexpr std::size_t kMostFrames = 256;

bool for_it(std::uint8_t system, std::uint8_t component) {
  return (system == 0 || system == SimulatedAutopilot::kSystem) &&
         (component == 0 || component == SimulatedAutopilot::kComponent);
}

std::int8_t percent_of(double share) {
  return std::isfinite(share) ? static_cast<std::int8_t>(std::lround(100 * share)) : -1;
}

std::array<float, 3> wire(const Eigen::Vector3d& v) {
  const Eigen::Vector3f f = flipped(v).cast<float>();
  return {f.x(), f.y(), f.z()};
}

}  // namespace

template <class Message>
void SimulatedAutopilot::say(const Message& message) {
  if (dead_ || frames_.size() == kMostFrames) return;
  if (const auto frame = writer_.write(message)) frames_.push_back(*frame);
}

template void SimulatedAutopilot::say(const Timesync& message);

void SimulatedAutopilot::text(int severity, const std::string& words) {
  Statustext message;
  message.severity = static_cast<std::uint8_t>(severity);
  write_text(words, message.text);
  say(message);
}

void SimulatedAutopilot::hear_bytes(std::span<const std::uint8_t> bytes, Time vehicle_now) {
  now_ = vehicle_now - boot_;
  while (!bytes.empty() && !dead_) {
    bytes = bytes.subspan(reader_.push(bytes));
    while (const auto frame = reader_.next()) hear(*frame);
  }
}

void SimulatedAutopilot::hear(const Frame& frame) {
  switch (frame.id) {
    case Heartbeat::kId:
      if (frame.system == kGroundStation) ground_station_at_ = now_;
      return;
    case CommandLong::kId: {
      const auto command = decode<CommandLong>(frame.bytes());
      if (!for_it(command.target_system, command.target_component)) return;
      flight::mavlink::CommandAck ack;
      ack.command = command.command;
      ack.result = static_cast<std::uint8_t>(obey(command));
      ack.target_system = frame.system;
      ack.target_component = frame.component;
      return say(ack);
    }
    case SetMode::kId: {
      const auto mode = decode<SetMode>(frame.bytes());
      if (for_it(mode.target_system, 0)) (void)request_mode(mode.custom_mode);
      return;
    }
    case SetPositionTargetLocalNed::kId: {
      const auto target = decode<SetPositionTargetLocalNed>(frame.bytes());
      if (for_it(target.target_system, target.target_component)) hear(target);
      return;
    }
    case Odometry::kId: {
      auto odometry = estimator_.hear(decode<Odometry>(frame.bytes()), now_);
      dead_ = dead_ || (quirks_.dies_of_nan && estimator_.saw_nan());
      if (!odometry) return;
      odometry->stamp += boot_;
      orders_.odometry.push_back(*odometry);
      return;
    }
    case Timesync::kId: {
      const auto message = decode<Timesync>(frame.bytes());
      if (!for_it(message.target_system, message.target_component)) return;
      if (const auto answer = TimeSync::answer(message, now_)) return say(*answer);
      return estimator_.hear(message, now_);
    }
    case SetGpsGlobalOrigin::kId: {
      const auto origin = decode<SetGpsGlobalOrigin>(frame.bytes());
      if (for_it(origin.target_system, 0)) hear_origin(origin);
      return;
    }
    default:
      return hear_parameters(frame);
  }
}

void SimulatedAutopilot::hear_parameters(const Frame& frame) {
  using flight::mavlink::ParamRequestList, flight::mavlink::ParamRequestRead,
      flight::mavlink::ParamSet;
  if (frame.id == ParamRequestRead::kId) {
    const auto request = decode<ParamRequestRead>(frame.bytes());
    if (!for_it(request.target_system, request.target_component)) return;
    if (const auto answer = parameters_.answer(request)) say(*answer);
  } else if (frame.id == ParamSet::kId) {
    const auto request = decode<ParamSet>(frame.bytes());
    if (!for_it(request.target_system, request.target_component)) return;
    if (const auto answer = parameters_.set(request)) say(*answer);
  } else if (frame.id == ParamRequestList::kId) {
    const auto request = decode<ParamRequestList>(frame.bytes());
    if (!for_it(request.target_system, request.target_component)) return;
    for (const auto& parameter : parameters_.all()) say(parameter);
  }
}

void SimulatedAutopilot::hear_origin(const SetGpsGlobalOrigin& origin) {
  if (!estimator_.set_origin(now_)) return;
  origin_ = origin;
  text(6, "EKF3 IMU0 origin set");
  say(GpsGlobalOrigin::kId);
}

AckResult SimulatedAutopilot::obey(const CommandLong& c) {
  switch (c.command) {
    case kDoSetMode: {
      const auto main = static_cast<std::uint32_t>(c.param2),
                 sub = static_cast<std::uint32_t>(c.param3);
      const bool px4 = quirks_.dialect.autopilot == Autopilot::px4;
      return request_mode(px4 ? main << 16 | sub << 24 : main);
    }
    case kArmDisarm:
      return c.param1 == 1 ? arm() : disarm_ordered();
    case kNavTakeoff:
      return take_off(static_cast<double>(c.param7));
    case kNavLand:
      return request_mode(quirks_.dialect.land.custom);
    case kSetMessageInterval:
      return set_interval(static_cast<std::uint32_t>(c.param1), static_cast<double>(c.param2));
    case kPauseContinue:
      if (!quirks_.pauses) return AckResult::unsupported;
      guided_.hold(craft_.T_odom_body.translation(), core::yaw(craft_.T_odom_body.linear()));
      return AckResult::accepted;
    case kRequestMessage:
      if (!streams_.knows(static_cast<std::uint32_t>(c.param1))) return AckResult::denied;
      say(static_cast<std::uint32_t>(c.param1));
      return AckResult::accepted;
    default:
      return AckResult::unsupported;
  }
}

AckResult SimulatedAutopilot::set_interval(std::uint32_t id, double interval_us) {
  if (streams_.ask(id, interval_us)) return AckResult::accepted;
  if (quirks_.dialect.autopilot == Autopilot::ardupilot)
    text(6, "No ap_message for mavlink id (" + std::to_string(id) + ")");
  return AckResult::denied;
}

/// One message of its state, as it is now.
void SimulatedAutopilot::say(std::uint32_t id) {
  switch (id) {
    case Heartbeat::kId:
      return say_heartbeat();
    case ExtendedSysState::kId: {
      ExtendedSysState m;
      m.landed_state = static_cast<std::uint8_t>(landed_);
      return say(m);
    }
    case EkfStatusReport::kId: {
      EkfStatusReport m;
      m.flags = estimator_.flags(now_);
      return say(m);
    }
    case EstimatorStatus::kId: {
      EstimatorStatus m;
      m.time_usec = static_cast<std::uint64_t>(now_ / 1000);
      m.flags = estimator_.flags(now_);
      return say(m);
    }
    case GpsGlobalOrigin::kId: {
      GpsGlobalOrigin m;
      m.latitude = origin_.latitude;
      m.longitude = origin_.longitude;
      m.altitude = origin_.altitude;
      m.time_usec = static_cast<std::uint64_t>(now_ / 1000);
      if (estimator_.origin_set()) say(m);
      return;
    }
    case SysStatus::kId:
    case BatteryStatus::kId:
      return say_battery(id);
    default:
      return say_motion(id);
  }
}

void SimulatedAutopilot::say_heartbeat() {
  Heartbeat m;
  m.type = kQuadrotor;
  m.autopilot = quirks_.dialect.heartbeat_kind;
  m.custom_mode = mode_;
  m.base_mode = static_cast<std::uint8_t>(kCustomModeFlag | (armed_ ? kArmedFlag : 0));
  m.system_status = critical_ ? kCritical : (armed_ && flying() ? kActive : kStandby);
  m.mavlink_version = kVersion;
  say(m);
}

void SimulatedAutopilot::say_battery(std::uint32_t id) {
  if (id == SysStatus::kId) {
    SysStatus m;
    m.voltage_battery = kVolts;
    m.current_battery = kNoCurrent;
    m.battery_remaining = percent_of(craft_.vehicle.battery_share);
    return say(m);
  }
  BatteryStatus m;
  m.voltages.fill(kNoCell);
  m.voltages[0] = kVolts;
  m.temperature = kNoTemperature;
  m.current_battery = kNoCurrent;
  m.battery_remaining = percent_of(craft_.vehicle.battery_share);
  say(m);
}

template <class Message>
Message SimulatedAutopilot::with_turning(Message m) const {
  const auto w = wire(craft_.angular_velocity);
  m.time_boot_ms = static_cast<std::uint32_t>(now_ / 1'000'000);
  m.rollspeed = w[0];
  m.pitchspeed = w[1];
  m.yawspeed = w[2];
  return m;
}

void SimulatedAutopilot::say_motion(std::uint32_t id) {
  const auto boot_ms = static_cast<std::uint32_t>(now_ / 1'000'000);
  const Eigen::Quaterniond q = flipped(Eigen::Quaterniond(craft_.T_odom_body.linear()));
  if (id == SystemTime::kId) {
    SystemTime m;
    m.time_boot_ms = boot_ms;
    say(m);
  } else if (id == Attitude::kId) {
    const Eigen::Vector3d ypr = q.toRotationMatrix().eulerAngles(2, 1, 0);
    Attitude m;
    m.roll = static_cast<float>(ypr.z());
    m.pitch = static_cast<float>(ypr.y());
    m.yaw = static_cast<float>(ypr.x());
    say(with_turning(m));
  } else if (id == AttitudeQuaternion::kId) {
    AttitudeQuaternion m;
    m.q1 = static_cast<float>(q.w());
    m.q2 = static_cast<float>(q.x());
    m.q3 = static_cast<float>(q.y());
    m.q4 = static_cast<float>(q.z());
    say(with_turning(m));
  } else if (id == LocalPositionNed::kId) {
    const auto p = wire(craft_.T_odom_body.translation()), v = wire(craft_.velocity);
    LocalPositionNed m;
    m.time_boot_ms = boot_ms;
    m.x = p[0];
    m.y = p[1];
    m.z = p[2];
    m.vx = v[0];
    m.vy = v[1];
    m.vz = v[2];
    say(m);
  } else if (id == RcChannels::kId) {  // no receiver: no channel
    RcChannels m;
    m.time_boot_ms = boot_ms;
    say(m);
  }
}

}  // namespace saker::tools
