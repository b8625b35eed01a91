#include "tools/saker/faults/fault_flight.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "tools/saker/experiment/mission_run.h"
#include "tools/saker/experiment/target_figures.h"
#include "tools/saker/faults/faulty_checker.h"
#include "tools/saker/faults/faulty_plant.h"
#include "tools/saker/faults/flight_files.h"

namespace saker::tools {
namespace {

using Json = nlohmann::ordered_json;
using simulation::ScenarioEvent;
using simulation::ScenarioEventKind;

constexpr double kLorryHeight_m = 3.8, kLorryWidth_m = 2.5;
constexpr double kPersonHeight_m = 1.8, kPersonWidth_m = 0.5;

ScenarioEvent gust_event(const Fault& fault) {
  ScenarioEvent event;
  event.kind = ScenarioEventKind::gust;
  event.gust_mps = fault.strength;
  event.towards_deg = fault.towards_deg;
  event.gust_s = fault.lasts_s;
  return event;
}

ScenarioEvent wall_event(const Fault& fault) {
  ScenarioEvent event;
  event.kind = ScenarioEventKind::obstacle;
  event.ahead_m = fault.strength;
  return event;
}

ScenarioEvent mover(const Fault& fault, double height_m, double width_m) {
  ScenarioEvent event;
  event.kind = ScenarioEventKind::mover;
  event.ahead_m = kMoverComesFrom_m;
  event.height_m = height_m;
  event.width_m = width_m;
  event.mover_mps = fault.strength;
  event.towards_deg = fault.towards_deg;
  return event;
}

/// What the world and the air do.
void add_event(const Fault& fault, std::vector<ScenarioEvent>& events) {
  if (fault.kind == FaultKind::gust)
    events.push_back(gust_event(fault));
  else if (fault.kind == FaultKind::wall)
    events.push_back(wall_event(fault));
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

static_assert(static_cast<int>(FaultPlace::abort) - static_cast<int>(FaultPlace::hold) ==
              static_cast<int>(autonomy::OrderKind::abort));  // the same orders in the same order

/// Gives each order of the schedule once, at its time.
class Operator {
 public:
  explicit Operator(const FaultSchedule& schedule) : schedule_(schedule) {}

  /// Nobody is told anything before.
  void speak_to(autonomy::MissionLockstep* mission) { mission_ = mission; }

  void step(double t_s) {
    if (mission_ == nullptr) return;
    for (; next_ < schedule_.size() && schedule_[next_].at_s <= t_s; ++next_) {
      const Fault& fault = schedule_[next_];
      if (fault.kind != FaultKind::order) continue;
      const int kind = static_cast<int>(fault.place) - static_cast<int>(FaultPlace::hold);
      mission_->give(
          {static_cast<std::int64_t>(next_) + 1, static_cast<autonomy::OrderKind>(kind)});
    }
  }

 private:
  const FaultSchedule& schedule_;  // in the order of time
  autonomy::MissionLockstep* mission_ = nullptr;
  std::size_t next_ = 0;
};

/// Hands on what the mission says: to who watches it, and onto the disk.
class Listener : public autonomy::MissionObserver {
 public:
  Listener(FlightWatch& watch, FlightFiles& files, Time begin)
      : watch_(watch), files_(files), begin_(begin) {}

  void on_scan(const autonomy::IngestedScan& scan) override { watch_.on_scan(scan); }
  void on_map(const autonomy::MapSnapshot& map) override {
    for (const std::string& torn : files_.write(to_seconds(map.stamp - begin_), map.map))
      watch_.on_torn_file(torn);
  }
  void on_plan(const autonomy::PlanningReport& report, const active::ActivePlan& plan) override {
    watch_.on_plan(report, plan);
  }
  void on_event(const autonomy::MissionEvent& event) override { watch_.on_event(event); }
  void on_reply(const autonomy::OrderReply& reply) override { watch_.on_reply(reply); }

 private:
  FlightWatch& watch_;
  FlightFiles& files_;
  Time begin_;
};

/// When the executive goes: one that is started again in the air does not fly.
double gone_s(const FaultFlight& flight) {
  double first_s = flight.most_s;
  for (const Fault& fault : flight.schedule) {
    const bool gone = fault.kind == FaultKind::restart && fault.place == FaultPlace::executive;
    if (gone) first_s = std::min(first_s, fault.at_s);
  }
  return first_s;
}

/// Nobody tells it anything any more.
void fly_alone(FaultyPlant& plant, FlightWatch& watch, Time end) {
  watch.on_executive_gone(plant.now());
  for (Time now = plant.now(); now < end;) plant.step_to(now += kNanosecondsPerSecond / 100);
}

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

/// All but what was seen of it.
Json record_of(const FaultFlight& flight, const autonomy::MissionResult& result,
               const simulation::VehicleTruth& truth, const FlightFiles& files) {
  return {{"scenario", flight.scenario},
          {"seed", flight.seed},
          {"most_s", flight.most_s},
          {"schedule", to_json(flight.schedule)},
          {"breaches", Json::array()},
          {"phase", to_string(result.phase)},
          {"outcome", to_string(result.outcome)},
          {"succeeded", result.succeeded},
          {"collisions", truth.collisions},
          {"min_clearance_m", number(truth.min_clearance_m)},
          {"flight_time_s", truth.flight_time_s},
          {"scans_not_registered", result.counters.scans_not_registered},
          {"files_written", files.written()},
          {"files_failed", files.failed()}};
}

}  // namespace

FaultOutcome fly_with_faults(const FaultFlight& flight) {
  const auto wall_begin = std::chrono::steady_clock::now();
  simulation::SimulatedVehicle vehicle(site_of(flight), flight.seed);
  const Time begin = vehicle.now();
  const autonomy::Config config = at_site(flight.config, flight.site, vehicle.site().fence);
  FlightWatch watch(flight.schedule, config.motion.geofence, config.motion.limits, begin);
  FlightFiles files(flight.files, flight.schedule, config.objects);
  Listener listener(watch, files, begin);
  Operator orders(flight.schedule);
  FaultyPlant plant(vehicle, flight.schedule,
                    {[&](const auto& truth, const auto& state) {
                       watch.on_step(truth, state);
                       orders.step(to_seconds(truth.stamp - begin));
                     },
                     [&](const VehicleOdometry& odometry) { watch.on_odometry(odometry); },
                     [&](const CommandAck& ack) { watch.on_ack(ack); }});
  FaultyChecker checker(config, flight.schedule, begin);
  const StallingStages stages(flight.schedule, begin);
  core::Timings timings;
  autonomy::MissionLockstep mission(config, vehicle.sensor(), vehicle.site().prior, plant, checker,
                                    1, timings);
  mission.delay_stages(&stages);
  orders.speak_to(&mission);
  const double alone_s = gone_s(flight);
  const autonomy::MissionResult result = mission.run(alone_s, listener);
  if (alone_s < flight.most_s && result.phase != autonomy::MissionPhase::done)
    fly_alone(plant, watch, begin + from_seconds(flight.most_s));

  FaultOutcome outcome{watch.breaches(), record_of(flight, result, vehicle.truth(), files),
                       watch.digest()};
  outcome.record["breaches"] = breach_list(outcome.breaches);
  outcome.record["events"] = event_list(watch.events(), begin);
  outcome.record["digest"] = outcome.digest;
  outcome.record["wall_s"] =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_begin).count();
  return outcome;
}

}  // namespace saker::tools
