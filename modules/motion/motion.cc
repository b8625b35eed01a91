#include "saker/motion/motion.h"

#include <ompl/util/Console.h>

#include <cmath>
#include <cstdio>
#include <utility>

#include "saker/motion/curve.h"
#include "saker/motion/destination.h"
#include "saker/motion/free_space.h"
#include "saker/motion/retiming.h"
#include "saker/motion/speed_profile.h"
#include "saker/motion/trajectory_check.h"

namespace saker::motion {
namespace {

constexpr double kMoves = 0.01;          // m/s: slower is a jump that the averaging hides
constexpr double kStartTolerance = 1.2;  // of a limit, at the start of a plan
constexpr double kBrakingShare = 0.9;    // of the acceleration, for the length of the first leg
constexpr double kFirstShares[] = {1, 0.5, 0.25, 0.125, 0};  // of the widest first corner

std::string line(const char* format, const Eigen::Vector3d& p) {
  char text[160];
  std::snprintf(text, sizeof text, format, p.x(), p.y(), p.z());
  return text;
}

/// One planning step, from what was asked to what comes out.
class Planning {
 public:
  Planning(const MotionConfig& config, const Geofence& fence, const PlanRequest& request,
           const core::Budget& budget)
      : config_(config), fence_(fence), request_(request), budget_(budget) {}

  PlanResult run() {
    if (!acceptable()) return result_;
    const FreeSpace space(*request_.grid, config_.clearance, fence_,
                          {.takeoff = request_.takeoff, .vehicle = request_.start.position});
    Waypoints path = way_to_stop(space);
    if (path.empty() || !continue_to_goal(space, path)) return result_;
    follow(space, path);
    return result_;
  }

 private:
  bool refuse(PlanStatus status, std::string reason) {
    result_.status = status;
    result_.reason = std::move(reason);
    return false;
  }

  bool acceptable() {
    const MotionState& start = request_.start;
    if (request_.grid == nullptr || request_.grid->cells.empty())
      return refuse(PlanStatus::bad_request, "no occupancy snapshot");
    const bool finite = start.position.allFinite() && start.velocity.allFinite() &&
                        start.acceleration.allFinite() && std::isfinite(start.yaw) &&
                        std::isfinite(start.yaw_rate) && request_.goal.allFinite() &&
                        std::isfinite(request_.goal_yaw.value_or(0));
    if (!finite) return refuse(PlanStatus::bad_request, "start or goal is not finite");
    const LimitsConfig& limits = config_.limits;
    if (start.velocity.norm() > kStartTolerance * limits.max_speed ||
        start.acceleration.norm() > kStartTolerance * limits.max_acceleration)
      return refuse(PlanStatus::bad_request, "the start moves faster than the limits");
    if (!fence_.contains(request_.goal))
      return refuse(PlanStatus::goal_outside,
                    line("goal (%.1f, %.1f, %.1f) is outside of the geofence", request_.goal));
    if (budget_.seconds_left() <= 0) return refuse(PlanStatus::out_of_time, "no time at the start");
    return true;
  }

  /// From the end of the first window straight on for as long as braking takes.
  Waypoints way_to_stop(const FreeSpace& space) {
    const Eigen::Vector3d& here = request_.start.position;
    if (!space.vehicle_is_clear()) {
      refuse(PlanStatus::start_blocked,
             line("the vehicle touches something at (%.2f, %.2f, %.2f)", here));
      return {};
    }
    const MotionState departure = after_first_window(request_.start, config_.limits);
    const double speed = departure.velocity.norm();
    Waypoints way{departure.position};
    if (speed > kMoves) {
      start_speed_ = speed;
      const double braking_m =
          speed * speed / (2 * kBrakingShare * config_.limits.max_acceleration);
      way.push_back(departure.position + braking_m / speed * departure.velocity);
    }
    if (!space.free(here, way.front()) || !space.free(way.front(), way.back())) {
      refuse(PlanStatus::start_blocked,
             line("no room to brake straight on to (%.2f, %.2f, %.2f)", way.back()));
      return {};
    }
    return way;
  }

