#include "tools/saker/mission/team_mission.h"

#include <fmt/format.h>

#include <set>

#include "saker/core/config_io.h"
#include "saker/core/error.h"
#include "saker/exchange/stream.h"
#include "saker/motion/geofence.h"
#include "saker/simulation/mission/scenario.h"

namespace saker::tools {
namespace {

void check_name(const RobotConfig& robot, std::set<std::string>& names) {
  if (!exchange::is_name(robot.name)) {
    throw Error(fmt::format("name: '{}', expected 1 to {} capitals and digits", robot.name,
                            exchange::kLongestName));
  }
  if (!names.insert(robot.name).second) {
    throw Error(
        fmt::format("name: '{}' occurs twice, expected another for each robot", robot.name));
  }
}

void check_lot(const RobotConfig& robot, const DivisionConfig& division) {
  if (robot.lot_m.empty()) return;
  if (division.by_work) throw Error("lot_m: expected none, division.by_work draws the lots");
  try {
    const motion::Geofence lot({.polygon_m = robot.lot_m});
  } catch (const Error&) {
    throw Error(fmt::format("lot_m: {} numbers, expected x and y of three corners or more",
                            robot.lot_m.size()));
  }
}

autonomy::Config with_settings(const std::vector<std::string>& settings, autonomy::Config config) {
  for (const std::string& setting : settings) {
    config = core::config_with_setting(setting, std::move(config));
  }
  return config;
}

/// What the robot's program is told: the team's configuration and what is this robot's own.
autonomy::Config told(const RobotConfig& robot, const autonomy::Config& team) {
  autonomy::Config config = with_settings(robot.set, team);
  config.mission.height_m = robot.height_m;
  config.active.viewpoints.height_m = robot.height_m;
  config.active.policy = robot.policy;
  config.mount = robot.mount;
  (void)lidar::mount_pose(config.mount);
  return config;
}

}  // namespace

simulation::MissionConfig read_site(const std::string& file) {
  const auto scenario = core::load_config<simulation::Scenario>(file, {});
  if (scenario.kind != simulation::ScenarioKind::mission) {
    throw Error(fmt::format("{}: kind: expected mission", file));
  }
  return scenario.mission;
}

TeamMission read_team_mission(const std::filesystem::path& file, const autonomy::Config& config) {
  TeamMission mission{.config = core::load_config<TeamMissionConfig>(file, {}),
                      .name = file.stem().string()};
  try {
    mission.base = with_settings(mission.config.set, config);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: set: {}", file.string(), error.what()));
  }
  if (mission.config.scenario.empty()) {
    throw Error(fmt::format("{}: scenario: missing, expected a file", file.string()));
  }
  if (mission.config.robots.empty()) {
    throw Error(fmt::format("{}: robots: none, expected at least one", file.string()));
  }
  mission.site = read_site((file.parent_path() / mission.config.scenario).string());
  std::set<std::string> names;
  for (std::size_t i = 0; i < mission.config.robots.size(); ++i) {
    const RobotConfig& robot = mission.config.robots[i];
    try {
      check_name(robot, names);
      check_lot(robot, mission.config.division);
      mission.robots.push_back(told(robot, mission.base));
    } catch (const Error& error) {
      throw Error(fmt::format("{}: robots[{}].{}", file.string(), i, error.what()));
    }
  }
  return mission;
}

}  // namespace saker::tools
