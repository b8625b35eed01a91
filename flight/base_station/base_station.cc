#include "flight/base_station/base_station.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>

#include "flight/bus/counter.h"
#include "flight/bus/exchange_messages.h"
#include "flight/bus/messages.h"

namespace saker::flight {
namespace {

using std::chrono::milliseconds;

static_assert(BaseConfig::kMostRobots <= static_cast<int>(exchange::kMostSenders));
constexpr milliseconds kStepPeriod{20};    // of the exchange, as exchange.h asks for
constexpr milliseconds kLookPeriod{5000};  // at contacts: each costs the disk a write
constexpr milliseconds kHealthPeriod{1000};

Time nanoseconds(BaseStation::Steady::time_point time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

}  // namespace

BaseStation::BaseStation(const ProcessConfig& config, DatabaseStore& store, Bus& bus,
                         LinkReports link)
    : config_(core::checked(config.base, "base")),
      store_(store),
      bus_(bus),
      link_(std::move(link)),
      exchange_(config.exchange.link, bus.robot(), exchange::read_key(config.exchange.key_file),
                config_.folder, store) {
  bus_.subscribe_all<exchange_t>(
      [this](const std::string& robot, const exchange_t& message) { return hear(robot, message); });
}

bool BaseStation::hear(const std::string& robot, const exchange_t& message) {
  const std::string channel = channel_name<exchange_t>(robot);
  if (!visits_.contains(channel)) return admit(channel, message);
  const exchange::Verdict verdict =
      exchange_.receive(nanoseconds(Steady::now()), channel, datagram_of(message));
  if (verdict == exchange::Verdict::superseded) warn_of_earlier(robot);
  return verdict == exchange::Verdict::genuine || verdict == exchange::Verdict::own;
}

/// Of a life before the newest: said once of each robot.
void BaseStation::warn_of_earlier(const std::string& robot) {
  if (!warned_.insert(robot).second) return;
  spdlog::warn(
      "{} lost its epoch and its clock is behind, or there are two: set the clock, or renew its "
      "key (saker base key --robot {} --renew)",
      robot, robot);
}

/// Once of each robot that calls.
void BaseStation::warn_of_full(const std::string& robot) {
  if (!warned_.insert(robot).second) return;
  spdlog::warn(
      "{} is refused: {} names were heard here, no more are kept; without robots in the air: stop "
      "saker-base, remove {}/heard.windows",
      robot, exchange::kMostSenders, config_.folder);
}

/// A robot's first message is its ticket: only what the team's key sealed makes a link. Its content
/// is lost; a robot calls again.
bool BaseStation::admit(const std::string& channel, const exchange_t& message) {
  const exchange::Opened first = exchange_.opener().open(channel, datagram_of(message));
  if (first.verdict == exchange::Verdict::superseded) warn_of_earlier(robot_of(channel));
  if (first.verdict == exchange::Verdict::unknown && exchange_.opener().full())
    warn_of_full(robot_of(channel));
  if (first.verdict != exchange::Verdict::genuine || first.sender != robot_of(channel))
    return false;
  if (visits_.size() >= static_cast<std::size_t>(config_.most_robots)) {
    ++crowded_;
    return false;
  }
  exchange_.add_link(channel, exchange::Role::answers);
  visits_[channel] = {};
  return true;
}

void BaseStation::step(Steady::time_point now) {
  const LoopMeter::Run run(meter_);
  if (now >= next_step_) {
    next_step_ = now + kStepPeriod;
    send(nanoseconds(now));
  }
  if (now >= next_look_) {
    next_look_ = now + kLookPeriod;
    look_at_contacts(nanoseconds(now));
  }
  if (now >= next_health_) {
    next_health_ = now + kHealthPeriod;
    say_health();
  }
}

BaseStation::Steady::time_point BaseStation::next_due() const {
  return std::min(next_step_, next_health_);
}

void BaseStation::send(Time now) {
  while (const auto datagram = exchange_.next(now)) {
    const exchange_t message = to_lcm(system_utime(), datagram->bytes);
    not_sent_ += !bus_.publish_as(robot_of(datagram->channel), message);
  }
}

void BaseStation::look_at_contacts(Time now) {
  for (const exchange::Exchange::Contact& contact : exchange_.contacts(now)) {
    Visit& visit = visits_[contact.channel];
    const std::string robot = robot_of(contact.channel);
    if (contact.in_contact != visit.in_contact)
      spdlog::info("{} is {}", robot, contact.in_contact ? "in contact" : "out of contact");
    if (contact.in_contact && contact.all_sent && !visit.all_sent)
      spdlog::info("{} has all that is here", robot);
    if (contact.heard && *contact.heard > visit.heard) store_.note_contact(robot, system_utime());
    visit = {contact.in_contact, contact.all_sent, contact.heard.value_or(0)};
  }
}

void BaseStation::say_totals() const {
  const exchange::Exchange::Counters exchanged = exchange_.counters();
  const LinkEnd::Counters linked = link_ ? link_().counters : LinkEnd::Counters{};
  spdlog::info("exchange: sent {} bytes, received {}; link: {} messages up, {} down, {} refused",
               exchanged.sent_bytes, exchanged.received_bytes, linked.in_messages,
               linked.out_messages, linked.refused.all());
}

void BaseStation::say_health() {
  health_t health{};
  health.utime = system_utime();
  health.process = "saker-base";
  health.loops = {meter_.take_period(kHealthPeriod, std::nan(""), not_sent_)};
  health.num_loops = static_cast<std::int32_t>(health.loops.size());
  for (const auto& [name, value] : exchange::health(exchange_))
    health.counters.push_back(counter(name, value));
  health.counters.push_back(counter("store_bytes", store_.file_bytes()));
  health.counters.push_back(counter("store_full", store_.full()));
  health.counters.push_back(counter("robots_refused", crowded_));
  if (link_) {
    for (const auto& [name, value] : flight::health(link_()))
      health.counters.push_back(counter(name, value));
  }
  health.num_counters = static_cast<std::int32_t>(health.counters.size());
  not_sent_ += !bus_.publish(health);
}

}  // namespace saker::flight
