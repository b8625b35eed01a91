#include "kinematic_flight.h"

#include <algorithm>
#include <utility>

namespace saker::autonomy {
namespace {

constexpr Time kStep = kNanosecondsPerSecond / 50;
constexpr double kClimb_m = 0.03;  // in a step

objects::ObjectMap prior_of(const std::vector<Eigen::Vector3d>& places) {
  objects::ObjectMap prior;
  for (const Eigen::Vector3d& place : places) {
    objects::MapObject object;
    object.id = static_cast<int>(prior.objects.size());
    object.class_id = objects::ClassTable{}.find("vehicle");
    objects::Cuboid cuboid;
    cuboid.pose.translation() = place;
    cuboid.size = {4.5, 1.9, 1.6};
    object.model = cuboid;
    prior.objects.push_back(object);
  }
  return prior;
}

active::ActiveConfig visits() {
  active::ActiveConfig config;
  config.policy = active::PolicyName::visit;
  return config;
}

}  // namespace

occupancy::OccupancyGrid free_block(double half_m) {
  occupancy::OccupancyGrid grid;
  grid.resolution_m = 0.25;
  grid.origin = {-half_m, -half_m, -1};
  const int cells = static_cast<int>(2 * half_m / grid.resolution_m);
  grid.size = {cells, cells, 36};
  grid.cells.assign(static_cast<std::size_t>(grid.size.prod()), occupancy::Cell::free);
  fill(grid, {-half_m, -half_m, -1}, {half_m, half_m, -0.25}, occupancy::Cell::occupied);
  return grid;
}

void fill(occupancy::OccupancyGrid& grid, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
          occupancy::Cell cell) {
  for (int z = 0; z < grid.size.z(); ++z) {
    for (int y = 0; y < grid.size.y(); ++y) {
      for (int x = 0; x < grid.size.x(); ++x) {
        const Eigen::Vector3d p = grid.centre_of({x, y, z});
        const bool inside = (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
        if (inside) grid.cells[grid.offset({x, y, z})] = cell;
      }
    }
  }
}

KinematicFlight::KinematicFlight(const std::vector<Eigen::Vector3d>& targets,
                                 std::shared_ptr<const occupancy::OccupancyGrid> grid)
    : grid_(std::move(grid)),
      planning_({}, visits(), {}, objects::ClassTable{}, prior_of(targets),
                MissionConfig{}.height_m),
      guidance_(GuidanceConfig{}),
      supervisor_({}, {}, planning_.geofence()) {
  vehicle_.battery_share = 1;
  odometry_.velocity.setZero();
}

double KinematicFlight::run(double limit_s) {
  const Time begin = now_;
  while (!mission().done() && now_ - begin < from_seconds(limit_s)) {
    now_ += kStep;
    step();
  }
  return to_seconds(now_ - begin);
}

bool KinematicFlight::run_to(MissionPhase phase, double limit_s) {
  for (const Time end = now_ + from_seconds(limit_s); now_ < end && mission().phase() != phase;) {
    now_ += kStep;
    step();
  }
  return mission().phase() == phase;
}

void KinematicFlight::step() {
  vehicle_.stamp = odometry_.stamp = now_;
  odometry_.status = VehicleOdometryStatus::ok;
  if (const auto& committed = guidance_.committed()) {
    verdict_ = motion::Verdict{};
    verdict_->stamp = now_;
    verdict_->trajectory_id = committed->id;
    verdict_->clear = true;
    verdict_->clear_until = committed->end();
    judge(*verdict_);
  }
  if (now_ % kNanosecondsPerSecond == 0) plan();
  supervise();
  setpoint_ = guidance_.update(now_, orders_.guidance, verdict_);
  move();
}

void KinematicFlight::plan() {
  PlanningInput input;
  input.now = now_;
  input.order = orders_.planning;
  input.odometry = odometry_;
  input.grid = grid_;
  input.committed = guidance_.committed();
  input.verdict = verdict_;
  const Planning::Output output = planning_.step(input, core::Budget::iterations(2000));
  report_ = output.report;
  if (report_.order != PlanningOrder::none) reports.push_back(report_);
  if (output.proposal) (void)guidance_.commit(*output.proposal, now_);
}

void KinematicFlight::supervise() {
  SupervisorInput input;
  input.now = now_;
  input.heard = {now_, now_, now_, now_, now_, now_, std::max<Time>(report_.stamp, 1), now_};
  input.vehicle = vehicle_;
  input.odometry = odometry_;
  input.setpoint = setpoint_;
  input.acks = std::exchange(acks_, {});
  input.planning = report_;
  input.has_targets = !planning_.active().idle();
  input.classified_share = 1;
  const Mission::Output output = supervisor_.step(std::move(input));
  orders_ = output.orders;
  if (output.anchor) guidance_.anchor(now_, odometry_);
  events.insert(events.end(), output.events.begin(), output.events.end());
  if (!output.command) return;
  acks_.push_back({now_, output.command->id, true, ""});
  const CommandKind kind = output.command->kind;
  if (kind == CommandKind::arm) vehicle_.armed = true;
  climbs_ = kind == CommandKind::takeoff;
  descends_ = kind == CommandKind::land;
}

void KinematicFlight::move() {
  Eigen::Vector3d place = odometry_.T_odom_body.translation();
  if (setpoint_) {
    largest_step_m = std::max(largest_step_m, (setpoint_->position - place).norm());
    setpoints.push_back(*setpoint_);
    odometry_.T_odom_body.linear() =
        Eigen::AngleAxisd(setpoint_->yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    odometry_.T_odom_body.translation() = setpoint_->position;
    climbs_ = false;
  } else if (climbs_) {
    place.z() = std::min(place.z() + kClimb_m, MissionConfig{}.height_m);
    odometry_.T_odom_body.translation() = place;
  } else if (descends_) {
    place.z() = std::max(place.z() - kClimb_m, 0.0);
    odometry_.T_odom_body.translation() = place;
    vehicle_.armed = place.z() > 0;
  }
}

}  // namespace saker::autonomy
