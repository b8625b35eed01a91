#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "saker/active/tour/targets.h"
#include "saker/autonomy/fitted_noise.h"
#include "saker/autonomy/open_beams.h"
#include "saker/autonomy/plant.h"
#include "saker/autonomy/standstill.h"
#include "saker/detection/detection.h"
#include "saker/lidar/ouster_stream.h"
#include "saker/objects/object_map.h"
#include "saker/odometry/odometry.h"
#include "saker/slam/slam.h"

/// The perception stages of one vehicle, as calls: packets → scans → registered scans → labels →
/// object map. Whoever drives them (lockstep or the executive's loops) gives each part one caller
/// at a time and passes on what it gets. Nothing here reads a clock or keeps a thread.
namespace saker::autonomy {

/// A scan with its pose, for segmentation and mapping.
struct IngestedScan {
  std::string name;
  std::shared_ptr<const lidar::Scan> scan;        ///< as sensed, not deskewed
  RegisteredScan registered;                      ///< in the vehicle's `odom`
  Matrix6d covariance = Matrix6d::Constant(NAN);  ///< of the motion since the last scan
  odometry::OdometryStatus status = odometry::OdometryStatus::refused;
  odometry::OdometryReason reason = odometry::OdometryReason::none;
};

/// Packets → scans → poses. The vehicle's `odom` has its origin at the body's place at the first
/// scan after it stood still, x to the body's heading, z up; scans before that are not registered.
class Ingestion {
 public:
  /// Throws Error on an invalid value.
  Ingestion(const odometry::OdometryConfig& config, const StandstillConfig& standstill,
            const lidar::SensorInfo& info, const SE3& T_body_lidar);

  /// A UDP payload, lidar or inertial; any bytes are allowed.
  void add(std::span<const std::uint8_t> payload) { stream_.add(payload); }

  /// The newest whole scan that is to be registered; older ones that wait are dropped and counted.
  [[nodiscard]] std::optional<lidar::Frame> take_newest();

  [[nodiscard]] IngestedScan register_scan(lidar::Frame frame);

  [[nodiscard]] Time newest_stamp() const { return newest_stamp_; }  ///< of a whole scan; 0: none
  [[nodiscard]] lidar::SourceCounters counters() const { return stream_.counters(); }
  [[nodiscard]] int dropped_scans() const { return dropped_; }

 private:
  lidar::OusterStream stream_;
  Standstill standstill_;
  bool stood_ = false;
  OpenBeams open_beams_;
  odometry::Odometry odometry_;
  SE3 T_body_lidar_;
  std::optional<SE3> T_start_odometry_;  // from odometry's own frame to the vehicle's `odom`
  Time newest_stamp_ = 0;
  int dropped_ = 0;
};

/// The covariance of the motion from one cycle of SLAM to the next, summed over the scans between.
class MotionLog {
 public:
  /// Each registered scan, in the order of time; `covariance` is that of the step to it.
  void add(Time stamp, const SE3& T_odom_lidar, const Matrix6d& covariance);

  /// Of the motion since the last call, up to the scan at `until`.
  [[nodiscard]] Matrix6d take(Time until);

 private:
  struct Step {
    Time stamp;
    SE3 T_odom_lidar;
    Matrix6d covariance;
  };
  std::deque<Step> steps_;
  SE3 T_odom_last_ = SE3::Identity();
};

/// The labelled scans that detection looks at.
class LabelledWindow {
 public:
  explicit LabelledWindow(double length_s) : length_(from_seconds(length_s)) {}

  /// In the order of time; older ones than the window's length leave.
  void add(detection::LabelledScan scan);

  [[nodiscard]] std::vector<detection::LabelledScan> scans() const {
    return {scans_.begin(), scans_.end()};
  }

 private:
  Time length_;
  std::deque<detection::LabelledScan> scans_;
};

/// What mapping knows after a cycle; shared, never changed.
struct MapSnapshot {
  Time stamp = 0;
  objects::ObjectMap map;  ///< in `world`; covariances given the poses, without common parts
  SE3 T_world_odom = SE3::Identity();
  objects::Detections detections;  ///< as measured, lidar frame at `stamp`
  slam::SlamUpdate update;
  double classified_share = NAN;  ///< of the newest scan's points: those with a class of the table
};

/// Labelled scans of the last seconds → detections → fitted noise → SLAM.
class Mapping {
 public:
  /// \param model what measurements are worth; may be null where the noise is fixed. Throws Error
  /// on an invalid value.
  Mapping(const detection::DetectionConfig& detection, const slam::SlamConfig& slam,
          const objects::ClassTable& table,
          std::shared_ptr<const uncertainty::Model> model = nullptr);

  /// One cycle at the window's newest scan; nothing when there is none.
  [[nodiscard]] std::shared_ptr<const MapSnapshot> cycle(
      std::span<const detection::LabelledScan> window, const Matrix6d& motion_covariance);

  [[nodiscard]] const slam::Slam& slam() const { return slam_; }

  /// The objects' covariances are the graph's and what all views of one have in common. Incomplete
  /// objects that are targets are in it.
  [[nodiscard]] objects::ObjectMap map_with_covariance(
      std::span<const active::Target> targets) const;

 private:
  int iterations_;
  detection::Detection detection_;
  FittedNoise noise_;
  slam::Slam slam_;
};

}  // namespace saker::autonomy
