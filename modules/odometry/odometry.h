#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "saker/core/config.h"
#include "saker/core/se3.h"
#include "saker/lidar/scan.h"
#include "saker/odometry/adaptive_gate.h"
#include "saker/odometry/column_search.h"
#include "saker/odometry/imu_buffer.h"
#include "saker/odometry/motion_model.h"
#include "saker/odometry/pose_search.h"
#include "saker/odometry/registration.h"
#include "saker/odometry/sweep.h"
#include "saker/odometry/voxel_filter.h"
#include "saker/odometry/voxel_map.h"

namespace saker::odometry {

struct OdometryConfig {
  double min_range_m = 1.5;
  double max_range_m = 80;
  double map_sample_m = 0.2;
  double registration_sample_m = 0.3;
  int coarse_points = 2000;
  int deskew_rounds = 2;
  int first_rounds = 5;
  double prune_every_s = 1;
  int restart_after = 5;
  double drift_share = 0.25;
  double most_drift_m = 0.1;
  double least_usual_share = 0.5;
  double least_unexpected_share = 0.8;
  double least_found_share = 0.6;
  double expected_sd = 3;
  double established_s = 1;
  double share_memory = 0.9;
  VoxelMapConfig map;
  RegistrationConfig registration;
  PoseSearchConfig search;
  ColumnSearchConfig column_search;
  AdaptiveGateConfig gate;
  MotionConfig motion;

