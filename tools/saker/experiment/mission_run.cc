#include "tools/saker/experiment/mission_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "saker/autonomy/local_checker.h"
#include "saker/core/files.h"
#include "saker/exchange/packed_history.h"
#include "saker/objects/map_io.h"
#include "tools/plant/simulated_plant.h"
#include "tools/saker/experiment/mission_recorder.h"
#include "tools/saker/experiment/reachable_targets.h"
#include "tools/saker/picture/map_picture.h"
#include "tools/saker/replay/run_recorder.h"

namespace saker::tools {
namespace {

namespace fs = std::filesystem;

/// What it is told beforehand, `world`, and what is to be mapped.
struct Task {
  std::vector<int> targets;
  objects::ObjectMap prior;
  std::vector<double> fence_m;
};

Task task_of(const MissionRun& run, const simulation::MissionWorld& site) {
  if (!run.team) return {site.targets, site.prior, site.fence.polygon_m};
  const TeamRole& role = *run.team;
  return {role.targets, role.prior, role.fence_m};
}

simulation::SimulatedVehicle vehicle_of(const MissionRun& run) {
  if (!run.team) return {run.site, run.seed};
  return {run.site, run.seed, run.team->takeoff, run.team->own_seed};
}

/// Every phase with its deadline, twice: then something is wrong with the deadlines themselves.
double longest_s(const autonomy::MissionConfig& config) {
  return 2 * (config.preflight_s + config.takeoff_s + config.tour_s + config.return_s +
              config.landing_s);
}

/// Ids of all parked vehicles over which the vehicle may fly, targets or not.
std::vector<int> in_fence(const objects::ObjectMap& truth, const autonomy::Config& config) {
  const motion::Geofence fence(config.motion.geofence);
  std::vector<int> ids;
  for (const objects::MapObject& object : truth.objects) {
    const Eigen::Vector3d place = objects::place(object.model);
    const bool inside = fence.inside_polygon_m(place.head<2>()) >= 0;
    if (inside && config.objects[object.class_id].target) ids.push_back(object.id);
  }
  return ids;
}

/// By world and fence as they are when the mission begins.
std::vector<int> reachable_of(const MissionRun& run, const Task& task,
                              const autonomy::Config& config,
                              const simulation::SimulatedVehicle& vehicle) {
  const ReachableSpace space{.world = vehicle.site().world(),
                             .caster = vehicle.caster(),
                             .T_sim_world = vehicle.site().T_sim_world,
                             .fence = config.motion.geofence,
                             .radius_m = run.site.airframe.radius_m};
  return reachable_targets(task.targets, vehicle.true_map(), space,
                           autonomy::active_as_flown(config, vehicle.sensor()).view);
}

std::string policy_of(const MissionRun& run) {
  if (!run.policy.empty()) return run.policy;
  const active::PolicyName policy = run.config.active.policy;
  return active::enum_names(policy)[static_cast<std::size_t>(policy)];
}

Json target_list(const std::vector<active::Target>& targets) {
  Json list = Json::array();
  for (const active::Target& target : targets) {
    list.push_back(
        {{"id", target.id}, {"status", to_string(target.status)}, {"reason", target.reason}});
  }
  return list;
}

Json mission_figures(const autonomy::MissionResult& result, const simulation::VehicleTruth& truth) {
  const auto count = [&](active::TargetStatus status) {
    return std::ranges::count(result.targets, status, &active::Target::status);
  };
  const autonomy::MissionCounters& counters = result.counters;
  return {{"succeeded", result.succeeded},
          {"phase", to_string(result.phase)},
          {"outcome", to_string(result.outcome)},
          {"visited", count(active::TargetStatus::done) + count(active::TargetStatus::visited)},
          {"unreachable", count(active::TargetStatus::unreachable)},
          {"collisions", truth.collisions},
          {"min_clearance_m", number(truth.min_clearance_m)},
          {"flight_time_s", truth.flight_time_s},
          {"path_m", truth.path_m},
          {"scans", counters.scans},
          {"scans_not_registered", counters.scans_not_registered},
          {"scans_not_held", counters.scans_not_held},
          {"plans", counters.plans},
          {"refused_plans", counters.refused_plans},
          {"commits", counters.commits},
          {"refused_commits", counters.refused_commits},
          {"stops", counters.stops},
          {"target_list", target_list(result.targets)}};
}

std::string rows_of(const std::vector<StampedPose>& poses) {
  std::string rows;
  for (const StampedPose& pose : poses) rows += tum_row(from_seconds(pose.t), pose.T_world_lidar);
  return rows;
}

void write_trajectories(const autonomy::MissionResult& result, const MissionRecorder& recorder,
                        const fs::path& out) {
  std::string trajectory, odometry;
  for (std::size_t i = 0; i < result.T_world_lidar.size(); ++i) {
    trajectory += tum_row(result.scans[i].stamp, result.T_world_lidar[i]);
    odometry += tum_row(result.scans[i].stamp, result.scans[i].T_odom_lidar);
  }
  core::write_file(out / "trajectory.txt", trajectory);
  core::write_file(out / "odometry.txt", odometry);
  core::write_file(out / "trajectory_truth.txt", rows_of(recorder.true_poses()));
  std::string viewpoints;
  for (const auto& [stamp, viewpoint] : recorder.flown_to()) {
    viewpoints += tum_row(stamp, viewpoint.pose());
  }
  core::write_file(out / "viewpoints.txt", viewpoints);
}

void write_maps(const autonomy::MissionResult& result, const objects::ObjectMap& truth,
                const objects::ObjectMap& prior, const MissionRecorder& recorder,
                const objects::ClassTable& table, const fs::path& out) {
  objects::write_map(out / "map.json", result.map, table);
  objects::write_map(out / "map.smap", result.map, table);
  objects::write_map(out / "truth.json", truth, table);
  objects::write_map(out / "prior.json", prior, table);
  std::vector<Eigen::Vector3d> path;
  for (const SE3& T : result.T_world_lidar) path.emplace_back(T.translation());
  std::vector<Eigen::Vector3d> viewpoints;
  for (const auto& [stamp, viewpoint] : recorder.flown_to()) {
    viewpoints.push_back(viewpoint.position);
  }
  write_map_picture(out / "map.png",
                    {.map = result.map,
                     .truth = &truth,
                     .trajectory = std::move(path),
                     .viewpoints = std::move(viewpoints),
                     .cloud = recorder.cloud().in_world(result.T_world_lidar)},
                    table);
}

/// Into the recording what the finished folder holds, and some points of each scan.
void finish_recording(RunRecording& recording, const MissionRun& run,
                      const autonomy::Config& config, const autonomy::MissionResult& result,
                      const MissionRecorder& recorder, const fs::path& out) {
  std::vector<Time> stamps;
  for (const autonomy::ScanRecord& scan : result.scans) stamps.push_back(scan.stamp);
  recording.finish(out, flight::viewers::site_of(config, run.origin),
                   recorder.cloud().scans(stamps, result.T_world_lidar));
}

/// What it tells other robots.
void write_history(const MissionRun& run, slam::History history, const objects::ClassTable& table,
                   const fs::path& out) {
  history.robot = run.robot;
  history.flight = 1;
  const auto takeoff = run.team ? std::optional(run.team->surveyed) : std::nullopt;
  core::write_file(out / "history.bin", exchange::packed(history, table.size(), takeoff));
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

autonomy::Config at_site(autonomy::Config config, const simulation::MissionConfig& site,
                         const simulation::MissionFence& fence) {
  config.motion.geofence = {fence.lowest_m, fence.highest_m, fence.polygon_m};
  config.mount = {site.mount.position_m, site.mount.rotation_deg};
  return autonomy::within_geofence(std::move(config));
}

Json fly(const MissionRun& run, const fs::path& out) {
  const auto begin = std::chrono::steady_clock::now();
  simulation::SimulatedVehicle vehicle = vehicle_of(run);
  const Task task = task_of(run, vehicle.site());
  simulation::MissionFence fence = vehicle.site().fence;
  fence.polygon_m = task.fence_m;
  const autonomy::Config config = at_site(run.config, run.site, fence);
  const std::string note = autonomy::noise_note(config, lidar::name_and_mode(vehicle.sensor()));
  if (!note.empty()) run.log->info("{}", note);
  SimulatedPlant plant(vehicle);
  autonomy::LocalChecker checker(config.local_checker, config.collision_checker,
                                 config.motion.clearance);
  core::Timings timings;
  autonomy::MissionLockstep mission(config, vehicle.sensor(), task.prior, plant, checker,
                                    run.threads, timings);
  std::optional<core::Progress> progress;
  if (run.shows_progress) progress.emplace(run.scenario, task.targets.size());
  const std::vector<int> reachable = reachable_of(run, task, config, vehicle);
  const double longest = longest_s(config.mission);
  MissionRecorder recorder(
      vehicle, out, config.objects, run.log, progress ? &*progress : nullptr,
      static_cast<std::size_t>(std::ceil(longest * vehicle.sensor().frame_rate_hz)));
  std::optional<RunRecording> recording;
  if (run.record) recorder.record_into(&recording.emplace(*run.record, "R1"));
  const double built_s = seconds_since(begin);
  const Time start = vehicle.now();
  const autonomy::MissionResult result = mission.run(longest, recorder);
  const double wall_s = seconds_since(begin) - built_s, flown_s = to_seconds(vehicle.now() - start);

  const objects::ObjectMap truth = vehicle.true_map();
  Json results = {{"scenario", run.scenario}, {"policy", policy_of(run)}, {"seed", run.seed}};
  results.update(target_figures(result.map, truth, task.targets, config.objects));
  results["reachable_targets"] = reachable;
  const Json around = target_figures(result.map, truth, in_fence(truth, config), config.objects);
  results["in_fence"] = around["targets"];
  results["in_fence_found"] = around["found"];
  results["consistency"] = consistency_figures(result.map, truth, config.objects);
  results["classes"] = class_counts(result.map, truth, config.objects);
  results.update(mission_figures(result, vehicle.truth()));
  const Json trajectory =
      trajectory_figures(result.scans, result.T_world_lidar, recorder.true_poses());
  results["trajectory_error_m"] = trajectory.is_null() ? Json() : trajectory["position_rmse_m"];
  results["trajectory"] = trajectory;
  results.update(recorder.record());
  results["wall_s"] = wall_s;
  results["set_up_s"] = built_s;
  results["real_time_factor"] = flown_s / wall_s;

  recorder.finish();
  write_trajectories(result, recorder, out);
  write_maps(result, truth, task.prior, recorder, config.objects, out);
  write_history(run, result.history, config.objects, out);
  core::write_file(out / "viewpoints.csv", recorder.viewpoints().csv());
  core::write_file(out / "timings.csv", timings.csv());
  core::write_file(out / "results.json", results.dump(2) + "\n");
  if (recording) finish_recording(*recording, run, config, result, recorder, out);
  return results;
}

std::optional<Json> finished(const fs::path& folder) {
  const fs::path file = folder / "results.json";
  if (!fs::exists(file)) return std::nullopt;
  return Json::parse(core::read_file(file));
}

}  // namespace saker::tools
