#include "flight/viewers/run_folder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <set>

#include "flight/bus/fields.h"
#include "flight/bus/messages.h"
#include "flight/bus/scan_log.h"
#include "flight/viewers/run_log.h"
#include "saker/core/error.h"

namespace saker::flight::viewers {
namespace {

namespace fs = std::filesystem;

constexpr double kBefore = -std::numeric_limits<double>::infinity();

bool is_run(const fs::path& folder) {
  return fs::exists(folder / "map.json") || fs::exists(folder / "map.smap") ||
         fs::exists(folder / "trajectory.txt");
}

std::int64_t utime_of(double t) { return static_cast<std::int64_t>(std::llround(t * 1e6)); }

odometry_t odometry_of(const StampedPose& pose, const StampedPose* before) {
  odometry_t message{};
  message.utime = utime_of(pose.t);
  write_pose(pose.T_world_lidar, message.position, message.orientation);
  Eigen::Vector3d velocity = Eigen::Vector3d::Constant(NAN);
  if (before != nullptr && pose.t > before->t)
    velocity = (pose.T_world_lidar.translation() - before->T_world_lidar.translation()) /
               (pose.t - before->t);
  write_field(velocity, message.velocity);
  std::fill_n(message.angular_velocity, 3, NAN);
  std::fill_n(message.covariance, 36, NAN);
  message.status = odometry_t::OK;
  return message;
}

/// The viewpoint that is flown to, as the plan that chose it.
plan_t plan_of(const StampedPose& viewpoint, std::int64_t id) {
  candidate_t candidate{};
  candidate.target_id = -1;
  write_field(viewpoint.T_world_lidar.translation(), candidate.position);
  const Eigen::Matrix3d R = viewpoint.T_world_lidar.linear();
  candidate.yaw = static_cast<float>(std::atan2(R(1, 0), R(0, 0)));
  candidate.gain = candidate.path_m = NAN;
  plan_t message{};
  message.utime = utime_of(viewpoint.t);
  message.trajectory_id = id;
  message.candidates = {candidate};
  message.num_candidates = 1;
  return message;
}

/// Entries with a time in (from, to], which are in the order of time.
template <class Entries, class TimeOf, class Do>
void each_between(const Entries& entries, double from, double to, TimeOf time_of, Do act) {
  const auto first = std::partition_point(
      entries.begin(), entries.end(), [&](const auto& entry) { return time_of(entry) <= from; });
  for (auto at = first; at != entries.end() && time_of(*at) <= to; ++at)
    act(*at, static_cast<std::size_t>(at - entries.begin()));
}

double time_of_window(const detections_t& message) { return to_seconds(from_utime(message.utime)); }

}  // namespace

FolderRun::FolderRun(const fs::path& folder, const Site& site) {
  static const std::regex robot_name(kAnyRobot);
  std::set<fs::path> inner;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const bool named = std::regex_match(entry.path().filename().string(), robot_name);
    if (entry.is_directory() && named && is_run(entry.path())) inner.insert(entry.path());
  }
  for (const fs::path& robot : inner)
    robots_.push_back(read_robot_run(robot, robot.filename().string(), site));
  if (is_run(folder))
    robots_.push_back(read_robot_run(folder, inner.empty() ? "R1" : "TEAM", site));
  if (robots_.empty())
    throw Error(folder.string() +
                ": no map.json and no trajectory.txt in it, expected the folder of one run");
  begin_s_ = std::numeric_limits<double>::infinity();
  end_s_ = kBefore;
  for (const RobotRun& run : robots_) {
    if (run.poses.empty()) continue;
    begin_s_ = std::min(begin_s_, run.poses.front().t);
    end_s_ = std::max(end_s_, run.poses.back().t);
  }
  if (!(begin_s_ <= end_s_)) begin_s_ = end_s_ = 0;
  at_s_ = kBefore;
}

void FolderRun::show_map(const RobotRun& run, double t, RobotView& view) const {
  std::set<int> later;
  for (const RobotRun::Reveal& reveal : run.reveals) {
    if (reveal.t > t) later.insert(reveal.id);
  }
  objects::ObjectMap now = run.map;
  std::erase_if(now.objects, [&](const objects::MapObject& o) { return later.contains(o.id); });
  view.set_map(now, utime_of(t), t);
}

void FolderRun::advance(const RobotRun& run, double t, RobotView& view) const {
  const bool first = at_s_ == kBefore;
  const auto pose_time = [](const StampedPose& pose) { return pose.t; };
  if (first && !run.figures.is_null()) view.set_figures(run.figures);
  each_between(run.poses, at_s_, t, pose_time, [&](const StampedPose& pose, std::size_t i) {
    view.hear(odometry_of(pose, i > 0 ? &run.poses[i - 1] : nullptr), pose.t);
  });
  each_between(
      run.events, at_s_, t, [](const RobotRun::Event& event) { return event.t; },
      [&](const RobotRun::Event& event, std::size_t) { view.hear(event.message, event.t); });
  each_between(run.viewpoints, at_s_, t, pose_time,
               [&](const StampedPose& viewpoint, std::size_t i) {
                 view.hear(plan_of(viewpoint, static_cast<std::int64_t>(i) + 1), viewpoint.t);
               });
  each_between(
      run.detections, at_s_, t, time_of_window,
      [&](const detections_t& window, std::size_t) { view.hear(window, time_of_window(window)); });
  bool revealed = first;
  each_between(
      run.reveals, at_s_, t, [](const RobotRun::Reveal& reveal) { return reveal.t; },
      [&](const RobotRun::Reveal&, std::size_t) { revealed = true; });
  if (revealed) show_map(run, t, view);
  if (t >= end_s_ && !(at_s_ >= end_s_)) view.set_targets(run.targets);
}

void FolderRun::advance(double t, RobotViews& views) {
  for (const RobotRun& run : robots_) {
    RobotView* const view = views.add(run.robot, run.site);
    if (view != nullptr) advance(run, t, *view);
  }
  at_s_ = t;
}

void FolderRun::rewind(RobotViews& views) {
  views.clear();
  at_s_ = kBefore;
}

std::unique_ptr<Run> open_run(const fs::path& path, const Site& site) {
  if (fs::is_directory(path)) return std::make_unique<FolderRun>(path, site);
  if (fs::exists(path) && is_lcm_log(path)) return std::make_unique<LogRun>(path);
  throw Error("cannot read " + path.string() +
              ": expected the folder of a run or a log of lcm-logger");
}

}  // namespace saker::flight::viewers
