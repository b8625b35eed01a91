#include "flight/executive/robot_exchange.h"

#include <spdlog/spdlog.h>

#include <filesystem>
#include <system_error>

#include "flight/bus/exchange_messages.h"
#include "saker/core/error.h"

namespace saker::flight {
namespace {

constexpr std::size_t kMostHeard = 1024;  // datagrams between two steps: 60 MB/s
constexpr std::chrono::seconds kFigures{1};
// After two questions of a base that were lost (exchange.link.retry_s) it asks once more.
constexpr std::chrono::seconds kQuiet{1};

std::filesystem::path made(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error("exchange.folder " + folder + " cannot be made: " + error.message());
  return folder;
}

/// The one after the newest that was begun.
exchange::StreamId next_flight(const exchange::Store& store, const std::string& robot) {
  constexpr auto kKind = exchange::StreamKind::history;
  return {robot, kKind, exchange::newest_version(store, robot, kKind) + 1};
}

std::size_t kept_bytes(const exchange::Store& store) {
  std::size_t bytes = 0;
  for (const auto& [id, extent] : store.extents()) bytes += extent.contiguous;
  return bytes;
}

}  // namespace

RobotExchange::RobotExchange(const ProcessConfig& config, Bus& bus)
    : bus_(bus),
      channel_(channel_name<exchange_t>(bus.robot())),
      store_(made(config.exchange.folder) / "streams.journal"),
      flight_(next_flight(store_, bus.robot())),
      exchange_(config.exchange.link, bus.robot(), exchange::read_key(config.exchange.key_file),
                config.exchange.folder, store_),
      packer_(bus.robot(), flight_.version, config.autonomy.objects.size(),
              autonomy::takeoff_pose(config.team.takeoff)),
      entries_(static_cast<std::size_t>(config.autonomy.slam.history.most_entries)),
      heard_(kMostHeard) {
  exchange_.add_link(channel_, exchange::Role::calls);
  bus_.subscribe<exchange_t>([this](const exchange_t& message) { return hear(message); });
}

bool RobotExchange::hear(const exchange_t& message) {
  const std::string_view datagram = datagram_of(message);
  if (datagram.size() > exchange::kLongestDatagram) return false;
  heard_.push(std::string(datagram));
  return true;
}

bool RobotExchange::publish(exchange::StreamKind kind, std::string_view bytes) {
  return exchange::publish(store_, bus_.robot(), kind, bytes) > 0;
}

bool RobotExchange::heard_all() const { return in_reach_ && Steady::now() - lacked_ > kQuiet; }

std::vector<exchange::UnpackedHistory> RobotExchange::told_flights() const {
  std::vector<exchange::UnpackedHistory> flights;
  for (const auto& [id, extent] : store_.extents()) {
    if (id.kind != exchange::StreamKind::history || id == flight_) continue;
    auto told = exchange::unpacked(store_.bytes(id));
    const bool own_words = told && told->history.robot == id.robot;
    if (own_words && told->history.flight == id.version) {
      flights.push_back(std::move(*told));
    } else {
      spdlog::warn("{}: {} bytes that are no flight", to_string(id), extent.contiguous);
    }
  }
  return flights;
}

void RobotExchange::add(const slam::History& history) {
  if (queued_ == history.entries.size()) return;
  for (; queued_ < history.entries.size(); ++queued_) entries_.push(history.entries[queued_]);
  state_ = State::busy;
}

void RobotExchange::step() {
  const auto steady = Steady::now();
  const Time now = std::chrono::nanoseconds(steady.time_since_epoch()).count();
  for (const std::string& datagram : heard_.take_all())
    (void)exchange_.receive(now, channel_, datagram);
  write_down();
  while (const auto datagram = exchange_.next(now))
    bus_.publish(to_lcm(system_utime(), datagram->bytes));
  state_ = looked_at(now);
  if (steady - said_ < kFigures) return;
  said_ = steady;
  say_figures();
}

RobotExchange::State RobotExchange::looked_at(Time now) {
  const exchange::Exchange::Contact base = exchange_.contacts(now).front();
  in_reach_ = base.in_contact;
  const std::size_t kept = kept_bytes(store_);
  if (!base.in_contact || !base.all_heard || kept != kept_bytes_) lacked_ = Steady::now();
  kept_bytes_ = kept;
  if (entries_.size() > 0 || (base.in_contact && !base.all_sent)) return State::busy;
  return base.in_contact && unkept_ == 0 ? State::handed_over : State::idle;
}

/// An early end is better than a gap: what follows an entry that is lost is not told either.
void RobotExchange::write_down() {
  for (const slam::HistoryEntry& entry : entries_.take_all()) {
    std::string bytes = store_.size(flight_) == 0 ? packer_.header() : "";
    bytes += packer_.pack(entry);
    if (unkept_ == 0 && entries_.dropped() == 0 && store_.append(flight_, bytes)) continue;
    if (++unkept_ == 1)
      spdlog::error("the disk does not take this flight's history: what follows is told to nobody");
  }
}

void RobotExchange::say_figures() {
  auto figures = exchange::health(exchange_);
  figures.emplace_back("exchange_unkept_entries", unkept_);
  figures_.put(std::move(figures));
}

std::vector<std::pair<std::string, long>> RobotExchange::figures() const {
  const auto latest = figures_.latest();
  return latest ? *latest : std::vector<std::pair<std::string, long>>{};
}

std::unique_ptr<RobotExchange> make_exchange(const ProcessConfig& config, Bus& bus) {
  if (config.exchange.folder.empty()) return nullptr;
  if (!std::filesystem::exists(config.exchange.key_file)) {
    spdlog::warn(
        "no key of a team at {}: this flight tells nobody and hears nobody (saker base key -o "
        "FILE)",
        config.exchange.key_file);
    return nullptr;
  }
  return std::make_unique<RobotExchange>(config, bus);
}

}  // namespace saker::flight
