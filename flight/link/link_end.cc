#include "flight/link/link_end.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <regex>

#include "saker/core/error.h"
#include "saker/exchange/bytes.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kCallPeriod{200};   // of a robot that hears no ground
constexpr milliseconds kAnswerPeriod{20};  // at least, to one life at one address
constexpr std::size_t kMostAnswered = 64;  // lives and addresses that are remembered
constexpr std::chrono::seconds kWarnPeriod{60};
constexpr double kHellosUntilLost = 2.5;  // one may be lost, and one come late
// What this end said comes back within milliseconds; the same bytes later are said anew.
constexpr std::chrono::seconds kEchoAge{1};
constexpr std::size_t kMostSaid = 512;  // of a channel: more than one step may publish

/// What a robot may be told. Whatever moves it, or what it believes of itself, is not among it.
const std::set<std::string> kForRobots = {"_ORDER", "_EXCHANGE"};
/// What belongs to one machine.
const std::set<std::string> kStay = {"_PRESENCE", "_SCAN", "_OCCUPANCY", "_ORDER"};

std::string label_of(const std::string& robot) { return robot + "_LINK"; }

std::uint64_t hash(Bus::Bytes bytes) {
  return std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void check(const char* way, const std::vector<LinkedChannel>& channels) {
  static const std::regex kForm("_[A-Z][A-Z0-9_]*");
  const bool down = std::string_view(way) == "down";
  std::set<std::string> named;
  for (const auto& [channel, rate, keep] : channels) {
    const std::string where = fmt::format("link.{}: channel {}", way, channel);
    if (!std::regex_match(channel, kForm))
      throw Error(where + ", expected the end of a name, as in _STATE");
    if (down ? !kForRobots.contains(channel) : kStay.contains(channel))
      throw Error(where + " must not pass to " + (down ? "a robot" : "the ground"));
    if (!named.insert(channel).second) throw Error(where + " is named twice");
    if (channel == "_ORDER" && keep < 2)
      throw Error(where + ": keep 1, expected 2 or more: each order counts");
  }
}

LinkConfig checked_config(const LinkConfig& config) {
  check("up", config.up);
  check("down", config.down);
  if (config.lost_s < kHellosUntilLost * config.hello_s)
    throw Error(fmt::format("link.lost_s {}, expected {} times link.hello_s or more", config.lost_s,
                            kHellosUntilLost));
  return core::checked(config, "link");
}

void add(const Outbox::Counters& sent, LinkEnd::Counters& all) {
  all.out_messages += sent.messages;
  all.out_bytes += sent.bytes;
  all.replaced += sent.replaced;
}

/// Who says that it sealed it; not authenticated.
std::string sender_of(std::string_view datagram) {
  exchange::ByteReader in(datagram);
  (void)in.byte();
  return std::string(in.text());
}

}  // namespace

LinkEnd::LinkEnd(const LinkConfig& config, End end, const exchange::Key& key, Bus& bus,
                 int most_robots, Send send)
    : config_(checked_config(config)),
      end_(end),
      key_(key),
      bus_(bus),
      most_robots_(static_cast<std::size_t>(most_robots)),
      send_(std::move(send)),
      sealer_(key, bus.robot(), ""),
      gives_(end == End::robot ? config.up : config.down) {
  exchange::require_key_of(key, bus.robot());
  for (const LinkedChannel& channel : end == End::robot ? config.down : config.up)
    takes_[channel.channel] = channel.keep > 1;
  if (end == End::robot)
    (void)counterpart_of(bus.robot(), address_of("link.ground", config.ground));
  for (const LinkedChannel& linked : gives_) {
    bus_.subscribe_raw(linked.channel,
                       [this, linked](const std::string& channel, Bus::Bytes bytes) {
                         return hear(channel, linked, bytes);
                       });
  }
}

// From this machine's LCM to the radio.

bool LinkEnd::hear(const std::string& channel, const LinkedChannel& linked, Bus::Bytes bytes) {
  const auto found = counterparts_.find(robot_of(channel));
  if (found == counterparts_.end()) {
    counters_.nobody += end_ == End::ground;
    return true;
  }
  Counterpart& counterpart = found->second;
  if (!is_new(counterpart, linked.channel, bytes)) {
    ++counters_.echoes;
    return true;
  }
  if (bytes.size() > static_cast<std::size_t>(config_.most_message_kb) * 1024) {
    ++counters_.oversized;
    return false;
  }
  if (!counterpart.there) ++counters_.nobody;
  if (counterpart.there || linked.keep == 1)
    counterpart.outbox.put(linked.channel, std::string(bytes.begin(), bytes.end()));
  return true;
}

