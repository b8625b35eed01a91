#include "flight/mavlink/state_in.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flight/mavlink/frames.h"

namespace saker::flight::mavlink {
namespace {

constexpr std::uint8_t kAutopilotComponent = 1;
constexpr std::uint8_t kNoAutopilot = 8;  // HEARTBEAT of a ground station, a gimbal, …
constexpr std::uint8_t kLastLanded = 4;
constexpr std::uint16_t kNoCell = 0xFFFF;    // mV
constexpr std::uint16_t kHasPlace = 8 | 16;  // estimator: horizontal place, relative or absolute
constexpr int kWarning = 4;
constexpr double kMostPosition = 1e5;  // m

const char* name_of(std::uint8_t heartbeat_kind) {
  return heartbeat_kind == 3 ? "ardupilot" : heartbeat_kind == 12 ? "px4" : "another";
}

/// The lowest that is known.
double least(double a, double b) { return std::isnan(a) ? b : std::isnan(b) ? a : std::min(a, b); }

}  // namespace

bool StateIn::identify(const Frame& frame, Time) {
  if (frame.component != kAutopilotComponent) return false;
  if (frame.id == Heartbeat::kId) {
    const auto message = decode<Heartbeat>(frame.bytes());
    if (message.autopilot == kNoAutopilot) return false;
    if (system_ != 0 && frame.system != system_) return false;
    if (message.autopilot != dialect_.heartbeat_kind) {
      refusal_ = fmt::format("mavlink.autopilot is {}, but system {} is {} (HEARTBEAT {})",
                             to_string(dialect_.autopilot), frame.system,
                             name_of(message.autopilot), message.autopilot);
      return false;
    }
    system_ = frame.system;
    return true;
  }
  return system_ != 0 && frame.system == system_ && heartbeat_at_ != 0;
}

bool StateIn::hear(const Frame& frame, Time now) {
  const Definition* definition = definition_of(frame.id);
  if (!definition || !identify(frame, now)) return false;
  came_[definition - kDefinitions.data()] = now;
  switch (frame.id) {
    case Heartbeat::kId:
      hear(decode<Heartbeat>(frame.bytes()), now);
      return true;
    case ExtendedSysState::kId: {
      const auto landed = decode<ExtendedSysState>(frame.bytes()).landed_state;
      if (landed <= kLastLanded) state_.landed = static_cast<Landed>(landed);
      return landed <= kLastLanded;
    }
    case BatteryStatus::kId:
      hear(decode<BatteryStatus>(frame.bytes()));
      return true;
    case AttitudeQuaternion::kId:
      hear(decode<AttitudeQuaternion>(frame.bytes()));
      return true;
    case LocalPositionNed::kId:
      hear(decode<LocalPositionNed>(frame.bytes()));
      return true;
    case EkfStatusReport::kId:
      state_.estimator_flags = decode<EkfStatusReport>(frame.bytes()).flags;
      return true;
    case EstimatorStatus::kId:
      state_.estimator_flags = decode<EstimatorStatus>(frame.bytes()).flags;
      return true;
    case GpsGlobalOrigin::kId:
      state_.has_origin = true;
      return true;
    case Statustext::kId:
      hear(decode<Statustext>(frame.bytes()));
      return true;
    default:
      return false;
  }
}

void StateIn::hear(const Heartbeat& message, Time now) {
  const bool armed = (message.base_mode & kArmedFlag) != 0;
  if (armed && !state_.armed) ground_z_ = state_.position.z();
  state_.armed = armed;
  state_.custom_mode = message.custom_mode;
  state_.system_status = message.system_status;
  heartbeat_at_ = now;
}

/// A share of −1 is unknown; so are cells of 0xFFFF mV and of none.
void StateIn::hear(const BatteryStatus& message) {
  if (message.id >= kMostPacks) return;
  Pack pack;
  if (message.battery_remaining >= 0 && message.battery_remaining <= 100)
    pack.share = message.battery_remaining / 100.0;
  for (const std::uint16_t mv : message.voltages)
    if (mv != kNoCell && mv != 0) pack.cell_volts = least(pack.cell_volts, mv / 1000.0);
  packs_[message.id] = pack;
  state_.battery_share = state_.cell_volts = NAN;
  for (const Pack& p : packs_) {
    state_.battery_share = least(state_.battery_share, p.share);
    state_.cell_volts = least(state_.cell_volts, p.cell_volts);
  }
}

void StateIn::hear(const AttitudeQuaternion& message) {
  const WireRotation rotation = rotation_of(message.q1, message.q2, message.q3, message.q4);
  if (rotation.valid) state_.attitude = rotation.q;
}

void StateIn::hear(const LocalPositionNed& message) {
  const Eigen::Vector3d position =
      flipped(Eigen::Vector3d(static_cast<double>(message.x), static_cast<double>(message.y),
                              static_cast<double>(message.z)));
  if (position.allFinite() && position.norm() < kMostPosition) state_.position = position;
}

void StateIn::hear(const Statustext& message) {
  if (message.severity > kWarning) return;
  const std::string text = text_of(message.text);
  if (!text.empty()) state_.text = text;
}

bool StateIn::connected(Time now) const {
  return heartbeat_at_ != 0 && to_seconds(now - heartbeat_at_) < kSilence;
}

double StateIn::height_m() const { return state_.position.z() - ground_z_; }

bool StateIn::estimator_good() const {
  return state_.estimator_flags && (*state_.estimator_flags & kHasPlace) != 0;
}

bool StateIn::came(std::uint32_t id, double seconds, Time now) const {
  const Definition* definition = definition_of(id);
  if (!definition) return false;
  const Time at = came_[definition - kDefinitions.data()];
  return at != 0 && to_seconds(now - at) < seconds;
}

std::array<Wanted, 9> wanted_messages(const Dialect& dialect) {
  return {{{Heartbeat::kId, 2},
           {SysStatus::kId, 1},
           {ExtendedSysState::kId, 5},
           {BatteryStatus::kId, 1},
           {AttitudeQuaternion::kId, 10},
           {LocalPositionNed::kId, 10},
           {dialect.estimator_message, 5},
           {RcChannels::kId, 5},
           {GpsGlobalOrigin::kId, 0.2}}};
}

}  // namespace saker::flight::mavlink
