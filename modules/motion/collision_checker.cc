#include "saker/motion/collision_checker.h"

#include <utility>

namespace saker::motion {
namespace {

const Eigen::Vector3d kTakeoff = Eigen::Vector3d::Zero();  // `odom` begins there

// Beyond these a number is a mistake, and indices and times would overflow.
constexpr double kMostMetres = 1e6;
constexpr double kMostSpeed = 1e3;
constexpr double kMostStep_s = 10;

bool well_formed(const Trajectory& trajectory) {
  if (trajectory.empty() || trajectory.id <= 0) return false;
  if (!(trajectory.step_s > 0 && trajectory.step_s <= kMostStep_s)) return false;
  for (const MotionState& state : trajectory.states)
    if (!(state.position.cwiseAbs().maxCoeff() <= kMostMetres) ||
        !(state.velocity.cwiseAbs().maxCoeff() <= kMostSpeed) || state.position.hasNaN() ||
        state.velocity.hasNaN())
      return false;
  return true;
}

}  // namespace

const char* to_string(TrajectoryStatus status) {
  constexpr const char* kNames[] = {"ok", "malformed", "outdated"};
  return kNames[static_cast<int>(status)];
}

CollisionChecker::CollisionChecker(const CollisionCheckerConfig& config,
                                   const ClearanceConfig& clearance)
    : config_(core::checked(config, "collision_checker")),
      clearance_(core::checked(clearance, "clearance")),
      map_(config_.map) {}

occupancy::InsertReport CollisionChecker::integrate(Time stamp, const SE3& T_odom_lidar,
                                                    std::span<const Eigen::Vector3f> points) {
  const occupancy::InsertReport report = map_.insert(points, T_odom_lidar, stamp);
  if (report.status == occupancy::InsertStatus::ok) vehicle_ = T_odom_lidar.translation();
  return report;
}

TrajectoryStatus CollisionChecker::set_trajectory(Trajectory trajectory) {
  if (!well_formed(trajectory)) return TrajectoryStatus::malformed;
  if (trajectory.id < trajectory_.id) return TrajectoryStatus::outdated;
  trajectory_ = std::move(trajectory);
  return TrajectoryStatus::ok;
}

Verdict CollisionChecker::verdict(Time now) const {
  Verdict verdict;
  verdict.stamp = now;
  verdict.clear_until = now;
  verdict.trajectory_id = trajectory_.id;
  if (trajectory_.empty()) return verdict;
  if (!vehicle_.allFinite() || now - map_.stamp() > from_seconds(config_.stale_after_s)) {
    verdict.reason = VerdictReason::stale_scan;
    return verdict;
  }
  return check(trajectory_, now, block_around(trajectory_, now), {kTakeoff, vehicle_}, clearance_,
               config_.verdict);
}

/// What the verdict looks at: around the vehicle too, whose distance it wants.
occupancy::OccupancyGrid CollisionChecker::block_around(const Trajectory& trajectory,
                                                        Time now) const {
  const Eigen::Vector3d reach =
      Eigen::Vector3d::Constant(std::max(config_.verdict.clearance_reach_m, clearance_.least_m()) +
                                map_.config().resolution_m);
  const Eigen::Vector3d most = Eigen::Vector3d::Constant(config_.farthest_m);
  Eigen::AlignedBox3d box = remaining_box(trajectory, now);
  box.clamp(Eigen::AlignedBox3d(vehicle_ - most, vehicle_ + most));
  box.extend(vehicle_);
  return map_.block(box.min() - reach, box.max() + reach);
}

occupancy::OccupancyGrid CollisionChecker::grid() const {
  if (!vehicle_.allFinite()) return {};
  const Eigen::Vector3d half(config_.block_half_extent_m, config_.block_half_extent_m,
                             config_.block_half_height_m);
  return map_.block(vehicle_ - half, vehicle_ + half);
}

}  // namespace saker::motion
