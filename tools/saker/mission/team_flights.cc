#include "tools/saker/mission/team_flights.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "saker/autonomy/team.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/simulation/mission/truth.h"
#include "tools/saker/command.h"
#include "tools/saker/mission/team_survey.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

/// Streams of random numbers of a mission.
enum Stream : std::uint64_t { kSurvey = 40, kInstruments = 41, kLink = 42 };

core::Rng stream(std::uint64_t seed, Stream of, std::size_t number) {
  return core::Rng(seed).fork(of).fork(number);
}

simulation::TakeoffPlace takeoff_of(const TeamMission& mission, std::size_t robot) {
  const RobotConfig& config = mission.config.robots[robot];
  return {config.x_m, config.y_m, config.yaw_deg, mission.config.takeoff.within_m};
}

simulation::MissionConfig site_of(const TeamMission& mission, std::size_t robot) {
  simulation::MissionConfig site = mission.site;
  site.mount = mission.config.robots[robot].mount;
  return site;
}

/// Where a target was said to be, or truly is when nothing was said of it: whose task it is must
/// not depend on the error of what was said.
Eigen::Vector3d place_of(const TeamSite& site, const objects::MapObject& target) {
  const auto said = std::ranges::find(site.said.objects, target.id, &objects::MapObject::id);
  return objects::place(said != site.said.objects.end() ? said->model : target.model);
}

/// Ids of those that are in the lot.
std::vector<int> in_lot(const autonomy::Lot& lot, const TeamSite& site) {
  std::vector<int> inside;
  for (const objects::MapObject& object : site.truth.objects) {
    const bool target = std::ranges::find(site.targets, object.id) != site.targets.end();
    if (target && lot.contains(place_of(site, object))) inside.push_back(object.id);
  }
  return inside;
}

/// As the mission file draws them, or by the work in them; what nothing was said of ends at the
/// fence.
std::vector<std::vector<double>> lots_of(const TeamMission& mission, const TeamSite& site) {
  std::vector<std::vector<double>> lots;
  std::vector<Eigen::Vector3d> targets, takeoffs;
  for (const RobotConfig& robot : mission.config.robots) {
    const bool fenced = robot.lot_m.empty() && mission.site.site.no_prior;
    lots.push_back(fenced ? site.fence_m : robot.lot_m);
    takeoffs.emplace_back(robot.x_m, robot.y_m, 0);
  }
  if (!mission.config.division.by_work) return lots;
  for (const objects::MapObject& object : site.said.objects) {
    const Eigen::Vector3d place = objects::place(object.model);
    targets.emplace_back(place.x(), place.y(), 0);
  }
  return divided_lots(std::move(targets), takeoffs, mission.config.division);
}

exchange::StreamId history_of(const std::string& robot) {
  return {robot, exchange::StreamKind::history, 1};
}

}  // namespace

TeamSite build_team_site(const TeamMission& mission, std::uint64_t seed) {
  TeamSite site;
  std::vector<std::vector<double>> lots;
  for (std::size_t i = 0; i < mission.config.robots.size(); ++i) {
    const RobotConfig& config = mission.config.robots[i];
    try {
      const simulation::MissionWorld world =
          simulation::build_mission_world(site_of(mission, i), seed, takeoff_of(mission, i));
      if (i == 0) {
        const std::vector<int> unhit(world.world().objects.size() + 1, 0);
        site.truth = simulation::truth_map(world.world(), world.T_sim_base.inverse(), unhit);
        site.truth.frame = "base";
        site.said = world.prior;
        site.said.frame = "base";
        site.targets = world.targets;
        site.fence_m = world.fence.polygon_m;
        lots = lots_of(mission, site);
      }
      const SE3 T_base_world = world.T_sim_base.inverse() * world.T_sim_world;
      PlacedRobot robot{.T_base_world = T_base_world,
                        .surveyed = surveyed(T_base_world, mission.config.takeoff.survey,
                                             stream(seed, kSurvey, i)),
                        .lot = autonomy::Lot(lots[i])};
      robot.targets = in_lot(robot.lot, site);
      if (robot.targets.empty()) throw Error("lot_m: no target stands there");
      site.robots.push_back(std::move(robot));
    } catch (const Error& error) {
      throw Error(
          fmt::format("{}, robot {}, seed {}: {}", mission.name, config.name, seed, error.what()));
    }
  }
  return site;
}

TeamFlights::TeamFlights(const TeamMission& mission, const TeamSite& site,
                         const CommonOptions& common, fs::path out)
    : mission_(mission),
      site_(site),
      common_(common),
      out_(std::move(out)),
      table_(mission.base.objects),
      merged_(mission.base.multirobot, mission.base.slam, table_) {}