  template <class Visitor>
  void visit(Visitor& v) {
    v.setting("min_range_m", min_range_m, {0, 20}, "m",
              "Points nearer than this are taken for the vehicle's own and left out.");
    v.setting("max_range_m", max_range_m, {5, 500}, "m",
              "Points farther than this are left out: they are too sparse to make planes.");
    v.field("map_sample_m", map_sample_m, {0.02, 5}, "m",
            "one point a voxel of this size goes into the map");
    v.field("registration_sample_m", registration_sample_m, {0.05, 10}, "m",
            "one point a voxel of this size is registered: over bare ground 0.6 m drifts three "
            "times as much");
    v.field("coarse_points", coarse_points, {100, 1e6}, "",
            "about so many of them in the rounds before the last, which only find the motion to "
            "deskew with");
    v.field("deskew_rounds", deskew_rounds, {1, 5}, "",
            "registrations of a scan with point times, each deskewed by the last one's motion");
    v.field("first_rounds", first_rounds, {1, 20}, "",
            "the same of the second scan, with which the first one in the map is deskewed too");
    v.field("prune_every_s", prune_every_s, {0, 60}, "s",
            "how often far and old voxels are dropped");
    v.field("restart_after", restart_after, {1, 1000}, "",
            "scans in a row that do not fit one place of the map, until a new one begins at the "
            "prediction, once that leaves more open than is searched around it");
    v.field(
        "drift_share", drift_share, {0, 2}, "",
        "of a registration's variance that stays as drift: a scan's noise goes with the next "
        "scan, but for its share in the map; on flights the error of 1 s is that of 0.1 to 0.4, of "
        "10 s that of 0.03 to 0.2, most over bare ground");
    v.field("most_drift_m", most_drift_m, {0.001, 10}, "m",
            "stated drift over the last second, sd in its worst direction; more, and nothing holds "
            "the pose there: three of them are what a flight keeps clear of obstacles");
    v.field("least_usual_share", least_usual_share, {0, 1}, "",
            "of the share of points that usually lies on planes of the map; less, and the scan is "
            "not registered: from a wrong place some fit, too");
    v.field(
        "least_unexpected_share", least_unexpected_share, {0, 1}, "",
        "the same where the pose is not one that the prediction pointed to; as much of what lies "
        "on established planes must lie on them, too: what passes by is a scene that moves");
    v.field("least_found_share", least_found_share, {0, 1}, "",
            "the same where the scan before was found there, too: in made streets 0.7 to 0.9 in "
            "the right place, and 0.6 in one that the map lacks");
    v.field("expected_sd", expected_sd, {1, 100}, "",
            "from the prediction, a dimension: farther, and the pose is not expected");
    v.field("established_s", established_s, {0, 60}, "s",
            "a plane seen first so long ago is established: what passes by is out of its voxel");
    v.field("share_memory", share_memory, {0, 0.999}, "",
            "of the old usual share that a scan keeps");
    v.group("map", map, "the local map");
    v.group("registration", registration, "scan to map");
    v.group("search", search, "where registration starts when the prediction is not sure enough");
    v.group("column_search", column_search,
            "the same where it leaves more open than that search covers");
    v.group("gate", gate, "how far a point may be from the map");
    v.group("motion", motion, "prediction");
  }
};

enum class OdometryStatus {
  ok,         ///< registered; the first scan defines `odom`
  open,       ///< registered, but nothing holds the pose in a direction; `covariance` says how much
  predicted,  ///< the pose is the prediction; `reason` says why
  refused     ///< nothing changed; the pose is the last one
};

/// Whether the pose is the map's, to be mapped and flown with.
[[nodiscard]] inline bool registered(OdometryStatus status) {
  return status == OdometryStatus::ok || status == OdometryStatus::open;
}

enum class OdometryReason { none, not_newer, too_few_points, no_fit, ambiguous, not_held };

[[nodiscard]] const char* to_string(OdometryStatus status);
[[nodiscard]] const char* to_string(OdometryReason reason);

struct OdometryDiagnostics {
  int points = 0;  ///< registered, after thinning
  int iterations = 0;
  int inliers = 0;
  double rms_m = 0;   ///< of the inliers' distances to their planes
  double gate_m = 0;  ///< at which they were sought
  int map_voxels = 0;
  bool imu_used = false;
};

struct OdometryEstimate {
  Time stamp = 0;
  SE3 T_odom_lidar = SE3::Identity();
  /// What the motion since the last scan adds to the drift, so that sums over many scans hold; 0
  /// for the first scan and a refused one.
  Matrix6d covariance = Matrix6d::Constant(NAN);
  OdometryStatus status = OdometryStatus::refused;
  OdometryReason reason = OdometryReason::none;
  /// Deskewed, in the lidar frame at `stamp`, one a point of the scan; what is not finite stays so.
  std::vector<Eigen::Vector3f> points;
  OdometryDiagnostics diagnostics;
};

/// Stage 1: reads scans with the IMU samples since the one before (lidar), makes each scan's pose
/// in `odom`, the covariance of the motion and the deskewed points (for segmentation, detection,
/// slam, the collision checker).
///
/// Frames: `odom` is the first scan's lidar frame at its stamp, turned level by the mean specific
/// force where there is an IMU (yaw 0). Covariances: tangent [rotation, translation], right.
/// Method: predict (by the IMU, else a constant twist), deskew by that motion, point-to-plane ICP
/// to a voxel map of Gaussians with robust weights and the prediction as prior, deskew and register
/// once more with the motion found, add the scan to the map. A prediction that is not sure enough
/// for one start, or a step of the clock, gives several; the one that most points fit is taken
/// (pose_search.h). Sources: gate and two thinnings, Vizzo
/// et al., "KISS-ICP" (RA-L 2023), sec. III; planes of voxels, Yuan et al., "VoxelMap" (RA-L 2022),
/// sec. III; deskewing by the motion between two scans, Dellenbach et al., "CT-ICP" (ICRA 2022).
/// Cost: its README. One thread; after the first scans searches and the estimate's points are
/// allocated, nothing else.
class Odometry {
 public:
  explicit Odometry(const OdometryConfig& config);  ///< throws Error on an invalid value

  /// Time order is required: a scan that is not newer than the last one is refused and changes
  /// nothing.
  [[nodiscard]] OdometryEstimate register_scan(const lidar::Scan& scan,
                                               std::span<const lidar::ImuSample> imu);

 private:
  /// Where registration starts.
  struct Start {
    SE3 T_odom_lidar;
    bool searched = false;   ///< not where the prediction pointed to
    bool ambiguous = false;  ///< another place explains the scan as well
    std::optional<RegistrationResult> found = std::nullopt;  ///< somewhere in the whole map
  };

  /// What else than the scan says that it was taken there: with nothing as much has to fit as
  /// usual.
  enum class Trust {
    none,
    prediction,  ///< where it points to one place
    found        ///< the scan before was found there, too
  };

  /// Of a scan's points.
  struct Share {
    double on_planes = 0, on_established = 0;
  };

