#include <Eigen/Cholesky>
#include <algorithm>
#include <utility>

#include "saker/odometry/odometry.h"

/// Where a scan was taken: by which prediction, and where registration starts.
namespace saker::odometry {
namespace {

constexpr double kClearlyMore = 1.05;  // of inliers: noise makes less of a difference

constexpr double kLostIntervals = 3;  // without a registered scan

constexpr int kPolish = 3;  // more registrations of what has not converged

constexpr double kElsewhere_m = 1, kElsewhere_rad = 0.1;  // more than registration errs by

bool elsewhere(const SE3& a, const SE3& b) {
  const SE3 apart = a.inverse() * b;
  return apart.translation().norm() > kElsewhere_m ||
         core::so3_log(apart.linear()).norm() > kElsewhere_rad;
}

/// Twice the negative log density of the pose under its prediction.
double surprise(const SE3& T_odom_lidar, const PosePrior& prior) {
  const Vector6d off = core::se3_log(prior.T_odom_lidar.inverse() * T_odom_lidar);
  const Eigen::LDLT<Matrix6d> factors(prior.covariance);
  return off.dot(factors.solve(off)) + factors.vectorD().array().abs().log().sum();
}

}  // namespace

std::optional<std::pair<Prediction, Odometry::Fit>> Odometry::from_found(const lidar::Scan& scan) {
  if (!found_) return std::nullopt;
  std::swap(motion_, *found_);
  Prediction prediction = motion_.predict(Sweep::moment_of(scan), imu_.samples());
  Fit found = fit(scan, prediction, Trust::found);
  const bool fits = found.reason == OdometryReason::none;
  if (!fits) std::swap(motion_, *found_);
  found_.reset();
  if (!fits) return std::nullopt;
  return std::pair{std::move(prediction), std::move(found)};
}

/// The prediction, unless another one explains the scan where it does not.
std::pair<Prediction, Odometry::Fit> Odometry::most_likely(const lidar::Scan& scan) {
  const Time moment = Sweep::moment_of(scan);
  Prediction prediction = motion_.predict(moment, imu_.samples());
  Fit found = fit(scan, prediction);
  std::optional<Prediction> other = motion_.predict_stepped(moment, imu_.samples());
  // A single scan may be of another place; several say that the inertial unit is wrong.
  if (!other && prediction.inertial && found.reason == OdometryReason::no_fit && misfits_ > 0)
    other = motion_.predict_without_imu(moment);
  if (!other) return {prediction, std::move(found)};
  Fit found_otherwise = fit(scan, *other, Trust::none);
  if (prediction.inertial) found_otherwise.found.reset();  // it knows where the scan was taken
  // What fits nowhere says nothing against the prediction.
  const bool may_be =
      found_otherwise.reason == OdometryReason::none || (found_otherwise.found && !found.found);
  if (!may_be || !more_likely(found_otherwise, *other, found, prediction))
    return {prediction, std::move(found)};
  return {*other, std::move(found_otherwise)};
}

/// Which of two predictions explains the scan: points first, then the motion.
bool Odometry::more_likely(const Fit& a, const Prediction& of_a, const Fit& b,
                           const Prediction& of_b) {
  if (b.reason == OdometryReason::ambiguous &&
      a.share.on_planes <= kClearlyMore * b.share.on_planes)
    return false;
  const bool a_fits = a.reason == OdometryReason::none, b_fits = b.reason == OdometryReason::none;
  if (a_fits != b_fits) return a_fits;
  if (a.share.on_planes > kClearlyMore * b.share.on_planes) return true;
  if (b.share.on_planes > kClearlyMore * a.share.on_planes) return false;
  return surprise(a.registration.T_odom_lidar, of_a.prior) <
         surprise(b.registration.T_odom_lidar, of_b.prior);
}

bool Odometry::lost(const Prediction& prediction) const {
  return prediction.seconds > kLostIntervals * motion_.usual_interval_s() &&
         !search_.covers(prediction.prior);
}

std::vector<SE3> Odometry::far_starts(const lidar::Scan& scan, const Prediction& prediction,
                                      const Sweep& sweep) {
  if (!lost(prediction)) return {};
  deskew(scan, sweep, registration_sample_);
  return column_search_.starts(scratch_, prediction.prior, map_);
}

Odometry::Start Odometry::start_of(const lidar::Scan& scan, const Prediction& prediction,
                                   double gate_m) {
  const PosePrior& prior = prediction.prior;
  Start start{prior.T_odom_lidar};
  if (!search_.worthwhile(prior) || !registration_.enough(registration_sample_.size()))
    return start;
  const Sweep sweep =
      motion_.sweep(prediction, prior.T_odom_lidar, Sweep::span_of(scan), imu_.samples());
  const std::vector<SE3> far = far_starts(scan, prediction, sweep);
  deskew(scan, sweep, coarse_sample_);
  const std::vector<SE3> starts = far.empty() ? search_.starts(scratch_, prior, map_) : far;
  std::vector<RegistrationResult> tried = {
      registration_.align(scratch_, prior, prior.T_odom_lidar, map_, gate_m)};
  std::size_t best = 0;
  for (const SE3& from : starts) {
    tried.push_back(registration_.align(scratch_, prior, from, map_, gate_m));
    if (tried.back().inliers >= kClearlyMore * tried[best].inliers) best = tried.size() - 1;
  }
  if (best > 0) start = {tried[best].T_odom_lidar, true};
  if (far.empty()) return start;
  const auto polished = [&](RegistrationResult result) {
    for (int round = 0; round < kPolish && !result.converged; ++round)
      result = registration_.align(scratch_, prior, result.T_odom_lidar, map_, gate_m);
    return result;
  };
  tried[best] = polished(tried[best]);
  if (best > 0) start.T_odom_lidar = tried[best].T_odom_lidar;
  const auto rivals = [&](const RegistrationResult& other) {
    return kClearlyMore * other.inliers > tried[best].inliers &&
           elsewhere(other.T_odom_lidar, tried[best].T_odom_lidar);
  };
  start.ambiguous = std::any_of(tried.begin(), tried.end(), [&](const RegistrationResult& other) {
    return rivals(other) && rivals(polished(other));
  });
  if (start.searched && !start.ambiguous && registration_.trustworthy(tried[best], scratch_.size()))
    start.found = tried[best];
  return start;
}

}  // namespace saker::odometry
