#include "saker/odometry/odometry.h"

namespace saker::odometry {
namespace {

constexpr std::size_t kMostSampledPoints =
    262144;  // two returns of a sensor of 128 rows and 1024 columns

constexpr Time kImuMemory = 3 * kNanosecondsPerSecond;

/// The moment whose pose is registered: the middle of the scan (see Sweep).
Time moment_of(const lidar::Scan& scan) {
  const Time span = Sweep::span_of(scan);
  return scan.stamp - (span - span / 2);
}

std::int32_t offset_of(const lidar::Scan& scan, std::size_t i) {
  return i < scan.offset_ns.size() ? scan.offset_ns[i] : 0;
}

/// What stays of a pose's error when the next scan is registered. The posterior P = P I P splits
/// into what the prior and what the map brought in; the prior hangs on the last pose, so what the
/// motion since then added to it adds up from scan to scan; the map's part is fresh noise, of which
/// a share goes into the map.
Matrix6d drift(const Matrix6d& posterior, const Prediction& prediction, double share) {
  const Matrix6d of_prior = prediction.prior.covariance.ldlt().solve(posterior).transpose();
  const Matrix6d of_motion = of_prior * prediction.motion_covariance * of_prior.transpose();
  const Matrix6d sum = share * posterior + (1 - share) * of_motion;
  return 0.5 * (sum + sum.transpose());
}

}  // namespace

const char* to_string(OdometryStatus status) {
  switch (status) {
    case OdometryStatus::ok:
      return "ok";
    case OdometryStatus::predicted:
      return "predicted";
    case OdometryStatus::refused:
      return "refused";
  }
  return "?";
}

const char* to_string(OdometryReason reason) {
  switch (reason) {
    case OdometryReason::none:
      return "none";
    case OdometryReason::not_newer:
      return "not newer than the last scan";
    case OdometryReason::too_few_points:
      return "too few points";
    case OdometryReason::no_fit:
      return "does not fit the local map";
  }
  return "?";
}

Odometry::Odometry(const OdometryConfig& config)
    : config_(core::checked(config, "odometry")),
      map_(config_.map),
      registration_(config_.registration),
      gate_(config_.gate),
      motion_(config_.motion),
      filter_(kMostSampledPoints) {}

OdometryEstimate Odometry::register_scan(const lidar::Scan& scan,
                                         std::span<const lidar::ImuSample> imu) {
  if (started_ && (scan.stamp <= stamp_ || moment_of(scan) <= motion_.moment()))
    return refused(scan);
  imu_.add(imu, scan.stamp - kImuMemory);
  thin(scan);
  if (!started_) return start(scan);
  if (!first_.points.empty()) refine_first(scan);

  const Prediction prediction = motion_.predict(moment_of(scan), imu_.samples());
  const Fit found = fit(scan, prediction);
  OdometryEstimate estimate = report(scan, prediction, found);
  remember(prediction, found);
  stamp_ = estimate.stamp;
  T_odom_stamp_ = estimate.T_odom_lidar;
  if (estimate.status == OdometryStatus::ok || misfits_ >= config_.restart_after)
    add_to_map(scan, found.sweep);
  return estimate;
}

OdometryEstimate Odometry::start(const lidar::Scan& scan) {
  stamp_ = pruned_stamp_ = scan.stamp;
  T_odom_stamp_.linear() = level(imu_.samples());
  motion_.start(moment_of(scan), T_odom_stamp_);
  const Time span = Sweep::span_of(scan);
  // The lidar is taken to stand where it is; a gyroscope knows how it turned.
  const Sweep sweep = motion_.sweep_before(T_odom_stamp_, 1, span, imu_.samples());
  motion_.start(moment_of(scan), T_odom_stamp_ * sweep.T_reference_stamp().inverse());
  started_ = true;
  keep_first(scan);
  add_to_map(scan, sweep);

  OdometryEstimate estimate = refused(scan);
  estimate.status = OdometryStatus::ok;
  estimate.reason = OdometryReason::none;
  estimate.points = sweep.referred_to_stamp().deskewed(scan);
  estimate.diagnostics.points = static_cast<int>(registration_sample_.size());
  estimate.diagnostics.map_voxels = static_cast<int>(map_.size());
  return estimate;
}

OdometryEstimate Odometry::refused(const lidar::Scan& scan) const {
  OdometryEstimate estimate;
  estimate.stamp = scan.stamp;
  estimate.T_odom_lidar = T_odom_stamp_;
  estimate.covariance.setZero();
  estimate.reason = OdometryReason::not_newer;
  estimate.points = scan.points;
  return estimate;
}

void Odometry::thin(const lidar::Scan& scan) {
  filter_.thin(scan.points, config_.map_sample_m, config_.min_range_m, config_.max_range_m,
               map_sample_);
  filter_.thin(scan.points, map_sample_, config_.registration_sample_m, registration_sample_);
  const auto coarse_points = static_cast<std::size_t>(config_.coarse_points);
  const std::size_t stride = std::max<std::size_t>(1, registration_sample_.size() / coarse_points);
  coarse_sample_.clear();
  for (std::size_t i = 0; i < registration_sample_.size(); i += stride)
    coarse_sample_.push_back(registration_sample_[i]);
}

void Odometry::deskew(const lidar::Scan& scan, const Sweep& sweep,
                      std::span<const std::uint32_t> chosen) {
  scratch_.clear();
  for (const std::uint32_t i : chosen)
    scratch_.push_back(sweep.deskewed(scan.points[i], offset_of(scan, i)).cast<double>());
}

Odometry::Fit Odometry::fit(const lidar::Scan& scan, const Prediction& prediction) {
  const Time span = Sweep::span_of(scan);
  const SE3& predicted = prediction.prior.T_odom_lidar;
  Fit fit;
  fit.gate_m = gate_.gate_m(prediction.seconds / motion_.usual_interval_s());
  fit.registration.T_odom_lidar = predicted;
  const int rounds = span == 0 ? 1 : config_.deskew_rounds;
  for (int round = 0; round < rounds && fit.reason == OdometryReason::none; ++round) {
    const SE3 T_odom_lidar = fit.registration.T_odom_lidar;
    fit.sweep = motion_.sweep(prediction, T_odom_lidar, span, imu_.samples());
    deskew(scan, fit.sweep, round + 1 < rounds ? coarse_sample_ : registration_sample_);
    fit.registration =
        registration_.align(scratch_, prediction.prior, T_odom_lidar, map_, fit.gate_m);
    if (!registration_.enough(scratch_.size()))
      fit.reason = OdometryReason::too_few_points;
    else if (!registration_.trustworthy(fit.registration, scratch_.size()))
      fit.reason = OdometryReason::no_fit;
  }
  const bool fits = fit.reason == OdometryReason::none;
  if (!fits) fit.registration.T_odom_lidar = predicted;
  if (!fits) fit.registration.covariance = prediction.prior.covariance;
  fit.sweep = motion_.sweep(prediction, fit.registration.T_odom_lidar, span, imu_.samples());
  return fit;
}

OdometryEstimate Odometry::report(const lidar::Scan& scan, const Prediction& prediction,
                                  const Fit& fit) const {
  const bool fits = fit.reason == OdometryReason::none;
  OdometryEstimate estimate;
  estimate.stamp = scan.stamp;
  estimate.T_odom_lidar = fit.registration.T_odom_lidar * fit.sweep.T_reference_stamp();
  estimate.covariance = fits ? drift(fit.registration.covariance, prediction, config_.drift_share)
                             : prediction.motion_covariance;
  estimate.status = fits ? OdometryStatus::ok : OdometryStatus::predicted;
  estimate.reason = fit.reason;
  estimate.points = fit.sweep.referred_to_stamp().deskewed(scan);
  estimate.diagnostics = {.points = static_cast<int>(registration_sample_.size()),
                          .iterations = fit.registration.iterations,
                          .inliers = fit.registration.inliers,
                          .rms_m = fit.registration.rms_m,
                          .gate_m = fit.gate_m,
                          .map_voxels = static_cast<int>(map_.size()),
                          .imu_used = prediction.inertial.has_value()};
  return estimate;
}

void Odometry::remember(const Prediction& prediction, const Fit& fit) {
  if (fit.reason == OdometryReason::none) {
    gate_.learn(prediction.prior.T_odom_lidar.inverse() * fit.registration.T_odom_lidar);
    motion_.accept(prediction, fit.registration.T_odom_lidar, fit.registration.covariance);
    misfits_ = 0;
    return;
  }
  motion_.coast(prediction);
  misfits_ += fit.reason == OdometryReason::no_fit;
  if (misfits_ < config_.restart_after) return;
  map_.clear();  // lost: the scan begins a new map where it is thought to be
  gate_.reset();
}

void Odometry::keep_first(const lidar::Scan& scan) {
  first_.span = Sweep::span_of(scan);
  first_.T_odom_stamp = T_odom_stamp_;
  if (first_.span == 0) return;
  for (const std::uint32_t i : map_sample_) {
    first_.points.push_back(scan.points[i]);
    first_.offset_ns.push_back(scan.offset_ns[i]);
  }
}

void Odometry::refine_first(const lidar::Scan& scan) {
  for (int round = 0; round < config_.first_rounds; ++round) {
    const Prediction prediction = motion_.predict(moment_of(scan), imu_.samples());
    const Fit found = fit(scan, prediction);
    if (found.reason != OdometryReason::none) break;
    redo_first(prediction, found.registration.T_odom_lidar);
  }
  first_.points.clear();
}

void Odometry::redo_first(const Prediction& prediction, const SE3& T_odom_lidar) {
  const Sweep sweep =
      motion_.sweep_before(T_odom_lidar, prediction.seconds, first_.span, imu_.samples());
  const SE3 T_odom_first = first_.T_odom_stamp * sweep.T_reference_stamp().inverse();
  motion_.start(motion_.moment(), T_odom_first);
  scratch_.clear();
  for (std::size_t i = 0; i < first_.points.size(); ++i)
    scratch_.push_back(T_odom_first *
                       sweep.deskewed(first_.points[i], first_.offset_ns[i]).cast<double>());
  map_.clear();
  map_.insert(scratch_, stamp_);
}

void Odometry::add_to_map(const lidar::Scan& scan, const Sweep& sweep) {
  misfits_ = 0;
  deskew(scan, sweep, map_sample_);
  const SE3& T_odom_lidar = motion_.T_odom_lidar();
  for (Eigen::Vector3d& point : scratch_) point = T_odom_lidar * point;
  map_.insert(scratch_, scan.stamp);
  if (to_seconds(scan.stamp - pruned_stamp_) < config_.prune_every_s) return;
  map_.prune(T_odom_lidar.translation(), scan.stamp);
  pruned_stamp_ = scan.stamp;
}

}  // namespace saker::odometry
