#include "flight/link/outbox.h"

#include <algorithm>

#include "flight/link/fragments.h"
#include "saker/exchange/seal.h"

namespace saker::flight {
namespace {

// Seal, both challenges, UDP and IP.
constexpr std::size_t kAround = exchange::kSealBytes + 16 + 28;
constexpr double kSavedUp_s = 0.02;  // of the rate that was not used
// A channel that was not looked at for so long at most makes up for it.
constexpr std::chrono::milliseconds kMadeUp{20};

}  // namespace

Outbox::Outbox(const std::vector<LinkedChannel>& channels, double rate_kb_s)
    : rate_(1000 * rate_kb_s) {
  for (const LinkedChannel& channel : channels) {
    Line& line = lines_[channel.channel];
    line.keep = static_cast<std::size_t>(channel.keep);
    line.period = std::chrono::duration_cast<Steady::duration>(
        std::chrono::duration<double>(1 / channel.rate_hz));
  }
}

void Outbox::put(const std::string& channel, std::string message) {
  Line& line = lines_.at(channel);
  if (line.waiting.size() >= line.keep) {
    line.waiting.pop_front();
    ++counters_.replaced;
  }
  line.waiting.push_back(std::move(message));
}

bool Outbox::is_due(const Line& line, Steady::time_point now) {
  return line.count > 0 || (!line.waiting.empty() && now >= line.next);
}

void Outbox::begin(Line& line, Steady::time_point now) {
  line.sending = std::move(line.waiting.front());
  line.waiting.pop_front();
  line.index = 0;
  line.count = static_cast<std::uint16_t>(
      std::max<std::size_t>(1, (line.sending.size() + kFragmentBytes - 1) / kFragmentBytes));
  ++line.number;
  line.next = (now - line.next > kMadeUp ? now : line.next) + line.period;
  ++counters_.messages;
  counters_.bytes += static_cast<long>(line.sending.size());
}

std::string Outbox::piece(const std::string& channel, Line& line) {
  const std::string bytes =
      to_bytes(Fragment{channel, line.number, line.index, line.count,
                        line.sending.substr(line.index * kFragmentBytes, kFragmentBytes)});
  if (++line.index == line.count) line.count = 0;
  return bytes;
}

std::optional<std::string> Outbox::next(Steady::time_point now) {
  const double passed = std::chrono::duration<double>(now - tokens_at_).count();
  tokens_ = std::min(tokens_ + rate_ * passed, rate_ * kSavedUp_s);
  tokens_at_ = now;
  if (tokens_ < 0) return std::nullopt;
  auto turn = lines_.upper_bound(last_);
  for (std::size_t i = 0; i < lines_.size(); ++i, ++turn) {
    if (turn == lines_.end()) turn = lines_.begin();
    auto& [channel, line] = *turn;
    if (!is_due(line, now)) continue;
    if (line.count == 0) begin(line, now);
    last_ = channel;
    std::string bytes = piece(channel, line);
    tokens_ -= static_cast<double>(bytes.size() + kAround);
    return bytes;
  }
  return std::nullopt;
}

Outbox::Steady::time_point Outbox::next_due() const {
  auto due = Steady::time_point::max();
  for (const auto& [channel, line] : lines_) {
    if (line.count > 0) due = std::min(due, tokens_at_);
    if (!line.waiting.empty()) due = std::min(due, line.next);
  }
  const std::chrono::duration<double> short_of(std::max(0.0, -tokens_ / rate_));
  return std::max(due, tokens_at_ + std::chrono::ceil<std::chrono::milliseconds>(short_of));
}

void Outbox::forget_events() {
  for (auto& [channel, line] : lines_) {
    if (line.keep > 1) line.waiting.clear();
    line.count = 0;
  }
}

}  // namespace saker::flight
