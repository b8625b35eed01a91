#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <iostream>
#include <memory>

#include "core/config_io.h"
#include "core/files.h"
#include "saker/configuration.h"
#include "saker/output.h"
#include "saker/subcommand.h"
#include "saker/team_flights.h"
#include "saker/team_report.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

/// What must be the same for an interrupted mission to go on.
std::string manifest(const std::string& file, const TeamMission& mission,
                     const CommonOptions& common) {
  const fs::path scenario = fs::path(file).parent_path() / mission.config.scenario;
  const Json all = {{"mission", file},
                    {"content", core::read_file(file)},
                    {"scenario", core::read_file(scenario)},
                    {"seed", common.seed},
                    {"configuration", configuration_text(read_configuration(common))}};
  return all.dump(1) + "\n";
}

bool goes_on(const CommonOptions& common, const std::string& wanted) {
  const fs::path file = fs::path(common.out) / "mission.json";
  return !common.force && fs::exists(file) && core::read_file(file) == wanted;
}

/// Whether the robot's part went as it should; says what did not.
bool good(const Json& robot) {
  const bool merged = robot.at("merge").at("status") == "merged";
  if (robot.at("succeeded") && robot.at("collisions") == 0 && robot.at("exchange_complete") &&
      merged) {
    return true;
  }
  spdlog::warn("{}: {} at {}, {} collisions, exchange {}, {}", robot.at("robot").get<std::string>(),
               robot.at("outcome").get<std::string>(), robot.at("phase").get<std::string>(),
               robot.at("collisions").get<int>(),
               robot.at("exchange_complete") ? "complete" : "cut short",
               robot.at("merge").at("status").get<std::string>());
  return false;
}

bool all_good(const Json& results) {
  const Json& merged = results.at("merged");
  bool result = merged.at("found") == merged.at("targets");
  if (!result) {
    spdlog::warn("{} of {} targets found", merged.at("found").get<int>(),
                 merged.at("targets").get<int>());
  }
  for (const Json& robot : results.at("robots")) result = good(robot) && result;
  return result;
}

int fly_team(const std::string& file, const CommonOptions& common) {
  const TeamMission mission = read_team_mission(file, read_configuration(common).autonomy);
  const TeamSite site = build_team_site(mission, common.seed);
  const std::string wanted = manifest(file, mission, common);
  CommonOptions outer = common;
  outer.force = common.force || goes_on(common, wanted);
  const OutputFolder out(outer);
  if (common.force) {
    for (const RobotConfig& robot : mission.config.robots) {
      fs::remove(out.path() / robot.name / "results.json");
    }
  }
  core::write_file(out / "mission.json", wanted);

  TeamFlights flights(mission, site, common, out.path());
  flights.fly_all();
  const Json results = team_results(flights, site, mission, common.seed, out.path());
  write_team_maps(flights, site, mission.robots.front().objects, out.path());
  const std::string table = team_table(results);
  core::write_file(out / "table.txt", table);
  core::write_file(out / "results.json", results.dump(2) + "\n");
  std::cout << table;
  return all_good(results) ? 0 : 1;
}

}  // namespace

void add_mission(Commands& commands) {
  auto file = std::make_shared<std::string>();
  CLI::App& app = commands.add(
      {.name = "mission",
       .does = "robots of a team one after another over one site, simulated in lockstep, their "
               "histories exchanged at the base and merged; goes on where it was interrupted",
       .output = Output::folder,
       .example = "saker mission configs/missions/lots.yaml -o out"},
      [file](const CommonOptions& common) { return fly_team(*file, common); });
  app.add_option("MISSION", *file, "who flies where (*.yaml)")->required();
}

}  // namespace saker::tools
