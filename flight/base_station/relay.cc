#include "flight/base_station/relay.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <regex>
#include <set>
#include <string_view>
#include <utility>

#include "saker/core/error.h"

namespace saker::flight {
namespace {

// What another relay carries back is there within milliseconds; the same bytes later are said anew.
constexpr std::chrono::seconds kEchoAge{1};

std::uint64_t hash(Bus::Bytes bytes) {
  return std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

bool refuse(long& counter) {
  ++counter;
  return false;
}

/// Throws Error where a channel has no proper name, belongs to one network or was named before.
void check(const std::string& channel, std::set<std::string>& named) {
  static const std::regex kForm("_[A-Z][A-Z0-9_]*");
  if (!std::regex_match(channel, kForm))
    throw Error("base.relay: channel " + channel + ", expected the end of a name, as in _STATE");
  if (channel == kChannel<exchange_t>.suffix || channel == kChannel<presence_t>.suffix)
    throw Error("base.relay: channel " + channel + " belongs to one network, it must not pass");
  if (!named.insert(channel).second)
    throw Error("base.relay: channel " + channel +
                " is named twice, expected once: it passes in one direction");
}

RelayConfig checked_config(const RelayConfig& config) {
  std::set<std::string> named;
  for (const auto* channels : {&config.up, &config.down})
    for (const RelayedChannel& channel : *channels) check(channel.channel, named);
  return core::checked(config, "base.relay");
}

}  // namespace

Relay::Relay(const RelayConfig& config, Bus& robots, Bus& ground, Open open)
    : config_(checked_config(config)), robots_(robots), ground_(ground), open_(std::move(open)) {
  subscribe(config_.up, robots_, ground_, counters_.up);
  subscribe(config_.down, ground_, robots_, counters_.down);
}

void Relay::subscribe(const std::vector<RelayedChannel>& channels, Bus& from, Bus& to,
                      Counters::Way& way) {
  for (const RelayedChannel& channel : channels) {
    Passage fresh;
    fresh.to = &to;
    fresh.way = &way;
    fresh.period = std::chrono::duration_cast<Steady::duration>(
        std::chrono::duration<double>(1 / channel.rate_hz));
    from.subscribe_raw(channel.channel, [this, fresh](const std::string& name, Bus::Bytes bytes) {
      return robot_of(name) == fresh.to->robot() || hear(name, bytes, fresh);
    });
  }
}

bool Relay::hear(const std::string& channel, Bus::Bytes bytes, const Passage& fresh) {
  if (bytes.size() > static_cast<std::size_t>(config_.most_message_kb) * 1024)
    return refuse(counters_.oversized);
  std::vector<std::uint8_t> message(bytes.begin(), bytes.end());
  if (fresh.to == &robots_) {
    auto opened = open_(channel, bytes);
    if (!opened) return refuse(counters_.not_ours);
    message = std::move(*opened);
  }
  const bool known = passages_.contains(channel);
  if (!known && passages_.size() >= static_cast<std::size_t>(config_.most_channels))
    return refuse(counters_.crowded);
  Passage& passage = passages_.try_emplace(channel, fresh).first->second;
  if (is_echo(passage, message)) {
    if (!std::exchange(passage.echoed, true))
      spdlog::warn("another relay carries {} back, it is dropped", channel);
    return refuse(counters_.echoes);
  }
  counters_.replaced += passage.waiting.has_value();
  passage.waiting = std::move(message);
  return true;
}

bool Relay::is_echo(const Passage& passage, Bus::Bytes bytes) const {
  const std::uint64_t heard = hash(bytes);
  const std::size_t count = std::min(passage.sent_count, passage.sent.size());
  return std::any_of(passage.sent.begin(), passage.sent.begin() + count, [&](const Sent& sent) {
    return sent.hash == heard && now_ - sent.when < kEchoAge;
  });
}

void Relay::step(Steady::time_point now) {
  now_ = now;
  for (auto& [channel, passage] : passages_) {
    if (passage.waiting && now >= passage.next) send(channel, passage, now);
  }
}

void Relay::send(const std::string& channel, Passage& passage, Steady::time_point now) {
  const std::vector<std::uint8_t> message = *std::exchange(passage.waiting, std::nullopt);
  passage.next = now + passage.period;
  passage.sent[passage.sent_count++ % passage.sent.size()] = {hash(message), now};
  if (!passage.to->publish_raw(channel, message)) {
    ++counters_.not_sent;
    return;
  }
  ++passage.way->messages;
  passage.way->bytes += static_cast<long>(message.size());
}

Relay::Steady::time_point Relay::next_due() const {
  auto due = Steady::time_point::max();
  for (const auto& [channel, passage] : passages_) {
    if (passage.waiting) due = std::min(due, passage.next);
  }
  return due;
}

}  // namespace saker::flight
