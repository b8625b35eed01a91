#include "saker/exchange/peer.h"

#include <algorithm>

namespace saker::exchange {
namespace {

// Of a holdings message before its lines.
constexpr std::size_t kHead = 16;
// What a silent link may save up of its rate.
constexpr double kSavedUp_s = 0.1;

}  // namespace

Peer::Peer(const PeerConfig& config, Role role, Store& store)
    : config_(core::checked(config, "exchange")),
      role_(role),
      store_(store),
      answer_delay_(from_seconds(config.answer_delay_s)) {}

bool Peer::in_contact(Time now) const {
  return heard_ && now - *heard_ < from_seconds(config_.contact_lost_s);
}

bool Peer::all_sent() const {
  return std::all_of(store_.extents().begin(), store_.extents().end(), [this](const auto& own) {
    const auto remote = remotes_.find(own.first);
    return remote != remotes_.end() && remote->second.held.contiguous >= own.second.contiguous;
  });
}

bool Peer::all_heard() const {
  return std::ranges::all_of(remotes_, [this](const auto& remote) {
    return remote.second.conflict || remote.second.held.contiguous <= store_.size(remote.first);
  });
}

// What comes in.

void Peer::begin_contact() {
  remotes_.clear();
  round_.reset();
  to_answer_.clear();
  answer_pending_ = false;
  answer_delay_ = from_seconds(config_.answer_delay_s);
  spent_ = 0;
}

void Peer::receive(Time now, std::string_view bytes) {
  if (!in_contact(now)) begin_contact();
  heard_ = now;
  const std::optional<Message> message = message_of(bytes);
  if (!message) {
    ++counters_.malformed;
    return;
  }
  std::visit([this, now](const auto& m) { take(now, m); }, *message);
}

void Peer::take(Time now, const HoldingsMessage& holdings) {
  for (const Holding& line : holdings.lines) learn(now, line);
  if (holdings.asks) {
    for (const Holding& line : holdings.lines) to_answer_.insert(line.id);
    answer_later(now, holdings.round);
  }
  if (!round_ || holdings.answers != round_->number) return;
  for (const Holding& line : holdings.lines) round_->streams.erase(line.id);
  if (round_->streams.empty()) close_round(now);
}

void Peer::take(Time now, const ChunkMessage& chunk) {
  if (remotes_.size() >= Store::kMostStreams && !remotes_.contains(chunk.id)) return;
  Remote& remote = remotes_[chunk.id];
  remote.held.merge({.contiguous = chunk.offset + chunk.bytes.size(), .beyond = {}});
  const Kept kept =
      remote.conflict ? Kept::refused : store_.put(chunk.id, chunk.offset, chunk.bytes);
  if (kept == Kept::stored) ++counters_.chunks_received;
  if (kept == Kept::repeated) {
    // An answer overtook it: the next ones wait longer.
    ++counters_.chunks_repeated;
    answer_delay_ = std::min(2 * answer_delay_, from_seconds(config_.most_retry_s) / 2);
  }
  if (kept == Kept::refused || kept == Kept::failed) {
    ++counters_.refused;
    unkept_.insert(chunk.id);
  }
  if (answer_pending_) answer_due_ = now + answer_delay_;  // the question overtook it
}

void Peer::learn(Time now, const Holding& line) {
  if (remotes_.size() >= Store::kMostStreams && !remotes_.contains(line.id)) return;
  Remote& remote = remotes_[line.id];
  remote.held.merge(line.held);
  if (line.refused) remote.refused_until = now + from_seconds(config_.refused_again_s);
  const std::size_t bytes = line.held.contiguous;
  if (bytes <= remote.compared || bytes > store_.size(line.id)) return;
  remote.compared = bytes;
  if (remote.digest.of(store_, line.id, bytes) == line.digest) return;
  counters_.conflicts += remote.conflict ? 0 : 1;
  remote.conflict = true;
}

void Peer::answer_later(Time now, std::uint32_t round) {
  if (round != 0) answered_round_ = round;
  if (!answer_pending_) answer_due_ = now + answer_delay_;
  answer_pending_ = true;
}

/// Round-trip times by RFC 6298, from what was asked once only (Karn).
void Peer::close_round(Time now) {
  if (round_->asked_times == 1) {
    const double sample = to_seconds(now - round_->asked);
    if (std::isnan(round_trip_s_)) {
      round_trip_s_ = sample;
      round_trip_deviation_s_ = sample / 2;
    } else {
      round_trip_deviation_s_ += (std::abs(round_trip_s_ - sample) - round_trip_deviation_s_) / 4;
      round_trip_s_ += (sample - round_trip_s_) / 8;
    }
  }
  round_.reset();
}

// What goes out.

std::optional<std::string> Peer::next(Time now, std::size_t framing) {
  const double rate = 1000 * config_.rate_kb_s;
  tokens_ = std::min(tokens_ + rate * to_seconds(now - tokens_at_), rate * kSavedUp_s);
  tokens_at_ = now;
  const bool spent = in_contact(now) && spent_ >= 1000 * config_.budget_kb;
  if (tokens_ < 0 || spent) return std::nullopt;
  std::optional<std::string> message = due(now);
  if (message) {
    const double bytes = static_cast<double>(message->size() + framing);
    tokens_ -= bytes;
    spent_ += bytes;
  }
  return message;
}

std::optional<std::string> Peer::due(Time now) {
  if (!in_contact(now)) return due_call(now);
  if (auto answer = due_answer(now)) return answer;
  if (!round_ && !begin_round(now)) return due_call(now);
  return due_in_round(now);
}

/// Whether anybody is there, and that we are.
std::optional<std::string> Peer::due_call(Time now) {
  if (role_ == Role::answers) return std::nullopt;
  if (called_ && now - *called_ < from_seconds(config_.hello_s)) return std::nullopt;
  called_ = now;
  return to_bytes(HoldingsMessage{.asks = true});
}

std::optional<std::string> Peer::due_answer(Time now) {
  if (!answer_pending_ || now < answer_due_) return std::nullopt;
  const HoldingsMessage message{.answers = answered_round_, .lines = holdings(to_answer_)};
  for (const Holding& line : message.lines) {
    to_answer_.erase(line.id);
    unkept_.erase(line.id);
  }
  answer_pending_ = !to_answer_.empty();
  if (!answer_pending_) answered_round_ = 0;
  return to_bytes(message);
}

std::vector<Holding> Peer::holdings(const std::set<StreamId>& ids) {
  std::vector<Holding> lines;
  std::size_t size = kHead;
  for (const StreamId& id : ids) {
    Holding line = holding(id);
    size += size_of(line);
    if (size > kLongestMessage) break;
    lines.push_back(std::move(line));
  }
  return lines;
}

Holding Peer::holding(const StreamId& id) {
  Holding line{.id = id, .refused = unkept_.contains(id)};
  const auto own = store_.extents().find(id);
  if (own == store_.extents().end()) return line;
  line.held = own->second;
  line.digest = digests_[id].of(store_, id, line.held.contiguous);
  return line;
}

bool Peer::begin_round(Time now) { return ask_unknown() || send_missing(now); }

/// Of streams whose copy over there is not known, nothing is sent before it is.
bool Peer::ask_unknown() {
  std::set<StreamId> unknown;
  for (const auto& [id, own] : store_.extents()) {
    if (!remotes_.contains(id)) unknown.insert(id);
  }
  Round round{.number = rounds_ + 1};
  for (const Holding& line : holdings(unknown)) round.streams.insert(line.id);
  if (round.streams.empty()) return false;
  rounds_ = round.number;
  round_ = std::move(round);
  return true;
}

bool Peer::wanted(Time now, const StreamId& id, const Extent& own) const {
  const Remote& remote = remotes_.at(id);
  return !remote.conflict && now >= remote.refused_until && remote.held.contiguous < own.contiguous;
}

bool Peer::send_missing(Time now) {
  for (const auto& [id, own] : store_.extents()) {
    if (!wanted(now, id, own)) continue;
    std::vector<ChunkMessage> chunks = missing(id, remotes_.at(id).held);
    if (chunks.empty()) continue;
    ++rounds_;
    std::reverse(chunks.begin(), chunks.end());
    round_ = Round{.number = rounds_, .streams = {id}, .chunks = std::move(chunks)};
    return true;
  }
  return false;
}

/// The first `round_chunks` chunks, or their ends, that the counterpart lacks.
std::vector<ChunkMessage> Peer::missing(const StreamId& id, const Extent& held) const {
  const std::size_t size = store_.size(id);
  const int first = held.open_chunk();
  std::vector<ChunkMessage> chunks;
  for (int k = first; k <= first + kMostBeyond; ++k) {
    const std::size_t begin = static_cast<std::size_t>(k) * kChunkBytes;
    if (begin >= size || static_cast<int>(chunks.size()) >= config_.round_chunks) break;
    const std::size_t has = held.bytes_of(k), end = std::min(kChunkBytes, size - begin);
    if (has >= end) continue;
    const std::string bytes = store_.chunk(id, k);
    if (bytes.size() < end) break;  // cannot be read
    chunks.push_back({id, begin + has, bytes.substr(has, end - has)});
  }
  return chunks;
}

std::optional<std::string> Peer::due_in_round(Time now) {
  Round& round = *round_;
  if (!round.chunks.empty()) {
    const ChunkMessage chunk = std::move(round.chunks.back());
    round.chunks.pop_back();
    ++counters_.chunks_sent;
    return to_bytes(chunk);
  }
  if (round.asked_times > 0 && now - round.asked < timeout()) return std::nullopt;
  return ask(now);
}

std::string Peer::ask(Time now) {
  round_->asked = now;
  ++round_->asked_times;
  return to_bytes(
      HoldingsMessage{.asks = true, .round = round_->number, .lines = holdings(round_->streams)});
}

/// RFC 6298, but never shorter than what the counterpart waits anyway; doubles with every try.
Time Peer::timeout() const {
  const double least = 2 * config_.answer_delay_s;
  const double once = std::isnan(round_trip_s_)
                          ? config_.retry_s
                          : std::max(round_trip_s_ + 4 * round_trip_deviation_s_, least);
  return from_seconds(std::min(std::ldexp(once, round_->asked_times - 1), config_.most_retry_s));
}

}  // namespace saker::exchange
