#include "tools/sim/mavlink/streams.h"

#include <algorithm>
#include <array>

#include "mavlink/messages.h"

namespace saker::tools {
namespace {

using namespace flight::mavlink;

constexpr std::array kMessages = {Heartbeat::kId,          SysStatus::kId,        SystemTime::kId,
                                  ExtendedSysState::kId,   BatteryStatus::kId,    Attitude::kId,
                                  AttitudeQuaternion::kId, LocalPositionNed::kId, RcChannels::kId,
                                  GpsGlobalOrigin::kId};

Time period_of(double rate_hz) { return rate_hz > 0 ? from_seconds(1 / rate_hz) : 0; }

}  // namespace

Streams::Streams(const Quirks& quirks) {
  for (const std::uint32_t id : kMessages) streams_.push_back({id, 0, 0});
  streams_.push_back({quirks.dialect.estimator_message, 0, 0});
  for (const OwnStream& own : quirks.streams)
    for (Stream& stream : streams_)
      if (stream.id == own.id) stream.own_period = stream.period = period_of(own.rate_hz);
}

bool Streams::knows(std::uint32_t id) const {
  return std::any_of(streams_.begin(), streams_.end(), [&](const auto& s) { return s.id == id; });
}

bool Streams::ask(std::uint32_t id, double interval_us) {
  for (Stream& stream : streams_) {
    if (stream.id != id) continue;
    stream.period = interval_us > 0 ? static_cast<Time>(interval_us * 1e3)
                                    : (interval_us < 0 ? 0 : stream.own_period);
    return true;
  }
  return false;
}

std::vector<std::uint32_t> Streams::due(Time now) {
  std::vector<std::uint32_t> ids;
  for (Stream& stream : streams_) {
    if (stream.period == 0 || now < stream.next) continue;
    stream.next =
        now - stream.next > stream.period ? now + stream.period : stream.next + stream.period;
    ids.push_back(stream.id);
  }
  return ids;
}

}  // namespace saker::tools
