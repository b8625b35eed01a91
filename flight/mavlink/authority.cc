#include "flight/mavlink/authority.h"

#include <fmt/format.h>

#include <cstdlib>
#include <utility>

namespace saker::flight::mavlink {
namespace {

constexpr int kLeastPulse = 800, kMostPulse = 2200;  // us; what else is there is no stick

}  // namespace

void Authority::asked(std::uint32_t custom_mode, Time now) {
  asked_ = custom_mode;
  asked_at_ = now;
}

void Authority::hear(bool armed, std::uint32_t custom_mode, std::uint8_t system_status, Time now) {
  const bool changed = mode_ && custom_mode != *mode_;
  const bool ours =
      asked_ && custom_mode == *asked_ && to_seconds(now - asked_at_) <= config_.asked_s;
  // On the ground anybody may choose a mode; what counts is a change in flight.
  if (armed && armed_ && changed && !ours) {
    if (system_status >= kCritical)
      take(Holder::failsafe, fmt::format("failsafe of the autopilot, mode {}", custom_mode));
    else
      take(Holder::pilot, fmt::format("the pilot took over, mode {}", custom_mode));
  }
  if (armed && !armed_) rest_.reset();
  armed_ = armed;
  mode_ = custom_mode;
}

void Authority::hear(const RcChannels& sticks) {
  const Sticks now = {sticks.chan1_raw, sticks.chan2_raw, sticks.chan4_raw};
  for (const std::uint16_t pulse : now)
    if (pulse < kLeastPulse || pulse > kMostPulse) return;
  if (!rest_ || !armed_) {
    rest_ = now;
    moved_ = 0;
    return;
  }
  bool away = false;
  for (std::size_t i = 0; i < now.size(); ++i)
    away = away || std::abs(now[i] - (*rest_)[i]) > config_.stick_us;
  moved_ = away ? moved_ + 1 : 0;
  if (moved_ >= config_.stick_messages) take(Holder::pilot, "the pilot took the sticks");
}

void Authority::give_back() {
  holder_ = Holder::ours;
  cause_.clear();
  rest_.reset();
  moved_ = 0;
}

void Authority::take(Holder holder, std::string cause) {
  if (holder_ == Holder::pilot) return;
  holder_ = holder;
  cause_ = std::move(cause);
}

}  // namespace saker::flight::mavlink