void TeamFlights::fly_all() {
  for (std::size_t i = 0; i < site_.robots.size(); ++i) fly(i);
}

objects::ObjectMap TeamFlights::map() const {
  objects::ObjectMap map = merged_.reported_map();
  map.frame = "base";
  return map;
}

void TeamFlights::fly(std::size_t robot) {
  TeamFlight flight{.robot = mission_.config.robots[robot].name};
  exchange::MemoryStore own;
  flight.before.complete = mission_.config.at_once;
  if (!mission_.config.at_once) flight.before = contact(2 * robot, own);
  const objects::ObjectMap prior = prior_of(robot, flight);
  spdlog::info("{}: {} targets, {} known well by others, {} not well enough", flight.robot,
               prior.objects.size(), flight.known, flight.weak);
  flight.results = flown(robot, prior);
  const std::string history = core::read_file(out_ / flight.robot / "history.bin");
  flight.history_bytes = history.size();
  if (!own.append(history_of(flight.robot), history)) {
    throw Error(fmt::format("{}: a history of {} bytes, more than a stream holds", flight.robot,
                            history.size()));
  }
  flight.after = contact(2 * robot + 1, own);
  merge(flight);
  flights_.push_back(std::move(flight));
}

/// Number of a robot's contact, before or after its flight, among all.
ContactFigures TeamFlights::contact(std::size_t number, exchange::Store& robot) {
  const ContactFigures figures =
      exchange_at_base(mission_.config.link, robot, base_, stream(common_.seed, kLink, number));
  if (!figures.complete) spdlog::warn("a contact ended before everything was exchanged");
  return figures;
}

/// In the frame in which the robot believes to have taken off.
objects::ObjectMap TeamFlights::prior_of(std::size_t robot, TeamFlight& flight) const {
  const PlacedRobot& placed = site_.robots[robot];
  objects::ObjectMap mapped;
  const bool heard = flight.before.complete && !mission_.config.at_once;
  if (heard && !flights_.empty()) mapped = map();
  const autonomy::TeamPrior told =
      autonomy::team_prior(site_.said, mapped, placed.lot, mission_.config.known_gate_m,
                           mission_.robots[robot].active.targets, table_);
  flight.known = told.known;
  flight.weak = told.weak;
  return autonomy::in_frame("world", placed.surveyed.pose.inverse(), told.prior);
}

/// In the frame in which the robot believes to have taken off: about what it is told of, or what
/// was said of the site.
std::vector<double> TeamFlights::fence_of(std::size_t robot,
                                          const objects::ObjectMap& prior) const {
  if (!mission_.site.site.no_prior) {
    return simulation::fence_polygon(prior, mission_.site.site);
  }
  return autonomy::in_frame(site_.robots[robot].surveyed.pose.inverse(), site_.fence_m);
}

/// Now, or when the mission was interrupted.
Json TeamFlights::flown(std::size_t robot, const objects::ObjectMap& prior) const {
  const std::string& name = mission_.config.robots[robot].name;
  if (auto results = finished(out_ / name)) return *results;
  auto own_seed = stream(common_.seed, kInstruments, robot);
  MissionRun run{.scenario = mission_.name,
                 .robot = name,
                 .team = TeamRole{takeoff_of(mission_, robot),
                                  static_cast<std::uint64_t>(own_seed.index(1 << 30)),
                                  site_.robots[robot].targets, prior, fence_of(robot, prior),
                                  site_.robots[robot].surveyed},
                 .site = site_of(mission_, robot),
                 .config = mission_.robots[robot],
                 .seed = common_.seed,
                 .threads = common_.threads,
                 .log = log_of_run(out_ / name)};
  return tools::fly(run, out_ / name);
}

/// What the base holds of the flight goes into the one graph.
void TeamFlights::merge(TeamFlight& flight) {
  const auto received = exchange::unpacked(base_.bytes(history_of(flight.robot)));
  if (!received) {
    flight.merge.status = multirobot::MergeStatus::nothing_new;
  } else {
    flight.merge = merged_.add(received->history, received->takeoff,
                               core::Budget::iterations(autonomy::kMergeIterations));
  }
  spdlog::info(
      "{}: {} bytes of history, {} keyframes merged, {} measurements of known objects, "
      "{} new objects",
      flight.robot, flight.history_bytes, flight.merge.entries, flight.merge.matched,
      flight.merge.created);
}

}  // namespace saker::tools