  /// Adds the way from where the vehicle could stop to the goal, or as far towards it as is known.
  bool continue_to_goal(const FreeSpace& space, Waypoints& path) {
    const Eigen::Vector3d from = path.back();
    if (space.free(from, request_.goal)) {
      result_.diagnostics.straight = true;
      path.push_back(request_.goal);
      return true;
    }
    const std::vector<int> reached = reachable_cells(space, from, budget_);
    if (reached.empty())
      return refuse(PlanStatus::start_blocked,
                    line("nothing is free around (%.2f, %.2f, %.2f)", from));
    const Destination to =
        find_destination(space, reached, request_.goal, config_.search.goal_tolerance_m, budget_);
    if (!accept(to, from)) return false;
    return search(space, reached, to.point, path);
  }

  bool accept(const Destination& to, const Eigen::Vector3d& from) {
    switch (to.kind) {
      case DestinationKind::goal:
        return true;
      case DestinationKind::on_the_way:
        result_.partial = (to.point - from).norm() > config_.search.least_progress_m;
        if (result_.partial) return true;
        return refuse(PlanStatus::no_progress,
                      line("what is known to be free ends at (%.1f, %.1f, %.1f)", to.point));
      case DestinationKind::blocked:
        return refuse(PlanStatus::goal_blocked,
                      line("nothing is free near the goal (%.1f, %.1f, %.1f)", request_.goal));
      case DestinationKind::enclosed:
        return refuse(PlanStatus::no_path,
                      line("obstacles cut off the goal (%.1f, %.1f, %.1f)", request_.goal));
      case DestinationKind::out_of_time:
        break;
    }
    return refuse(PlanStatus::out_of_time, "while looking where to fly");
  }

  bool search(const FreeSpace& space, const std::vector<int>& reached, const Eigen::Vector3d& to,
              Waypoints& path) {
    if (space.free(path.back(), to)) {
      result_.diagnostics.straight = true;
      path.push_back(to);
      return true;
    }
    const SearchResult found =
        search_path(space, reached, path.back(), to, config_.search, request_.seed, budget_);
    result_.diagnostics.iterations = found.iterations;
    if (found.path.empty()) {
      return refuse(PlanStatus::out_of_time,
                    line("no path to (%.1f, %.1f, %.1f) within the budget", to));
    }
    path.insert(path.end(), found.path.begin() + 1, found.path.end());
    return true;
  }

  /// The first corner is rounded as widely as the start's speed allows; at worst the vehicle stops.
  void follow(const FreeSpace& space, const Waypoints& path) {
    for (const double share : kFirstShares) {
      const Curve curve = rounded(path, space, config_.search.widest_corner_m, share);
      const auto speeds = speed_profile(curve, start_speed_, config_.limits);
      if (!speeds) continue;
      Trajectory trajectory = retimed(request_.start, request_.start_time, curve, *speeds,
                                      request_.goal_yaw, config_.limits);
      trajectory.id = request_.trajectory_id;
      finish(space, std::move(trajectory), curve.back().s);
      return;
    }
    refuse(PlanStatus::unsafe_result, "the start's speed cannot be braked on its first leg");
  }

  void finish(const FreeSpace& space, Trajectory trajectory, double path_m) {
    const TrajectoryCheck check = examined(trajectory, space, config_.limits);
    result_.diagnostics.path_m = path_m;
    result_.diagnostics.duration_s = trajectory.duration_s();
    result_.diagnostics.clearance_m = check.clearance_m;
    if (!check.fault.empty()) {
      refuse(PlanStatus::unsafe_result, check.fault);
      return;
    }
    result_.status = PlanStatus::ok;
    result_.trajectory = std::move(trajectory);
  }

  const MotionConfig& config_;
  const Geofence& fence_;
  const PlanRequest& request_;
  const core::Budget& budget_;
  double start_speed_ = 0;  // m/s, where the curve begins
  PlanResult result_;
};

}  // namespace

const char* to_string(PlanStatus status) {
  constexpr const char* kNames[] = {"ok",           "bad_request",  "start_blocked",
                                    "goal_outside", "goal_blocked", "no_path",
                                    "no_progress",  "out_of_time",  "unsafe_result"};
  return kNames[static_cast<int>(status)];
}

MotionPlanner::MotionPlanner(const MotionConfig& config)
    : config_(core::checked(config, "motion")), geofence_(config_.geofence) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);  // it would write to the terminal at every search
}

PlanResult MotionPlanner::plan(const PlanRequest& request, const core::Budget& budget) const {
  return Planning(config_, geofence_, request, budget).run();
}

}  // namespace saker::motion
