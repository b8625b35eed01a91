#include "tools/saker/mission/team_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "saker/core/statistics.h"
#include "saker/objects/map_io.h"
#include "tools/saker/picture/map_picture.h"
#include "tools/saker/replay/trajectory_truth.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

const char* to_string(multirobot::MergeStatus status) {
  constexpr const char* kNames[] = {"merged", "nothing_new", "not_aligned", "invalid"};
  return kNames[static_cast<int>(status)];
}

double per_minute(const Json& found, double seconds) {
  return seconds > 0 ? 60 * found.get<double>() / seconds : NAN;
}

/// From the first contact to the last, the flight between them.
double busy_s(const TeamFlight& flight) {
  return flight.before.seconds + flight.results.at("flight_time_s").get<double>() +
         flight.after.seconds;
}

/// RMS of position of the keyframes in the merged graph, m, in base without alignment.
double trajectory_error(const multirobot::MergedFlight& flight, const SE3& T_base_world,
                        const fs::path& folder) {
  const std::vector<StampedPose> truth = read_trajectory(folder / "trajectory_truth.txt");
  double square = 0;
  int compared = 0;
  for (const slam::Keyframe& keyframe : flight.keyframes) {
    const StampedPose* pose = pose_at(truth, to_seconds(keyframe.stamp));
    if (pose == nullptr) continue;
    const SE3 T_base_lidar = T_base_world * pose->T_world_lidar;
    square += (keyframe.T_world_lidar.translation() - T_base_lidar.translation()).squaredNorm();
    ++compared;
  }
  return compared > 0 ? std::sqrt(square / compared) : NAN;
}

double merged_error(const TeamFlights& flights, std::size_t robot, const TeamSite& site,
                    const fs::path& out) {
  const std::string& name = flights.flights()[robot].robot;
  const auto& merged = flights.merged().flights();
  const auto flight = std::ranges::find(merged, name, &multirobot::MergedFlight::robot);
  if (flight == merged.end()) return NAN;
  return trajectory_error(*flight, site.robots[robot].T_base_world, out / name);
}

Json row_of(const TeamFlight& flight) {
  Json row = {{"robot", flight.robot}};
  for (const char* key : {"policy", "succeeded", "phase", "outcome", "targets", "found", "bias_m",
                          "sd_m", "mae_m", "errors", "collisions", "min_clearance_m",
                          "flight_time_s", "path_m", "trajectory_error_m"}) {
    row[key] = flight.results.at(key);
  }
  row["objects_per_min"] = number(per_minute(row["found"], busy_s(flight)));
  row["known"] = flight.known;
  row["weak"] = flight.weak;
  row["history_bytes"] = flight.history_bytes;
  row["exchange_s"] = flight.before.seconds + flight.after.seconds;
  row["exchange_bytes"] = flight.before.bytes + flight.after.bytes;
  row["exchange_datagrams"] = flight.before.datagrams + flight.after.datagrams;
  row["exchange_lost"] = flight.before.lost + flight.after.lost;
  row["exchange_complete"] = flight.before.complete && flight.after.complete;
  row["merge"] = {{"status", to_string(flight.merge.status)}, {"keyframes", flight.merge.entries},
                  {"matched", flight.merge.matched},          {"created", flight.merge.created},
                  {"refused", flight.merge.refused},          {"split", flight.merge.split}};
  return row;
}

Json merged_row(const Json& robots, const TeamFlights& flights, const TeamSite& site,
                const objects::ClassTable& table) {
  const objects::ObjectMap map = flights.map();
  Json row = target_figures(map, site.truth, site.targets, table);
  double longest_s = 0;
  std::vector<double> rates;
  for (const TeamFlight& flight : flights.flights()) {
    longest_s = std::max(longest_s, busy_s(flight));
  }
  for (const Json& robot : robots) {
    if (!robot["objects_per_min"].is_null())
      rates.push_back(robot["objects_per_min"].get<double>());
  }
  const double rate = per_minute(row["found"], longest_s);
  row["objects"] = map.objects.size();
  row["longest_s"] = longest_s;
  row["objects_per_min"] = number(rate);
  row["of_the_robots_mean"] = number(rate / core::mean(rates));
  return row;
}

std::string line(const std::string& name, const Json& row, const std::string& rest) {
  const auto figure = [&](const char* key) {
    return row.at(key).is_null() ? NAN : row.at(key).get<double>();
  };
  return fmt::format(
      "{:<16} {:>9} {:>9.2f} {:>7.3f} {:>6.3f} {:>6.3f} {}\n", name,
      fmt::format("{} of {}", row.at("found").get<int>(), row.at("targets").get<int>()),
      figure("objects_per_min"), figure("bias_m"), figure("sd_m"), figure("mae_m"), rest);
}

}  // namespace

Json team_results(const TeamFlights& flights, const TeamSite& site, const TeamMission& mission,
                  std::uint64_t seed, const fs::path& out) {
  Json robots = Json::array();
  for (std::size_t i = 0; i < flights.flights().size(); ++i) {
    robots.push_back(row_of(flights.flights()[i]));
    robots.back()["merged_trajectory_error_m"] = number(merged_error(flights, i, site, out));
  }
  return {{"mission", mission.name},
          {"seed", seed},
          {"robots", robots},
          {"merged", merged_row(robots, flights, site, mission.robots.front().objects)}};
}

std::string team_table(const Json& results) {
  std::string text =
      fmt::format("{:<16} {:>9} {:>9} {:>7} {:>6} {:>6} {:>7} {:>7} {:>10} {:>10} {:>5} {:>5}\n",
                  "robot", "found", "obj./min", "bias m", "sd m", "MAE m", "time s", "exch. s",
                  "history B", "sent B", "known", "weak");
  for (const Json& robot : results.at("robots")) {
    text += line(
        robot.at("robot"), robot,
        fmt::format("{:>7.1f} {:>7.1f} {:>10} {:>10} {:>5} {:>5}",
                    robot.at("flight_time_s").get<double>(), robot.at("exchange_s").get<double>(),
                    robot.at("history_bytes").get<long>(), robot.at("exchange_bytes").get<long>(),
                    robot.at("known").get<int>(), robot.at("weak").get<int>()));
  }
  const Json& merged = results.at("merged");
  text +=
      line("all together", merged, fmt::format("{:>7.1f}", merged.at("longest_s").get<double>()));
  return text;
}

void write_team_maps(const TeamFlights& flights, const TeamSite& site,
                     const objects::ClassTable& table, const fs::path& out) {
  const objects::ObjectMap map = flights.map();
  objects::write_map(out / "map.json", map, table);
  objects::write_map(out / "map.smap", map, table);
  objects::write_map(out / "truth.json", site.truth, table);
  objects::write_map(out / "prior.json", site.said, table);
  MapView view{.map = map, .truth = &site.truth};
  for (const multirobot::MergedFlight& flight : flights.merged().flights()) {
    RobotPath& path = view.robots.emplace_back();
    path.robot = flight.robot;
    for (const slam::Keyframe& keyframe : flight.keyframes) {
      path.positions.emplace_back(keyframe.T_world_lidar.translation());
    }
  }
  write_map_picture(out / "map.png", view, table);
}

}  // namespace saker::tools