/// Neither said here by this end, nor carried back by another one on the same LCM.
bool LinkEnd::is_new(Counterpart& counterpart, const std::string& channel, Bus::Bytes bytes) {
  std::deque<Said>& said = counterpart.said[channel];
  while (!said.empty() && (now_ - said.front().when > kEchoAge || said.size() > kMostSaid))
    said.pop_front();
  const std::uint64_t heard = hash(bytes);
  if (std::ranges::find(said, heard, &Said::hash) != said.end()) return false;
  said.push_back({heard, now_});
  return true;
}

void LinkEnd::step(Steady::time_point now) {
  now_ = now;
  for (auto at = counterparts_.begin(); at != counterparts_.end();) {
    auto& [robot, counterpart] = *at;
    look_after(robot, counterpart);
    const bool gone = end_ == End::ground && !counterpart.there &&
                      now - counterpart.seen > std::chrono::duration<double>(config_.lost_s);
    if (gone) add(counterpart.outbox.counters(), counters_);
    at = gone ? counterparts_.erase(at) : std::next(at);
  }
}

void LinkEnd::lose(const std::string& robot, Counterpart& counterpart, const char* why) {
  if (!counterpart.there) return;
  counterpart.there = false;
  counterpart.next_call = std::min(counterpart.next_call, now_ + kCallPeriod);
  counterpart.outbox.forget_events();
  spdlog::warn("{} is gone: it {}", end_ == End::ground ? robot : "the ground", why);
}

void LinkEnd::say_goodbye() {
  for (const auto& [robot, counterpart] : counterparts_) {
    if (counterpart.there) send(robot, counterpart.address, counterpart.session.goodbye());
  }
}

void LinkEnd::look_after(const std::string& robot, Counterpart& counterpart) {
  if (counterpart.there && !counterpart.session.alive(now_)) {
    counterpart.session.end();  // so that its next call brings the challenge that is open then
    lose(robot, counterpart, "is silent");
  }
  while (counterpart.there) {
    const auto piece = counterpart.outbox.next(now_);
    if (!piece) break;
    send(robot, counterpart.address, counterpart.session.payload(*piece));
  }
  const bool calls = counterpart.there || end_ == End::robot;
  if (!calls || now_ < counterpart.next_call) return;
  counterpart.next_call =
      now_ + (counterpart.there ? std::chrono::duration_cast<Steady::duration>(
                                      std::chrono::duration<double>(config_.hello_s))
                                : kCallPeriod);
  send(robot, counterpart.address, counterpart.session.payload(""));
}

void LinkEnd::send(const std::string& robot, const Address& to, const std::string& payload) {
  const auto sealed = sealer_.seal(label_of(robot), payload);
  if (!sealed || !send_(to, *sealed)) ++counters_.not_sent;
}

// From the radio to this machine's LCM.

LinkEnd::Counterpart* LinkEnd::counterpart_of(const std::string& robot, const Address& from) {
  const auto found = counterparts_.find(robot);
  if (found != counterparts_.end()) return &found->second;
  if (counterparts_.size() >= most_robots_) return nullptr;
  Counterpart fresh{from, Session(config_.lost_s, config_.hello_s),
                    Outbox(gives_, config_.rate_kb_s)};
  return &counterparts_.emplace(robot, std::move(fresh)).first->second;
}

void LinkEnd::receive(Steady::time_point now, const Address& from, std::string_view datagram) {
  now_ = now;
  const std::string robot = end_ == End::robot ? bus_.robot() : sender_of(datagram);
  if (end_ == End::robot && from != counterparts_.at(robot).address) {
    ++counters_.refused.strangers;
    return;
  }
  const exchange::Opened opened = exchange::unsealed(key_, bus_.robot(), label_of(robot), datagram);
  if (opened.verdict != exchange::Verdict::genuine) {
    ++counters_.refused.unsealed;
    return;
  }
  Counterpart* const counterpart = counterpart_of(robot, from);
  if (counterpart == nullptr) {
    ++counters_.refused.crowded;
    return;
  }
  counterpart->seen = now;
  const Session::Heard heard = counterpart->session.open(now, opened);
  switch (heard.outcome) {
    case Session::Outcome::asks:
      ++counters_.refused.asking;
      return answer(robot, *counterpart, from, opened);
    case Session::Outcome::second:
      ++counters_.refused.second;
      return warn_of_second(robot, *counterpart, from);
    case Session::Outcome::goodbye:
      return lose(robot, *counterpart, "says goodbye");
    case Session::Outcome::replayed:
      ++counters_.refused.replayed;
      return;
    case Session::Outcome::malformed:
      ++counters_.refused.without_right;
      return;
    case Session::Outcome::begun:
      counterpart->joiners.clear();
      counterpart->there = true;
      counterpart->second_seen = {};
      counterpart->next_call = now;  // so that it knows, too
      spdlog::info("{} is there ({})", end_ == End::ground ? robot : "the ground", to_string(from));
      [[fallthrough]];
    case Session::Outcome::taken:
      break;
  }
  if (counterpart->session.newest()) counterpart->address = from;
  if (!heard.body.empty()) deliver(robot, *counterpart, heard.body);
}

