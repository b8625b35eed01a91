#include "tools/saker/flight_report/flight_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "saker/core/error.h"

namespace saker::tools {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double value(const Json& figures, const char* key) {
  const Json& entry = figures.at(key);
  return entry.is_number() ? entry.get<double>() : kNone;
}

/// Processor seconds a second of a process.
double cpu_of(const Json& process) { return value(process, "cpu_s") / value(process, "wall_s"); }

/// Ids of those of the prior map that are there.
std::vector<int> true_targets(const FlownMission& flight) {
  const auto& truth = flight.truth.map.objects;
  std::vector<int> ids;
  for (const objects::MapObject& object : flight.prior.objects) {
    const bool there = std::ranges::find(truth, object.id, &objects::MapObject::id) != truth.end();
    if (there) ids.push_back(object.id);
  }
  return ids;
}

/// True length and width beside each error.
void add_true_sizes(Json& errors, const objects::ObjectMap& truth) {
  for (Json& error : errors) {
    const auto object =
        std::ranges::find(truth.objects, error["id"].get<int>(), &objects::MapObject::id);
    const Eigen::Vector3d& size = std::get<objects::Cuboid>(object->model).size;
    error["true_length_m"] = size.x();
    error["true_width_m"] = size.y();
  }
}

Json missed_of(const std::vector<int>& targets, const Json& found) {
  Json missed = Json::array();
  for (const int id : targets) {
    if (std::ranges::none_of(found, [&](const Json& error) { return error["id"] == id; }))
      missed.push_back(id);
  }
  return missed;
}

Json trajectory_of(const FlownMission& flight) {
  std::vector<autonomy::ScanRecord> scans(flight.trajectory.size());
  std::vector<SE3> poses;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    scans[i].stamp = from_seconds(flight.trajectory[i].t);
    poses.push_back(flight.trajectory[i].T_world_lidar);
  }
  return trajectory_figures(scans, poses, flight.truth.trajectory);
}

std::string target_rows(const Json& figures) {
  std::string text = "target  true length x width    mapped - true    place off by\n";
  for (const Json& error : figures.at("errors")) {
    text += fmt::format("{:6}  {:6.2f} x {:.2f} m   {:+10.2f}  {:+.2f} m  {:11.2f} m\n",
                        error["id"].get<int>(), value(error, "true_length_m"),
                        value(error, "true_width_m"), value(error, "length_m"),
                        value(error, "width_m"), value(error, "distance_m"));
  }
  return text;
}

std::string loop_rows(const Json& figures) {
  std::string text = "loop            deadlines  late > 5 ms  worst ms  CPU s a second\n";
  const double wall_s = value(figures, "wall_s");
  for (const Json& loop : figures.at("loops")) {
    text += fmt::format("{:14}  {:9}  {:11}  {:8.1f}  {:14.3f}\n", loop["name"].get<std::string>(),
                        loop["runs"].get<long>(), loop["late"].get<long>(),
                        value(loop, "worst_late_ms"), value(loop, "cpu_s") / wall_s);
  }
  text += fmt::format("executive, all threads: {:.2f} CPU s a second; ", value(figures, "cpu"));
  if (!figures.at("checker_cpu").is_null()) {
    text += fmt::format("collision checker: {:.2f}; ", value(figures, "checker_cpu"));
  }
  return text + fmt::format("simulator: {:.2f}\n", value(figures, "simulator_cpu"));
}

std::string flown(const Json& figures) {
  return fmt::format(
      "{} of {} targets found; length and width: mean {:+.3f}, sd {:.3f}, MAE {:.3f} m\n"
      "trajectory: {:.3f} m RMS, {:.3f} m at most\n"
      "{} collisions, clearance at least {:.2f} m (true, of the vehicle's sphere)\n"
      "{:.0f} s in the air, {:.0f} m, {}\n",
      figures.at("found").get<int>(), figures.at("targets").get<int>(), value(figures, "bias_m"),
      value(figures, "sd_m"), value(figures, "mae_m"), value(figures, "trajectory_error_m"),
      value(figures, "trajectory_max_m"), figures.at("collisions").get<int>(),
      value(figures, "min_clearance_m"), value(figures, "flight_time_s"), value(figures, "path_m"),
      figures.at("landed").get<bool>() ? "landed" : "not landed");
}

}  // namespace

Json flight_figures(const FlownMission& flight, const objects::ClassTable& table) try {
  const std::vector<int> targets = true_targets(flight);
  Json figures = target_figures(flight.map, flight.truth.map, targets, table);
  figures["missed"] = missed_of(targets, figures["errors"]);
  add_true_sizes(figures["errors"], flight.truth.map);
  const Json trajectory = trajectory_of(flight);
  figures["trajectory_error_m"] = trajectory.is_null() ? Json() : trajectory["position_rmse_m"];
  figures["trajectory_max_m"] = trajectory.is_null() ? Json() : trajectory["position_max_m"];
  for (const char* key :
       {"collisions", "min_clearance_m", "flight_time_s", "path_m", "landed", "seed", "behind_s"}) {
    figures[key] = flight.simulator.at(key);
  }
  figures["wall_s"] = flight.loops.at("wall_s");
  figures["cpu"] = cpu_of(flight.loops);
  figures["checker_cpu"] = flight.checker.is_null() ? Json() : Json(cpu_of(flight.checker));
  figures["simulator_cpu"] = cpu_of(flight.simulator);
  figures["loops"] = flight.loops.at("loops");
  return figures;
} catch (const Json::exception& error) {
  throw Error(fmt::format("loops.json or sim.json: {}", error.what()));
}

std::vector<std::string> shortfalls_of(const Json& figures, const FlightLimits& limits) {
  std::vector<std::string> lines;
  const auto at_most = [&](const char* key, double limit, const char* what) {
    const double figure = value(figures, key);
    if (figure <= limit) return;
    lines.push_back(fmt::format("{}: {:.3f}, expected at most {:g}", what, figure, limit));
  };
  if (const Json& missed = figures.at("missed"); !missed.empty()) {
    lines.push_back("targets not found: " + missed.dump());
  }
  if (!figures.at("landed").get<bool>()) lines.emplace_back("not landed");
  at_most("mae_m", limits.size_mae_m, "MAE of length and width, m");
  at_most("trajectory_error_m", limits.trajectory_error_m, "trajectory error, m");
  at_most("collisions", 0, "collisions");
  return lines;
}

std::string flight_text(const Json& figures, const std::vector<std::string>& shortfalls) {
  std::string text = target_rows(figures) + flown(figures) + loop_rows(figures);
  for (const std::string& line : shortfalls) text += "falls short: " + line + "\n";
  return text;
}

}  // namespace saker::tools