  struct Fit {
    RegistrationResult registration;
    Sweep sweep;
    double gate_m = 0;
    Share share;  ///< of the points
    OdometryReason reason = OdometryReason::none;
    std::optional<RegistrationResult> found = std::nullopt;  ///< Start's, where it does not fit
  };

  /// From the place that the last scan was found at, if this scan fits there.
  [[nodiscard]] std::optional<std::pair<Prediction, Fit>> from_found(const lidar::Scan& scan);
  [[nodiscard]] std::pair<Prediction, Fit> most_likely(const lidar::Scan& scan);
  [[nodiscard]] static bool more_likely(const Fit& a, const Prediction& of_a, const Fit& b,
                                        const Prediction& of_b);
  [[nodiscard]] OdometryEstimate start(const lidar::Scan& scan);
  [[nodiscard]] OdometryEstimate refused(const lidar::Scan& scan) const;
  [[nodiscard]] Fit fit(const lidar::Scan& scan, const Prediction& prediction,
                        Trust trust = Trust::prediction);
  /// The prediction or, where it leaves too much open, what most points fit.
  /// Scans without a registered one have left more open than the near search covers.
  [[nodiscard]] bool lost(const Prediction& prediction) const;
  /// In the whole map, where scans without a registered one have left more open than the near
  /// search covers.
  [[nodiscard]] std::vector<SE3> far_starts(const lidar::Scan& scan, const Prediction& prediction,
                                            const Sweep& sweep);
  [[nodiscard]] Start start_of(const lidar::Scan& scan, const Prediction& prediction,
                               double gate_m);
  [[nodiscard]] static Share share_of(const RegistrationResult& result, std::size_t points);
  [[nodiscard]] OdometryReason judge(const RegistrationResult& result, std::size_t points,
                                     double least_share, bool expected) const;
  [[nodiscard]] OdometryEstimate report(const lidar::Scan& scan, const Prediction& prediction,
                                        const Fit& fit);

  /// Adds a registered scan's drift; whether that over the last second is small in all directions.
  /// Of what is not registered nothing counts but where a new map begins: the old one does not move
  /// with it.
  [[nodiscard]] bool held(const OdometryEstimate& estimate);

  void thin(const lidar::Scan& scan);
  void keep_first(const lidar::Scan& scan);
  /// Deskews the first scan and this one by the motion between them, in turns.
  void refine_first(const lidar::Scan& scan);
  void redo_first(const Prediction& prediction, const SE3& T_odom_lidar);
  /// Whether the scan begins a new map.
  [[nodiscard]] bool remember(const Prediction& prediction, const Fit& fit);
  void add_to_map(const lidar::Scan& scan, const Sweep& sweep);
  /// The scan's chosen points, deskewed, in scratch_.
  void deskew(const lidar::Scan& scan, const Sweep& sweep, std::span<const std::uint32_t> chosen);

  /// What the motion to a registered scan added.
  struct Drift {
    Time stamp = 0;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the place, in `odom`
  };

  /// The first scan's sample: nothing was known of the motion in it before the second one was
  /// registered.
  struct FirstScan {
    Time span = 0;
    SE3 T_odom_stamp = SE3::Identity();
    std::vector<Eigen::Vector3f> points;
    std::vector<std::int32_t> offset_ns;
  };

  OdometryConfig config_;
  VoxelMap map_;
  Registration registration_;
  PoseSearch search_;
  ColumnSearch column_search_;
  AdaptiveGate gate_;
  MotionModel motion_;
  /// Taken to be where the last scan was found in the whole map, which one scan does not prove: how
  /// it moved in the scan is not known. The next one does.
  std::optional<MotionModel> found_;
  VoxelFilter filter_;
  ImuBuffer imu_;

  bool started_ = false;
  Time stamp_ = 0;
  SE3 T_odom_stamp_ = SE3::Identity();  // the last estimate
  Time pruned_stamp_ = 0;
  int misfits_ = 0;            // scans in a row
  std::vector<Drift> drifts_;  // of the last second
  Share usual_;                // 0: not known yet
  FirstScan first_;            // emptied when it was put in again
  std::vector<std::uint32_t> map_sample_, registration_sample_, coarse_sample_;
  std::vector<Eigen::Vector3d> scratch_;
};

}  // namespace saker::odometry
