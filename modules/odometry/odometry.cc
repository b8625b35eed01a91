#include "saker/odometry/odometry.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace saker::odometry {
namespace {

constexpr std::size_t kMostSampledPoints =
    262144;  // two returns of a sensor of 128 rows and 1024 columns

constexpr Time kImuMemory = 3 * kNanosecondsPerSecond;  // before the last scan

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

Eigen::Matrix3d place_in_odom(const SE3& T_odom_lidar, const Matrix6d& covariance) {
  const Eigen::Matrix3d R = T_odom_lidar.linear();
  return R * covariance.bottomRightCorner<3, 3>() * R.transpose();
}

}  // namespace

const char* to_string(OdometryStatus status) {
  switch (status) {
    case OdometryStatus::ok:
      return "ok";
    case OdometryStatus::open:
      return "open";
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
    case OdometryReason::ambiguous:
      return "fits several places of the local map";
    case OdometryReason::not_held:
      return "nothing in sight holds the pose in a direction";
  }
  return "?";
}

Odometry::Odometry(const OdometryConfig& config)
    : config_(core::checked(config, "odometry")),
      map_(config_.map),
      registration_(config_.registration),
      search_(config_.search),
      column_search_(config_.column_search),
      gate_(config_.gate),
      motion_(config_.motion),
      filter_(kMostSampledPoints) {}

OdometryEstimate Odometry::register_scan(const lidar::Scan& scan,
                                         std::span<const lidar::ImuSample> imu) {
  if (started_ && (scan.stamp <= stamp_ || Sweep::moment_of(scan) <= motion_.moment()))
    return refused(scan);
  imu_.add(imu, motion_.moment() - kImuMemory);
  thin(scan);
  if (!started_) return start(scan);
  if (!first_.points.empty()) refine_first(scan);

  auto from_there = from_found(scan);
  auto [prediction, found] = from_there ? std::move(*from_there) : most_likely(scan);
  OdometryEstimate estimate = report(scan, prediction, found);
  const bool restarts = remember(prediction, found);
  stamp_ = estimate.stamp;
  T_odom_stamp_ = estimate.T_odom_lidar;
  if (registered(estimate.status) || restarts) add_to_map(scan, found.sweep);
  return estimate;
}

