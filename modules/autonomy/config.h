#pragma once

#include "saker/active/active.h"
#include "saker/autonomy/body_pose.h"
#include "saker/autonomy/contact_sense.h"
#include "saker/autonomy/fitted_noise.h"
#include "saker/autonomy/guidance.h"
#include "saker/autonomy/local_checker.h"
#include "saker/autonomy/mission.h"
#include "saker/autonomy/planning.h"
#include "saker/autonomy/safety.h"
#include "saker/autonomy/standstill.h"
#include "saker/core/config.h"
#include "saker/detection/detection.h"
#include "saker/lidar/mount.h"
#include "saker/lidar/sensor_info.h"
#include "saker/motion/collision_checker.h"
#include "saker/motion/motion.h"
#include "saker/multirobot/merge_config.h"
#include "saker/objects/class_table.h"
#include "saker/odometry/odometry.h"
#include "saker/segmentation/segmentation.h"
#include "saker/slam/slam.h"

namespace saker::autonomy {

/// How often the stages behind odometry run, by the stamps of the scans.
struct RateConfig {
  double segmentation_hz = 5;
  double slam_hz = 2;
  double flight_segmentation_hz = 2;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("segmentation_hz", segmentation_hz, {0.5, 20}, "Hz",
              "So many scans a second get labels in replay; 5 take half a thread.");
    v.setting("slam_hz", slam_hz, {0.1, 10}, "Hz",
              "So often detection and SLAM run, in flight and in replay.");
    v.setting("flight_segmentation_hz", flight_segmentation_hz, {0.5, 20}, "Hz",
              "So many scans a second get labels in flight, where other stages share two cores.");
  }
};

/// How late results are in lockstep, as on the vehicle's computer.
struct LatencyConfig {
  double odometry_s = 0.05;
  double segmentation_s = 0.12;
  double mapping_s = 0.25;
  double planning_s = 0.3;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("odometry_s", odometry_s, {0, 1}, "s", "registration of a scan");
    v.field("segmentation_s", segmentation_s, {0, 2}, "s", "labels of a scan");
    v.field("mapping_s", mapping_s, {0, 5}, "s", "a cycle of detection and SLAM");
    v.field("planning_s", planning_s, {0, 5}, "s", "a decision; less than planning.horizon_s");
  }
};

/// The whole configuration: the file has this shape.
struct Config {
  objects::ClassTable objects;
  odometry::OdometryConfig odometry;
  segmentation::SegmentationConfig segmentation;
  detection::DetectionConfig detection;
  slam::SlamConfig slam;
  multirobot::MergeConfig multirobot;
  UncertaintyConfig uncertainty;
  RateConfig rates;
  lidar::MountConfig mount;
  StandstillConfig standstill;
  BodyPoseConfig body_pose;
  ContactConfig contact;
  motion::MotionConfig motion;
  motion::CollisionCheckerConfig collision_checker;
  active::ActiveConfig active;
  PlanningConfig planning;
  GuidanceConfig guidance;
  SafetyConfig safety;
  MissionConfig mission;
  LatencyConfig latency;
  LocalCheckerConfig local_checker;

  template <class Visitor>
  void visit(Visitor& v) {
    v.group("objects", objects, "the classes");
    v.group("odometry", odometry, "scan to local map");
    v.group("segmentation", segmentation, "range-image network");
    v.group("detection", detection, "virtual sensors: ground, vehicles, trunks and poles");
    v.group("slam", slam, "object SLAM");
    v.group("multirobot", multirobot, "several robots in one graph");
    v.group("uncertainty", uncertainty, "what measurements are worth");
    v.group("rates", rates, "how often the stages run");
    v.group("mount", mount, "where the lidar is on the body: T_body_lidar");
    v.group("standstill", standstill, "when odometry begins in flight");
    v.group("body_pose", body_pose, "the pose between scans");
    v.group("contact", contact, "what the accelerometer feels");
    v.group("motion", motion, "trajectories");
    v.group("collision_checker", collision_checker, "occupancy and verdicts");
    v.group("active", active, "where to look next");
    v.group("planning", planning, "the step of planning");
    v.group("guidance", guidance, "setpoints");
    v.group("safety", safety, "when to return, hold, land");
    v.group("mission", mission, "phases and their deadlines");
    v.group("latency", latency, "of the stages in lockstep");
    v.group("local_checker", local_checker, "the collision checker in lockstep");
  }
};

/// Where to look next, with the lidar's beams as its metadata has them and as it is mounted, and
/// sizes as the class table has them.
[[nodiscard]] active::ActiveConfig active_as_flown(const Config& config,
                                                   const lidar::SensorInfo& sensor);

/// As `sensor_note` where measurements get fitted noise; else empty.
[[nodiscard]] std::string noise_note(const Config& config, const std::string& sensor);

/// Take-off and viewpoints below the geofence's upper end, as under a ceiling: the take-off swings
/// over its height.
[[nodiscard]] Config within_geofence(Config config);

/// Up in the lidar's frame while the body is level.
[[nodiscard]] inline Eigen::Vector3f up_as_mounted(const Config& config) {
  return lidar::mount_pose(config.mount).linear().row(2).transpose().cast<float>();
}

/// The fitted model, null where nothing in the configuration needs one; about the truth where its
/// biases are not taken off. Throws Error on a file that is missing or not valid.
[[nodiscard]] inline std::shared_ptr<const uncertainty::Model> uncertainty_for(
    const Config& config) {
  const bool for_slam = config.slam.measurement_noise == slam::NoiseSource::fitted;
  const bool for_views = config.active.policy != active::PolicyName::visit;
  if (!for_slam && !for_views) return nullptr;
  auto model = load_uncertainty(config.uncertainty, config.objects);
  if (for_slam) return model;
  return std::make_shared<const uncertainty::Model>(model->about_truth());
}

}  // namespace saker::autonomy
