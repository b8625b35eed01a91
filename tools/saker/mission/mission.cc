#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <iostream>
#include <memory>

#include "saker/core/config_io.h"
#include "saker/core/files.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"
#include "tools/saker/mission/team_flights.h"
#include "tools/saker/mission/team_report.h"
#include "tools/saker/mission/team_table.h"
#include "tools/saker/report/html_report.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

/// What must be the same for an interrupted mission to go on.
std::string manifest(const std::string& file, const TeamMission& mission, int runs,
                     const CommonOptions& common) {
  const fs::path scenario = fs::path(file).parent_path() / mission.config.scenario;
  const Json all = {{"mission", file},
                    {"content", core::read_file(file)},
                    {"scenario", core::read_file(scenario)},
                    {"several_runs", runs > 1},
                    {"seed", common.seed},
                    {"configuration", configuration_text(read_configuration(common))}};
  return all.dump(1) + "\n";
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

/// A seed: its site, and the folder that its flights have for themselves.
struct Run {
  CommonOptions common;
  TeamSite site;
  fs::path folder;
};

/// A site without room is an error before anything is flown.
std::vector<Run> runs_of(const TeamMission& mission, int runs, const CommonOptions& common) {
  std::vector<Run> all;
  for (int i = 0; i < runs; ++i) {
    CommonOptions own = common;
    own.seed += static_cast<std::uint64_t>(i);
    fs::path folder = common.out;
    if (runs > 1) folder /= fmt::format("seed-{}", own.seed);
    all.push_back({own, build_team_site(mission, own.seed), std::move(folder)});
  }
  return all;
}

void forget(const TeamMission& mission, const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    for (const RobotConfig& robot : mission.config.robots) {
      fs::remove(run.folder / robot.name / "results.json");
    }
  }
}

Json fly_run(const TeamMission& mission, const Run& run) {
  TeamFlights flights(mission, run.site, run.common, run.folder);
  flights.fly_all();
  Json results = team_results(flights, run.site, mission, run.common.seed, run.folder);
  write_team_maps(flights, run.site, mission.robots.front().objects, run.folder);
  core::write_file(run.folder / "table.txt", team_table(results));
  core::write_file(run.folder / "results.json", results.dump(2) + "\n");
  return results;
}

/// A page of each robot, of each seed, and of all.
void leave_reports(const TeamMission& mission, const std::vector<Run>& runs,
                   const CommonOptions& common) {
  flight::ProcessConfig config = read_configuration(common);
  config.autonomy = mission.base;
  for (const Run& run : runs) {
    for (std::size_t i = 0; i < mission.robots.size(); ++i) {
      const std::string& robot = mission.config.robots[i].name;
      flight::ProcessConfig own = config;
      own.autonomy = mission.robots[i];
      write_html_report(
          run.folder / robot,
          fmt::format("Mission {}, seed {}, robot {}", mission.name, run.common.seed, robot), own);
    }
    if (runs.size() > 1)
      write_html_report(run.folder,
                        fmt::format("Mission {}, seed {}", mission.name, run.common.seed), config);
  }
  leave_html_report(common.out, "Mission " + mission.name, config);
}

/// Leaves the table of all seeds; \return what is printed.
std::string written_table(const std::vector<Json>& results, const fs::path& out) {
  if (results.size() == 1) return team_table(results.front());
  std::string text = team_runs_text(results);
  core::write_file(out / "table.txt", text);
  core::write_file(out / "results.json", team_runs_json(results).dump(2) + "\n");
  return text;
}

int fly_team(const std::string& file, int runs, const CommonOptions& common) {
  const TeamMission mission = read_team_mission(file, read_configuration(common).autonomy);
  const std::vector<Run> all = runs_of(mission, runs, common);
  const std::string wanted = manifest(file, mission, runs, common);
  CommonOptions outer = common;
  outer.force = common.force || goes_on(common, "mission.json", wanted);
  const OutputFolder out(outer);
  if (common.force) forget(mission, all);
  core::write_file(out / "mission.json", wanted);

  std::vector<Json> results;
  bool good = true;
  for (const Run& run : all) {
    if (runs > 1) spdlog::info("seed {}", run.common.seed);
    results.push_back(fly_run(mission, run));
    good = all_good(results.back()) && good;
  }
  std::cout << written_table(results, out.path()) << std::flush;
  leave_reports(mission, all, common);
  return good ? 0 : 1;
}

}  // namespace

void add_mission(Commands& commands) {
  auto file = std::make_shared<std::string>();
  auto runs = std::make_shared<int>(1);
  CLI::App& app = commands.add(
      {.name = "mission",
       .does = "robots of a team one after another over one site, simulated in lockstep, their "
               "histories exchanged at the base and merged; goes on where it was interrupted",
       .output = Output::folder,
       .example = "saker mission configs/missions/lots.yaml -o out"},
      [file, runs](const CommonOptions& common) { return fly_team(*file, *runs, common); });
  app.add_option("MISSION", *file, "who flies where (*.yaml)")->required();
  app.add_option("--runs", *runs, "seeds: --seed and those that follow, one after another")
      ->check(CLI::Range(1, 100000));
}

}  // namespace saker::tools