OdometryEstimate Odometry::start(const lidar::Scan& scan) {
  stamp_ = pruned_stamp_ = scan.stamp;
  T_odom_stamp_.linear() = level(imu_.samples());
  motion_.start(Sweep::moment_of(scan), T_odom_stamp_);
  const Time span = Sweep::span_of(scan);
  // The lidar is taken to stand where it is; a gyroscope knows how it turned.
  const Sweep sweep = motion_.sweep_before(T_odom_stamp_, 1, span, imu_.samples());
  motion_.start(Sweep::moment_of(scan), T_odom_stamp_ * sweep.T_reference_stamp().inverse());
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

Odometry::Share Odometry::share_of(const RegistrationResult& result, std::size_t points) {
  const double all = static_cast<double>(std::max<std::size_t>(points, 1));
  return {result.inliers / all, result.established / all};
}

OdometryReason Odometry::judge(const RegistrationResult& result, std::size_t points,
                               double least_share, bool expected) const {
  if (!registration_.enough(points)) return OdometryReason::too_few_points;
  const Share share = share_of(result, points);
  const bool usual = share.on_planes >= least_share * usual_.on_planes &&
                     (expected || share.on_established >= least_share * usual_.on_established);
  return usual && registration_.trustworthy(result, points) ? OdometryReason::none
                                                            : OdometryReason::no_fit;
}

Odometry::Fit Odometry::fit(const lidar::Scan& scan, const Prediction& prediction, Trust trust) {
  const Time span = Sweep::span_of(scan);
  const SE3& predicted = prediction.prior.T_odom_lidar;
  const Time established = scan.stamp - from_seconds(config_.established_s);
  Fit fit;
  fit.gate_m =
      gate_.gate_m(prediction.seconds / motion_.usual_interval_s(), prediction.prior.covariance);
  const Start start = start_of(scan, prediction, fit.gate_m);
  const bool pointed_to = trust == Trust::prediction && !start.searched && !lost(prediction);
  fit.registration.T_odom_lidar = start.T_odom_lidar;
  const int rounds = span == 0 ? 1 : config_.deskew_rounds;
  for (int round = 0; round < rounds && fit.reason == OdometryReason::none; ++round) {
    const SE3 T_odom_lidar = fit.registration.T_odom_lidar;
    fit.sweep = motion_.sweep(prediction, T_odom_lidar, span, imu_.samples());
    deskew(scan, fit.sweep, round + 1 < rounds ? coarse_sample_ : registration_sample_);
    fit.registration = registration_.align(scratch_, prediction.prior, T_odom_lidar, map_,
                                           fit.gate_m, established);
    const bool expected = pointed_to && fit.registration.deviation_sd <= config_.expected_sd;
    const double least = trust == Trust::found ? config_.least_found_share
                         : expected            ? config_.least_usual_share
                                               : config_.least_unexpected_share;
    fit.reason = judge(fit.registration, scratch_.size(), least, expected);
  }
  fit.share = share_of(fit.registration, scratch_.size());
  if (fit.reason == OdometryReason::none && start.ambiguous) fit.reason = OdometryReason::ambiguous;
  const bool fits = fit.reason == OdometryReason::none;
  if (!fits) fit.found = start.found;
  if (!fits) fit.registration.T_odom_lidar = predicted;
  if (!fits) fit.registration.covariance = prediction.prior.covariance;
  fit.sweep = motion_.sweep(prediction, fit.registration.T_odom_lidar, span, imu_.samples());
  return fit;
}

OdometryEstimate Odometry::report(const lidar::Scan& scan, const Prediction& prediction,
                                  const Fit& fit) {
  const bool fits = fit.reason == OdometryReason::none;
  OdometryEstimate estimate;
  estimate.stamp = scan.stamp;
  estimate.T_odom_lidar = fit.registration.T_odom_lidar * fit.sweep.T_reference_stamp();
  estimate.covariance =
      fits ? drift(fit.registration.held_covariance, prediction, config_.drift_share)
           : prediction.motion_covariance;
  estimate.status = fits ? OdometryStatus::ok : OdometryStatus::predicted;
  estimate.reason = fit.reason;
  if (fits && !held(estimate)) {
    estimate.status = OdometryStatus::open;
    estimate.reason = OdometryReason::not_held;
  }
  if (fits) estimate.covariance += motion_.half_sweep_covariance(prediction, Sweep::span_of(scan));
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

bool Odometry::held(const OdometryEstimate& estimate) {
  drifts_.push_back({estimate.stamp, place_in_odom(estimate.T_odom_lidar, estimate.covariance)});
  std::erase_if(drifts_, [&](const Drift& drift) {
    return drift.stamp <= estimate.stamp - kNanosecondsPerSecond;
  });
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Drift& drift : drifts_) sum += drift.covariance;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[2] <= config_.most_drift_m * config_.most_drift_m;
}

bool Odometry::remember(const Prediction& prediction, const Fit& fit) {
  if (fit.reason == OdometryReason::none) {
    gate_.learn(prediction.prior.T_odom_lidar.inverse() * fit.registration.T_odom_lidar);
    motion_.accept(prediction, fit.registration.T_odom_lidar, fit.registration.covariance);
    const double keep = usual_.on_planes > 0 ? config_.share_memory : 0;
    usual_.on_planes = keep * usual_.on_planes + (1 - keep) * fit.share.on_planes;
    usual_.on_established = keep * usual_.on_established + (1 - keep) * fit.share.on_established;
    misfits_ = 0;
    return false;
  }
  if (fit.found) {
    found_ = motion_;
    found_->accept(prediction, fit.found->T_odom_lidar, fit.found->covariance);
  }
  motion_.coast(prediction);
  misfits_ += fit.reason == OdometryReason::no_fit || fit.reason == OdometryReason::ambiguous;
  // Where the place is known, something else stands in sight: it may move, and the map with it.
  if (misfits_ < config_.restart_after || !lost(prediction)) return false;
  map_.clear();  // the scan begins a new one where it is thought to be
  found_.reset();
  drifts_.push_back(
      {stamp_, place_in_odom(prediction.prior.T_odom_lidar, prediction.prior.covariance)});
  gate_.reset();
  usual_ = {};
  return true;
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
    const Prediction prediction = motion_.predict(Sweep::moment_of(scan), imu_.samples());
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
