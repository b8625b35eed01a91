#include "saker/autonomy/planning.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "saker/core/error.h"

namespace saker::autonomy {
namespace {

const Eigen::Vector3d kTakeoffFoot(0, 0, 0);  // `odom` begins there

double turn_between(double a, double b) {
  return std::abs(std::remainder(a - b, 2 * std::numbers::pi));
}

/// Where what is committed ends is where it is going, and nothing is in its way.
bool clear(const PlanningInput& input) {
  return input.verdict && input.verdict->trajectory_id == input.committed->id ? input.verdict->clear
                                                                              : true;
}

std::string tour_text(const PlanningReport& report, const active::ActivePlan& plan) {
  std::string text = fmt::format("{} of {} targets visited, {} unreachable", report.visited,
                                 report.targets, report.unreachable);
  if (std::isnan(plan.seen_share)) return text;
  return text + fmt::format("; {:.0f} % of the geofence seen", 100 * plan.seen_share);
}

}  // namespace

Planning::Planning(const PlanningConfig& config, const active::ActiveConfig& active,
                   const motion::MotionConfig& motion, const objects::ClassTable& table,
                   const objects::ObjectMap& prior, double home_height_m,
                   std::shared_ptr<const uncertainty::Model> model)
    : config_(core::checked(config, "planning")),
      view_(active.view),
      planner_(motion),
      active_(active, table, prior, planner_.geofence(), std::move(model), motion.limits),
      home_(0, 0, home_height_m) {
  if (active::sees_ahead(view_)) return;
  throw Error(
      "mount.rotation_deg: the lidar does not see where the vehicle flies, which is nose first: "
      "expected level beams ahead; tilt it to a side (roll)");
}

Planning::Output Planning::step(const PlanningInput& input, const core::Budget& budget) {
  Output output;
  output.report.stamp = input.now;
  output.report.order = input.order;
  if (input.order != last_order_) {
    refusals_ = 0;
    goal_id_ = -1;
  }
  last_order_ = input.order;
  if (input.grid && input.order != PlanningOrder::tour) look(input, output.report);
  if (input.order == PlanningOrder::none || input.committed == nullptr) return output;
  if (input.order == PlanningOrder::tour) {
    tour(input, budget, output);
  } else if (input.order == PlanningOrder::home) {
    home(input, budget, output);
  } else {
    land(input, budget, output);
  }
  output.report.refusals = refusals_;
  return output;
}

void Planning::count_targets(const active::ActivePlan& plan, PlanningReport& report) const {
  report.targets = static_cast<int>(active_.targets().size());
  report.visited = plan.done + plan.visited;
  report.unreachable = plan.unreachable;
  if (plan.goal) report.target = plan.goal->target_id;
}

void Planning::tour(const PlanningInput& input, const core::Budget& budget, Output& output) {
  active::ActiveInput seen;
  seen.stamp = input.now;
  if (input.map) {
    seen.T_world_odom = input.map->T_world_odom;
    seen.map_stamp = input.map->stamp;
    seen.map = std::shared_ptr<const objects::ObjectMap>(input.map, &input.map->map);
  }
  seen.T_world_body = seen.T_world_odom * input.odometry.T_odom_body;
  const motion::MotionState start = input.committed->sample(start_time(input));
  seen.start = {start_time(input),
                seen.T_world_odom * active::level_pose(start.position, start.yaw)};
  seen.grid = input.grid;
  output.plan = active_.plan(seen, budget);
  const active::ActivePlan& plan = output.plan;
  PlanningReport& report = output.report;
  count_targets(plan, report);
  if (plan.status == active::ActiveStatus::finished) {
    const bool in_vain = report.targets > 0 && report.visited == 0;
    report.status = in_vain ? PlanningStatus::nothing_reachable : PlanningStatus::tour_complete;
    report.text = tour_text(report, plan);
    return;
  }
  if (plan.status == active::ActiveStatus::invalid || !plan.goal) {
    return refused(report, "no viewpoint: the pose is not usable");
  }
  if (plan.goal->id != goal_id_) refusals_ = 0;
  goal_id_ = plan.goal->id;

  const SE3 T_odom_world = seen.T_world_odom.inverse();
  const Goal goal{T_odom_world * plan.goal->position,
                  plan.goal->yaw + core::yaw(T_odom_world.linear())};
  if (way_to(goal, input, budget, output) != Way::refused) return;
  if (refusals_ < config_.most_refusals) return;
  active_.refuse(plan.goal->id, report.text);
  report.status = PlanningStatus::gave_up;
  report.text = fmt::format("viewpoint {} of target {} given up: {}", plan.goal->id,
                            plan.goal->target_id, report.text);
  refusals_ = 0;
}

void Planning::home(const PlanningInput& input, const core::Budget& budget, Output& output) {
  const SE3 T_odom_world = input.map ? input.map->T_world_odom.inverse() : SE3::Identity();
  const Goal goal{T_odom_world * home_, std::nullopt};
  PlanningReport& report = output.report;
  Way way = way_to(goal, input, budget, output);
  const bool stands = input.now >= input.committed->end();
  const double away = (input.odometry.T_odom_body.translation() - goal.position).norm();
  if (stands && (way == Way::there || way == Way::as_near_as_it_gets)) {
    if (away <= config_.home_tolerance_m) {
      report.status = PlanningStatus::home_reached;
      report.text = fmt::format("{:.1f} m from it", away);
      return;
    }
    refused(report, fmt::format("comes no nearer to home than {:.1f} m", away));
    way = Way::refused;
  }
  if (way == Way::refused && refusals_ >= config_.most_refusals) {
    report.status = PlanningStatus::home_unreachable;
  }
}

LandingPlaces Planning::places(const PlanningInput& input) const {
  return {config_.landing, planner_.config().clearance, *input.grid, kTakeoffFoot};
}

void Planning::look(const PlanningInput& input, PlanningReport& report) const {
  const Eigen::Vector3d body = input.odometry.T_odom_body.translation();
  report.landing = places(input).judge(body);
  if (input.order != PlanningOrder::none) return;
  const motion::Exemption stated{.takeoff = kTakeoffFoot, .vehicle = body};
  report.column = look_up(*input.grid, body, home_.z(), planner_.config().clearance, stated);
}

/// Nothing where it is fit here: the mission lands.
void Planning::land(const PlanningInput& input, const core::Budget& budget, Output& output) {
  PlanningReport& report = output.report;
  report.status = PlanningStatus::flying;
  report.text = report.landing.text();
  if (report.landing.fit()) return;
  const Eigen::Vector3d body = input.odometry.T_odom_body.translation();
  const auto place = input.grid ? places(input).nearest_fit(body) : std::nullopt;
  if (!place) {
    report.status = PlanningStatus::no_place;
    report.text += core::text("; nothing fit within {:g} m", config_.landing.reach_m);
    return;
  }
  const core::Text why = report.text;
  if (way_to({place->above, std::nullopt}, input, budget, output) == Way::refused) return;
  report.text = why + core::text("; moves {:.1f} m", (place->above - body).norm());
}

/// When what is proposed now begins.
Time Planning::start_time(const PlanningInput& input) const {
  return input.now + from_seconds(config_.horizon_s);
}

bool Planning::leads_to(const motion::Trajectory& trajectory, const Goal& goal) const {
  const motion::MotionState& end = trajectory.states.back();
  const double tolerance = config_.yaw_tolerance_deg * std::numbers::pi / 180;
  return (end.position - goal.position).norm() <= config_.goal_tolerance_m &&
         (!goal.yaw || turn_between(end.yaw, *goal.yaw) <= tolerance);
}

Planning::Way Planning::way_to(const Goal& goal, const PlanningInput& input,
                               const core::Budget& budget, Output& output) {
  const motion::Trajectory& committed = *input.committed;
  output.report.status = PlanningStatus::flying;
  if (leads_to(committed, goal) && clear(input)) {
    refusals_ = 0;
    return Way::there;
  }
  motion::PlanRequest request;
  request.start_time = start_time(input);
  request.start = committed.sample(request.start_time);
  request.goal = goal.position;
  request.goal_yaw = goal.yaw;
  request.grid = input.grid;
  request.takeoff = kTakeoffFoot;
  request.seed = ++searches_;
  motion::PlanResult result = planner_.plan(request, budget);
  if (result.status != motion::PlanStatus::ok || result.partial) {
    if (const auto way = turn_to(goal, input, request, budget, output)) return *way;
  }
  if (result.status != motion::PlanStatus::ok) {
    refused(output.report, fmt::format("{}: {}", to_string(result.status), result.reason));
    return Way::refused;
  }
  refusals_ = 0;
  const motion::MotionState& end = result.trajectory.states.back();
  const Goal found{end.position, goal.yaw ? std::optional(end.yaw) : std::nullopt};
  if (leads_to(committed, found) && clear(input)) return Way::as_near_as_it_gets;
  output.proposal = Proposal{std::move(result.trajectory), committed.id};
  return Way::proposed;
}

/// Where what is committed ends, to the way on to the goal: a lidar that does not see all around
/// may not have seen it. \return none where it sees all around, or has turned.
std::optional<Planning::Way> Planning::turn_to(const Goal& goal, const PlanningInput& input,
                                               motion::PlanRequest request,
                                               const core::Budget& budget, Output& output) {
  if (active::sees_all_around(view_)) return std::nullopt;
  const motion::Trajectory& committed = *input.committed;
  const motion::MotionState& end = committed.states.back();
  const Eigen::Vector2d way = (goal.position - end.position).head<2>();
  if (way.norm() <= config_.goal_tolerance_m) return std::nullopt;
  const Goal turned{end.position, std::atan2(way.y(), way.x())};
  if (leads_to(committed, turned)) {
    return input.now < committed.end() ? std::optional(Way::turning) : std::nullopt;
  }
  request.goal = turned.position;
  request.goal_yaw = turned.yaw;
  motion::PlanResult result = planner_.plan(request, budget);
  if (result.status != motion::PlanStatus::ok) return std::nullopt;
  output.proposal = Proposal{std::move(result.trajectory), committed.id};
  return Way::proposed;
}

void Planning::refused(PlanningReport& report, std::string text) {
  ++refusals_;
  report.status = PlanningStatus::refused;
  report.text = std::move(text);
}

}  // namespace saker::autonomy
