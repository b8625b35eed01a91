#include "saker/motion/verdict.h"

#include <algorithm>
#include <array>
#include <limits>

#include "saker/occupancy/distance_field.h"

namespace saker::motion {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using occupancy::Cell;
using occupancy::OccupancyGrid;

/// Corners of the Bézier curve that a segment of the trajectory is: it lies within their hull.
std::array<Vector3d, 4> corners(const Trajectory& trajectory, std::size_t segment) {
  const MotionState& a = trajectory.states[segment];
  const MotionState& b = trajectory.states[segment + 1];
  const double third = trajectory.step_s / 3;
  return {a.position, a.position + third * a.velocity, b.position - third * b.velocity, b.position};
}

/// That which holds `time`; there has to be one.
std::size_t segment_at(const Trajectory& trajectory, Time time) {
  const double steps = std::max(0.0, to_seconds(time - trajectory.start) / trajectory.step_s);
  return std::min(static_cast<std::size_t>(steps), trajectory.states.size() - 2);
}

/// A later time by which the body has moved `step_m` at most: a Bézier curve is nowhere faster than
/// three times its longest leg.
Time next_look(const Trajectory& trajectory, Time time, double step_m) {
  const std::size_t segment = segment_at(trajectory, time);
  const auto c = corners(trajectory, segment);
  const double longest =
      std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[3] - c[2]).norm()});
  const double looks = std::ceil(std::max(1.0, 3 * longest / step_m));
  const Time boundary =
      trajectory.start + from_seconds(trajectory.step_s * static_cast<double>(segment + 1));
  const Time next = time + std::max(Time{1}, from_seconds(trajectory.step_s / looks));
  return next < boundary || boundary <= time ? next : boundary;
}

/// A cell that is in the way.
struct Near {
  double distance_m = std::numeric_limits<double>::infinity();  ///< to its surface
  Vector3d centre = Vector3d::Constant(NAN);

  void take(double distance, const Vector3d& at) {
    if (distance >= distance_m) return;
    distance_m = distance;
    centre = at;
  }
};

/// The nearest ones of both kinds among those that are too near.
struct Proximity {
  Near occupied, unknown;
  double clearance_m = std::numeric_limits<double>::infinity();  ///< to what is occupied

  [[nodiscard]] bool clear() const {
    return std::isinf(occupied.distance_m) && std::isinf(unknown.distance_m);
  }
};

class Checker {
 public:
  Checker(const OccupancyGrid& grid, const Exemption& exemption, const ClearanceConfig& clearance,
          const VerdictConfig& config, const Vector3d& begin)
      : grid_(grid),
        exemption_(exemption),
        clearance_(clearance),
        config_(config),
        field_(grid, config.clearance_reach_m, occupancy::UnknownCells::free),
        begin_(in_ball(begin) ? begin : exemption.vehicle),
        leaves_(exemption.vehicle.allFinite() &&
                !(around(exemption.vehicle, false).clear() && around(begin_, false).clear())) {}

  void check(const Trajectory& trajectory, Verdict& verdict) const {
    const Time end = trajectory.end();
    Time time = std::max(verdict.stamp, trajectory.start);
    for (int looks = 0; looks < config_.max_samples; ++looks) {
      if (!look(trajectory.sample(time).position, verdict)) return;
      verdict.clear_until = time;
      if (time >= end) {
        verdict.clear = true;
        verdict.reason = VerdictReason::none;
        return;
      }
      time = std::min(end, next_look(trajectory, time, config_.step_m));
    }
    verdict.reason = VerdictReason::unknown;
  }

 private:
  /// Whether the body may be at `p`; notes the clearance there, or what is in the way.
  bool look(const Vector3d& p, Verdict& verdict) const {
    if (!p.allFinite()) {
      verdict.reason = VerdictReason::unknown;
      return false;
    }
    const Proximity near = around(p, leaves_ && in_ball(p));
    const double clearance = std::min({near.clearance_m, config_.clearance_reach_m,
                                       std::max(field_.at(p), clearance_.least_m())});
    verdict.clearance_m = std::fmin(verdict.clearance_m, clearance);
    if (near.clear()) return true;
    const bool occupied = near.occupied.distance_m <= near.unknown.distance_m;
    verdict.reason = occupied ? VerdictReason::occupied : VerdictReason::unknown;
    verdict.first_hit = occupied ? near.occupied.centre : near.unknown.centre;
    return false;
  }

  [[nodiscard]] bool in_ball(const Vector3d& p) const {
    return (p - exemption_.vehicle).norm() <= clearance_.vehicle_ball_m;
  }

  /// m, that the body keeps from a cell on its way out.
  [[nodiscard]] double needed_leaving_m(const Vector3i& index) const {
    const double from_vehicle_m = grid_.distance_m(index, exemption_.vehicle);
    return clearance_.leaving_m(std::min(from_vehicle_m, grid_.distance_m(index, begin_)));
  }

  /// What is too near to `p`: within radius and margin, or what is kept on the way out.
  [[nodiscard]] Proximity around(const Vector3d& p, bool leaving) const {
    Proximity near;
    const double reach = clearance_.least_m();
    const Vector3i low = grid_.index_of((p.array() - reach).matrix());
    const Vector3i high = grid_.index_of((p.array() + reach).matrix());
    for (int z = low.z(); z <= high.z(); ++z)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int x = low.x(); x <= high.x(); ++x) take({x, y, z}, p, leaving, near);
    return near;
  }

  void take(const Vector3i& index, const Vector3d& p, bool leaving, Proximity& near) const {
    const Cell cell = grid_.contains(index) ? grid_.cells[grid_.offset(index)] : Cell::unknown;
    if (cell == Cell::free) return;
    const Vector3d centre = grid_.centre_of(index);
    if (cell == Cell::unknown && exemption_.contains(centre, clearance_)) return;
    const double distance = grid_.distance_m(index, p);
    if (distance >= clearance_.least_m()) return;
    if (cell == Cell::occupied) near.clearance_m = std::min(near.clearance_m, distance);
    if (leaving && distance >= needed_leaving_m(index)) return;
    (cell == Cell::occupied ? near.occupied : near.unknown).take(distance, centre);
  }

  const OccupancyGrid& grid_;
  const Exemption& exemption_;
  const ClearanceConfig& clearance_;
  const VerdictConfig& config_;
  occupancy::DistanceField field_;
  Vector3d begin_;  // of what is left of the trajectory; the vehicle, if it is nowhere near
  bool leaves_;     // something is nearer than it should be already
};

}  // namespace

Eigen::AlignedBox3d remaining_box(const Trajectory& trajectory, Time now) {
  Eigen::AlignedBox3d box(trajectory.states.back().position);
  if (trajectory.states.size() < 2 || now >= trajectory.end()) return box;
  for (std::size_t i = segment_at(trajectory, now); i + 1 < trajectory.states.size(); ++i)
    for (const Vector3d& corner : corners(trajectory, i)) box.extend(corner);
  return box;
}

Verdict check(const Trajectory& trajectory, Time now, const OccupancyGrid& grid,
              const Exemption& exemption, const ClearanceConfig& clearance,
              const VerdictConfig& config) {
  Verdict verdict;
  verdict.stamp = now;
  verdict.trajectory_id = trajectory.id;
  verdict.clear_until = now;
  if (trajectory.empty()) return verdict;
  const Vector3d begin = trajectory.sample(std::max(now, trajectory.start)).position;
  Checker(grid, exemption, clearance, config, begin).check(trajectory, verdict);
  return verdict;
}

}  // namespace saker::motion
