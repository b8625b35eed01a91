#include <fmt/format.h>

#include <iostream>

#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/objects/map_io.h"
#include "tools/saker/command.h"
#include "tools/saker/configuration.h"
#include "tools/saker/flight_report/flight_figures.h"
#include "tools/saker/picture/map_picture.h"
#include "tools/saker/report/html_report.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  std::string executive, simulator, checker;
  FlightLimits limits;
};

Json read_json(const fs::path& file) {
  try {
    return Json::parse(core::read_file(file));
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

FlownMission read_flight(const ReportOptions& options, const objects::ClassTable& table) {
  const fs::path executive = options.executive, simulator = options.simulator;
  return {.map = objects::read_map(executive / "map.json", table),
          .trajectory = read_trajectory(executive / "trajectory.txt"),
          .viewpoints = read_trajectory(executive / "viewpoints.txt"),
          .loops = read_json(executive / "loops.json"),
          .truth = read_truth(simulator / "truth.json", table),
          .prior = objects::read_map(simulator / "prior.json", table),
          .simulator = read_json(simulator / "sim.json"),
          .checker = options.checker.empty() ? Json()
                                             : read_json(fs::path(options.checker) / "loops.json")};
}

void draw(const fs::path& file, const FlownMission& flight, const objects::ClassTable& table) {
  const auto places = [](const std::vector<StampedPose>& poses) {
    std::vector<Eigen::Vector3d> all;
    for (const StampedPose& pose : poses) all.emplace_back(pose.T_world_lidar.translation());
    return all;
  };
  write_map_picture(file,
                    {.map = flight.map,
                     .truth = &flight.truth.map,
                     .trajectory = places(flight.trajectory),
                     .viewpoints = places(flight.viewpoints),
                     .cloud = {}},
                    table);
}

int report(const ReportOptions& options, const CommonOptions& common) {
  const flight::ProcessConfig config = read_configuration(common);
  const objects::ClassTable& table = config.autonomy.objects;
  const FlownMission flight = read_flight(options, table);
  const OutputFolder out(common);
  const Json figures = flight_figures(flight, table);
  const std::vector<std::string> shortfalls = shortfalls_of(figures, options.limits);
  const std::string text = flight_text(figures, shortfalls);
  draw(out / "map.png", flight, table);
  core::write_file(out / "report.txt", text);
  core::write_file(out / "results.json", figures.dump(2) + "\n");
  std::cout << text << std::flush;
  leave_html_report(out.path(), "Mission flown in real time", config);
  return shortfalls.empty() ? 0 : 1;
}

}  // namespace

void add_flight_report(Commands& commands) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App& app = commands.add(
      {.name = "flight-report",
       .does =
           "a mission that was flown in real time against the truth: map, trajectory, clearance, "
           "loops",
       .output = Output::folder,
       .example = "saker flight-report mission/executive mission/simulator --checker "
                  "mission/checker -o report"},
      [options](const CommonOptions& common) { return report(*options, common); });
  app.add_option("FLIGHT", options->executive, "what saker-flight left")->required();
  app.add_option("SIMULATOR", options->simulator, "what saker-sim left")->required();
  app.add_option("--checker", options->checker,
                 "what saker-collision-checker left; without it its processor time is not known")
      ->type_name("FOLDER");
  app.add_option("--most-size-mae", options->limits.size_mae_m,
                 "of length and width, m; above, the flight falls short")
      ->capture_default_str();
  app.add_option("--most-trajectory-error", options->limits.trajectory_error_m,
                 "RMS of position, m; above, the flight falls short")
      ->capture_default_str();
}

}  // namespace saker::tools