/// A recording is answered once at most: what a life says is always newer than what it was answered
/// before. So no flood of them takes the answer from who lives; whoever is forgotten is answered.
void LinkEnd::answer(const std::string& robot, Counterpart& counterpart, const Address& to,
                     const exchange::Opened& message) {
  auto& all = counterpart.answered;
  const std::pair key(to, message.epoch);
  if (const auto found = all.find(key); found != all.end()) {
    const auto& [counter, when] = found->second;
    if (message.counter <= counter || now_ < when + kAnswerPeriod) return;
  } else if (all.size() >= kMostAnswered) {
    all.erase(std::ranges::min_element(all, {}, [](const auto& one) { return one.second.when; }));
  }
  all[key] = {message.counter, now_};
  send(robot, to, counterpart.session.answer(message));
}

/// A restarted process is no second one: only where both are heard it is said.
void LinkEnd::warn_of_second(const std::string& robot, Counterpart& counterpart,
                             const Address& from) {
  if (now_ - counterpart.second_seen > std::chrono::duration<double>(config_.lost_s))
    counterpart.second_since = now_;
  counterpart.second_seen = now_;
  const bool both = counterpart.session.heard() > counterpart.second_since;
  if (!both || now_ < counterpart.next_warning) return;
  counterpart.next_warning = now_ + kWarnPeriod;
  spdlog::warn("a second {} at {}: the first one, at {}, keeps the link",
               end_ == End::ground ? robot : "ground", to_string(from),
               to_string(counterpart.address));
}

void LinkEnd::deliver(const std::string& robot, Counterpart& counterpart, std::string_view body) {
  auto fragment = fragment_of(body);
  const auto most = static_cast<std::size_t>(config_.most_message_kb) * 1024 / kFragmentBytes + 1;
  if (!fragment || !takes_.contains(fragment->channel) || fragment->count > most) {
    ++counters_.refused.without_right;
    return;
  }
  const std::string suffix = fragment->channel;
  FragmentJoiner& joiner = counterpart.joiners.try_emplace(suffix, takes_.at(suffix)).first->second;
  const long incomplete = joiner.incomplete();
  const auto message = joiner.add(std::move(*fragment));
  counters_.incomplete += joiner.incomplete() - incomplete;
  if (!message) return;
  const Bus::Bytes bytes(reinterpret_cast<const std::uint8_t*>(message->data()), message->size());
  (void)is_new(counterpart, suffix, bytes);  // from here on it is not
  ++counters_.in_messages;
  counters_.in_bytes += static_cast<long>(message->size());
  (void)bus_.publish_raw(robot + suffix, bytes);
}

LinkEnd::Steady::time_point LinkEnd::next_due() const {
  auto due = Steady::time_point::max();
  for (const auto& [robot, counterpart] : counterparts_) {
    if (counterpart.there) due = std::min(due, counterpart.outbox.next_due());
    if (counterpart.there || end_ == End::robot) due = std::min(due, counterpart.next_call);
  }
  return due;
}

int LinkEnd::connected() const {
  return static_cast<int>(
      std::ranges::count_if(counterparts_, [](const auto& entry) { return entry.second.there; }));
}

LinkEnd::Counters LinkEnd::counters() const {
  Counters all = counters_;
  for (const auto& [robot, counterpart] : counterparts_) add(counterpart.outbox.counters(), all);
  return all;
}

std::vector<std::pair<std::string, long>> health(const LinkEnd::Report& report) {
  const LinkEnd::Counters& counters = report.counters;
  return {{"link_connected", report.connected},
          {"link_in_bytes", counters.in_bytes},
          {"link_out_bytes", counters.out_bytes},
          {"link_refused", counters.refused.all()},
          {"link_dropped",
           counters.nobody + counters.oversized + counters.not_sent + counters.incomplete}};
}

}  // namespace saker::flight
