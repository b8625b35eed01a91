#include "flight/executive/briefing.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <future>

#include "flight/process/process.h"
#include "saker/core/config_folder.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/objects/map_io.h"

namespace saker::flight {
namespace {

using Steady = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kStep{20};  // 50 Hz, as the exchange wants

Steady::duration seconds(double value) {
  return std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(value));
}

bool is_merged(const autonomy::ToldFlight& flight) { return flight.merged > 0; }

}  // namespace

Briefing::Briefing(const ProcessConfig& config, RobotExchange& exchange, Bus& bus,
                   Presence& presence)
    : config_(config),
      exchange_(exchange),
      bus_(bus),
      presence_(presence),
      team_(config.team, config.autonomy.multirobot, config.autonomy.slam,
            config.autonomy.objects) {}

core::Budget Briefing::budget() const {
  return core::Budget::until(Steady::now() + seconds(config_.team.merge_s),
                             autonomy::kMergeIterations);
}

objects::ObjectMap Briefing::brief(const objects::ObjectMap& said) {
  tell(said);
  attend(config_.exchange.call_s, [this] { return exchange_.in_reach(); });
  if (exchange_.in_reach())
    attend(config_.exchange.hear_s, [this] { return exchange_.heard_all(); });
  if (!exchange_.in_reach()) {
    spdlog::info("no base in reach: what was heard before is all that is known of the team");
  } else if (!exchange_.heard_all()) {
    spdlog::warn("the base did not tell all that it has within {:g} s", config_.exchange.hear_s);
  }
  const std::vector<exchange::UnpackedHistory> told = exchange_.told_flights();
  // Elsewhere, so that this robot is heard on the network meanwhile.
  const auto merging = std::async(std::launch::async, [&] { team_.add(told, budget()); });
  attend(config_.team.merge_s,
         [&] { return merging.wait_for(seconds(0)) == std::future_status::ready; });
  merging.wait();
  text_ = "told by the team: " + team_.text();
  return planned(said);
}

/// Bytes that every robot of the team then has.
void Briefing::tell(const objects::ObjectMap& said) {
  const autonomy::Config& config = config_.autonomy;
  bool kept = true;
  if (!said.objects.empty()) {
    const auto& takeoff = team_.takeoff();
    const objects::ObjectMap map = takeoff ? autonomy::in_frame("base", takeoff->pose, said) : said;
    kept =
        exchange_.publish(exchange::StreamKind::prior_map, objects::to_smap(map, config.objects));
  }
  if (autonomy::uncertainty_for(config) != nullptr) {
    const auto file = core::find_in_configs(config.uncertainty.model, "uncertainty.model");
    kept = exchange_.publish(exchange::StreamKind::uncertainty, core::read_file(file)) && kept;
  }
  if (!kept) spdlog::error("the disk does not take what the team is to be told before take-off");
}

/// Handles bus and exchange until `done`.
void Briefing::attend(double longest_s, const std::function<bool()>& done) {
  const auto end = Steady::now() + seconds(longest_s);
  auto announced = Steady::now() - Presence::kPeriod;
  while (!done() && Steady::now() < end && stop_requests() == 0) {
    if (Steady::now() - announced >= Presence::kPeriod) {
      presence_.announce();
      announced = Steady::now();
    }
    if (bus_.handle(kStep) < 0) return;
    exchange_.step();
  }
}

objects::ObjectMap Briefing::planned(const objects::ObjectMap& said) {
  flights_ = std::ranges::count_if(team_.told(), is_merged);
  if (flights_ == 0) return said;
  try {
    const auto prior = team_.prior(said, config_.autonomy.active.targets);
    objects_ = prior.mapped;
    known_ = prior.known;
    text_ += fmt::format(
        "; plans with {} objects: {} targets, {} known well by others, {} not well enough",
        objects_, prior.prior.objects.size(), known_, prior.weak);
    return prior.prior;
  } catch (const Error& error) {
    spdlog::warn("plans without what the team mapped: {}", error.what());
    return said;
  }
}

void Briefing::debrief(const slam::History& own, const std::filesystem::path& out) {
  const std::vector<exchange::UnpackedHistory> told = exchange_.told_flights();
  if (told.empty()) return;
  const core::Budget both = budget();
  team_.add_own(own, both);
  team_.add(told, both);
  const objects::ObjectMap map = team_.map();
  for (const char* name : {"merged.json", "merged.smap"})
    objects::write_map(out / name, map, config_.autonomy.objects);
  spdlog::info("merged with this flight: {}; {} objects", team_.text(), map.objects.size());
}

std::vector<std::pair<std::string, long>> Briefing::figures() const {
  return {{"team_flights", flights_}, {"team_objects", objects_}, {"team_known", known_}};
}

}  // namespace saker::flight
