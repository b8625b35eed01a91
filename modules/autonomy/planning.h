#pragma once

#include <memory>
#include <optional>
#include <string>

#include "saker/active/active.h"
#include "saker/autonomy/guidance.h"
#include "saker/autonomy/pipeline.h"
#include "saker/autonomy/planning_report.h"
#include "saker/motion/motion.h"

/// The step of planning, 1 Hz — reads the map, the occupancy block and what is being flown, makes a
/// proposal to guidance and a report for the mission.
///
/// Active mapping chooses a viewpoint in `world`; it is moved by T_world_odom to `odom`, where the
/// motion planner finds the way from the committed trajectory at now + horizon. Nothing is proposed
/// while what is committed leads there. After `most_refusals` in a row the viewpoint is given back
/// to it, which offers another one or ends; on the way home it is given up. Every refusal
/// brings one of the two nearer: there is no livelock. Beside that it looks up before the take-off
/// and down before the landing, and leads to a place that is fit to land on.
namespace saker::autonomy {

struct PlanningConfig {
  double rate_hz = 1;
  double horizon_s = 0.7;
  double budget_s = 0.4;
  int iterations = 4000;
  int most_refusals = 3;
  double goal_tolerance_m = 0.3;
  double yaw_tolerance_deg = 8;
  double home_tolerance_m = 2.0;
  LandingConfig landing;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("rate_hz", rate_hz, {0.1, 10}, "Hz", "decisions");
    v.field("horizon_s", horizon_s, {0.05, 5}, "s",
            "from a decision to where its trajectory begins: longer than it takes");
    v.field("budget_s", budget_s, {0.02, 5}, "s", "real time: for the search");
    v.field("iterations", iterations, {10, 1000000}, "", "of the search, in lockstep the only end");
    v.field("most_refusals", most_refusals, {1, 100}, "", "in a row, then another goal");
    v.field("goal_tolerance_m", goal_tolerance_m, {0.02, 5}, "m",
            "what is committed ends at the goal: SLAM moves it by centimetres");
    v.field("yaw_tolerance_deg", yaw_tolerance_deg, {0.5, 180}, "°", "the same for heading");
    v.field("home_tolerance_m", home_tolerance_m, {0.1, 20}, "m", "near enough to land");
    v.group("landing", landing, "where it comes down");
  }
};

struct PlanningInput {
  Time now = 0;
  PlanningOrder order = PlanningOrder::none;
  VehicleOdometry odometry;
  std::shared_ptr<const MapSnapshot> map;
  std::shared_ptr<const occupancy::OccupancyGrid> grid;
  std::shared_ptr<const motion::Trajectory> committed;
  std::optional<motion::Verdict> verdict;
};

class Planning {
 public:
  /// Throws Error on an invalid configuration or prior map, without a model where the policy needs
  /// one, and on a lidar that does not see where the vehicle flies.
  Planning(const PlanningConfig& config, const active::ActiveConfig& active,
           const motion::MotionConfig& motion, const objects::ClassTable& table,
           const objects::ObjectMap& prior, double home_height_m,
           std::shared_ptr<const uncertainty::Model> model = nullptr);

  struct Output {
    PlanningReport report;
    std::optional<Proposal> proposal;
    active::ActivePlan plan;  ///< empty on the way home
  };
  [[nodiscard]] Output step(const PlanningInput& input, const core::Budget& budget);

  [[nodiscard]] const active::Active& active() const { return active_; }
  [[nodiscard]] const motion::Geofence& geofence() const { return planner_.geofence(); }

 private:
  /// Where to, in `odom`.
  struct Goal {
    Eigen::Vector3d position = Eigen::Vector3d::Constant(NAN);
    std::optional<double> yaw;
  };
  enum class Way { there, proposed, as_near_as_it_gets, turning, refused };

  void tour(const PlanningInput& input, const core::Budget& budget, Output& output);
  void home(const PlanningInput& input, const core::Budget& budget, Output& output);
  void land(const PlanningInput& input, const core::Budget& budget, Output& output);
  void look(const PlanningInput& input, PlanningReport& report) const;
  [[nodiscard]] LandingPlaces places(const PlanningInput& input) const;
  [[nodiscard]] Way way_to(const Goal& goal, const PlanningInput& input, const core::Budget& budget,
                           Output& output);
  [[nodiscard]] std::optional<Way> turn_to(const Goal& goal, const PlanningInput& input,
                                           motion::PlanRequest request, const core::Budget& budget,
                                           Output& output);
  [[nodiscard]] Time start_time(const PlanningInput& input) const;
  [[nodiscard]] bool leads_to(const motion::Trajectory& trajectory, const Goal& goal) const;
  void refused(PlanningReport& report, std::string text);
  void count_targets(const active::ActivePlan& plan, PlanningReport& report) const;

  PlanningConfig config_;
  active::FieldOfViewConfig view_;
  motion::MotionPlanner planner_;
  active::Active active_;
  Eigen::Vector3d home_;  // world
  PlanningOrder last_order_ = PlanningOrder::none;
  int goal_id_ = -1;  // the viewpoint of the last step
  int refusals_ = 0;
  std::uint64_t searches_ = 0;
};

}  // namespace saker::autonomy
