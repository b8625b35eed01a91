#include "tools/saker/faults/fault_flight.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "tools/saker/experiment/mission_run.h"
#include "tools/saker/experiment/target_figures.h"
#include "tools/saker/faults/faulty_checker.h"
#include "tools/saker/faults/faulty_plant.h"

namespace saker::tools {
namespace {

using Json = nlohmann::ordered_json;
using simulation::ScenarioEvent;
using simulation::ScenarioEventKind;

constexpr double kLorryHeight_m = 3.8, kLorryWidth_m = 2.5;
constexpr double kPersonHeight_m = 1.8, kPersonWidth_m = 0.5;
constexpr double kComesFrom_m = 12;  // a person, a lorry: in sight before it is there

ScenarioEvent gust(const Fault& fault) {
  ScenarioEvent event;
  event.kind = ScenarioEventKind::gust;
  event.gust_mps = fault.strength;
  event.towards_deg = fault.towards_deg;
  event.gust_s = fault.lasts_s;
  return event;
}

ScenarioEvent wall(const Fault& fault) {
  ScenarioEvent event;
  event.kind = ScenarioEventKind::obstacle;
  event.ahead_m = fault.strength;
  return event;
}

ScenarioEvent mover(const Fault& fault, double height_m, double width_m) {
  ScenarioEvent event;
  event.kind = ScenarioEventKind::mover;
  event.ahead_m = kComesFrom_m;
  event.height_m = height_m;
  event.width_m = width_m;
  event.mover_mps = fault.strength;
  event.towards_deg = fault.towards_deg;
  return event;
}

/// What the world and the air do.
void add_event(const Fault& fault, std::vector<ScenarioEvent>& events) {
  if (fault.kind == FaultKind::gust)
    events.push_back(gust(fault));
  else if (fault.kind == FaultKind::wall)
    events.push_back(wall(fault));
  else if (fault.kind == FaultKind::person)
    events.push_back(mover(fault, kPersonHeight_m, kPersonWidth_m));
  else if (fault.kind == FaultKind::lorry)
    events.push_back(mover(fault, kLorryHeight_m, kLorryWidth_m));
  else
    return;
  events.back().since_begin = true;
  events.back().at_s = fault.at_s;
}

simulation::MissionConfig site_of(const FaultFlight& flight) {
  simulation::MissionConfig site = flight.site;
  for (const Fault& fault : flight.schedule) {
    add_event(fault, site.events);
    if (fault.kind != FaultKind::prior) continue;
    site.site.prior_sd_m = fault.strength;
    site.site.prior_errors = {.missing_share = 0.3, .invented = 3, .duplicates = 1, .mistaken = 1};
  }
  return site;
}

static_assert(static_cast<int>(FaultPlace::planning) - static_cast<int>(FaultPlace::registration) ==
              static_cast<int>(autonomy::Stage::planning));  // the same stages in the same order

/// A stage that hangs gives what it had begun when it goes on.
class StallingStages : public autonomy::StageDelays {
 public:
  StallingStages(const FaultSchedule& schedule, Time begin) : schedule_(schedule), begin_(begin) {}

  [[nodiscard]] double extra_s(autonomy::Stage stage, Time now) const override {
    constexpr double kForEver_s = 1e5;
    const auto place = static_cast<FaultPlace>(static_cast<int>(FaultPlace::registration) +
                                               static_cast<int>(stage));
    const double t_s = to_seconds(now - begin_);
    const Fault* stall = acting(schedule_, FaultKind::stall, place, t_s);
    return stall == nullptr ? 0 : std::min(kForEver_s, stall->at_s + stall->lasts_s - t_s);
  }

 private:
  const FaultSchedule& schedule_;
  Time begin_;
};

Json breach_list(const std::vector<Breach>& breaches) {
  Json list = Json::array();
  for (const Breach& breach : breaches) {
    list.push_back(
        {{"invariant", to_string(breach.invariant)}, {"at_s", breach.at_s}, {"text", breach.text}});
  }
  return list;
}

Json event_list(const std::vector<autonomy::MissionEvent>& events, Time begin) {
  Json list = Json::array();
  for (const autonomy::MissionEvent& event : events) {
    list.push_back({{"t_s", to_seconds(event.stamp - begin)},
                    {"to", to_string(event.to)},
                    {"cause", to_string(event.cause)},
                    {"text", event.text}});
  }
  return list;
}

}  // namespace

FaultOutcome fly_with_faults(const FaultFlight& flight) {
  const auto wall_begin = std::chrono::steady_clock::now();
  simulation::SimulatedVehicle vehicle(site_of(flight), flight.seed);
  const Time begin = vehicle.now();
  const autonomy::Config config = at_site(flight.config, flight.site, vehicle.site().fence);
  FlightWatch watch(flight.schedule, config.motion.geofence, config.motion.limits, begin);
  FaultyPlant plant(vehicle, flight.schedule,
                    {[&](const auto& truth, const auto& state) { watch.on_step(truth, state); },
                     [&](const VehicleOdometry& odometry) { watch.on_odometry(odometry); }});
  FaultyChecker checker(config, flight.schedule, begin);
  const StallingStages stages(flight.schedule, begin);
  core::Timings timings;
  autonomy::MissionLockstep mission(config, vehicle.sensor(), vehicle.site().prior, plant, checker,
                                    1, timings);
  mission.delay_stages(&stages);
  const autonomy::MissionResult result = mission.run(flight.most_s, watch);
  const simulation::VehicleTruth truth = vehicle.truth();

  FaultOutcome outcome{watch.breaches(), {}, watch.digest()};
  outcome.record = {
      {"scenario", flight.scenario},
      {"seed", flight.seed},
      {"most_s", flight.most_s},
      {"schedule", to_json(flight.schedule)},
      {"breaches", breach_list(outcome.breaches)},
      {"phase", to_string(result.phase)},
      {"outcome", to_string(result.outcome)},
      {"succeeded", result.succeeded},
      {"collisions", truth.collisions},
      {"min_clearance_m", number(truth.min_clearance_m)},
      {"flight_time_s", truth.flight_time_s},
      {"scans_not_registered", result.counters.scans_not_registered},
      {"events", event_list(watch.events(), begin)},
      {"digest", outcome.digest},
      {"wall_s",
       std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_begin).count()}};
  return outcome;
}

}  // namespace saker::tools
