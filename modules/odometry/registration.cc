#include "saker/odometry/registration.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace saker::odometry {

namespace {

double rms_range(std::span<const Eigen::Vector3d> points) {
  double sum = 0;
  for (const Eigen::Vector3d& point : points) sum += point.squaredNorm();
  return points.empty() ? 0 : std::sqrt(sum / static_cast<double>(points.size()));
}

/// d r / d [rotation, translation], right, of a plane's normal in the lidar frame.
Vector6d derivative(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
  Vector6d J;
  J << point.cross(normal), normal;
  return J;
}

/// How far points at this range are moved, at most.
double shift(const SE3& motion, double range_m) {
  return motion.translation().norm() + range_m * core::so3_log(motion.linear()).norm();
}

}  // namespace

void Registration::associate(std::span<const Eigen::Vector3d> points, const SE3& T, VoxelMap& map,
                             bool wide) {
  matches_.clear();
  for (const Eigen::Vector3d& point : points) {
    if (const auto plane = map.nearest_plane(T * point, wide)) matches_.push_back({point, *plane});
  }
}

Registration::NormalEquations Registration::linearise(const SE3& T, double gate_m, double kernel_m,
                                                      bool with_tilt) {
  NormalEquations sum;
  distances_.clear();
  const Eigen::Matrix3d R = T.linear();
  const double kernel2 = kernel_m * kernel_m;
  for (const auto& [point, plane] : matches_) {
    const Eigen::Vector3d offset = T * point - plane.point;
    const double r = plane.normal.dot(offset);
    if (std::abs(r) > gate_m) continue;
    distances_.push_back(static_cast<float>(std::abs(r)));
    const double robust = kernel2 / (kernel2 + r * r);  // Geman-McClure: w = (k² / (k² + r²))²
    const double noise = config_.noise_m * config_.noise_m + plane.variance;
    const double tilted =
        noise * config_.plane_correlation * (plane.tilt.transpose() * offset).squaredNorm();
    const double w = robust * robust / (noise + tilted);
    const Vector6d J = derivative(point, R.transpose() * plane.normal);
    const Vector6d wJ = w * J;
    sum.H.noalias() += wJ * J.transpose();
    for (int k = 0; with_tilt && k < 2; ++k) {
      const Vector6d u = derivative(point, R.transpose() * plane.tilt.col(k));
      sum.of_tilt.noalias() += (w * noise * u) * u.transpose();
    }
    sum.g += r * wJ;
    sum.chi2 += w * r * r;
    sum.weights += robust * robust;
    if (robust < 0.7) continue;
    ++sum.inliers;
    sum.established += plane.first_seen < established_;
    sum.square_sum += r * r;
  }
  sum.H = sum.H.selfadjointView<Eigen::Lower>();
  return sum;
}

double Registration::next_kernel(double gate_m) {
  if (distances_.empty()) return gate_m;
  const auto middle = distances_.begin() + static_cast<std::ptrdiff_t>(distances_.size() / 2);
  std::nth_element(distances_.begin(), middle, distances_.end());
  return std::clamp(3 * 1.4826 * static_cast<double>(*middle),
                    std::min(config_.least_kernel_m, gate_m), gate_m);
}

/// Residuals larger than the model says widen the covariance; neighbouring points are not
/// independent.
double Registration::inflation_of(const NormalEquations& sum) const {
  return config_.correlation * std::max(1.0, sum.chi2 / std::max(1.0, sum.weights));
}

/// With H = L Lᵀ and V diag(b) Vᵀ = L⁻¹ of_tilt L⁻ᵀ a direction of V keeps the share max(0, 1 − b)
/// of its information.
Matrix6d Registration::held_covariance(const NormalEquations& sum,
                                       const Matrix6d& prior_information) const {
  const Eigen::LLT<Matrix6d> factors(sum.H);
  if (factors.info() != Eigen::Success) return prior_information.inverse();
  const Matrix6d L = factors.matrixL();
  const Matrix6d L_inverse = L.inverse();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> tilt(L_inverse * sum.of_tilt *
                                                     L_inverse.transpose());
  const Vector6d kept = (1 - tilt.eigenvalues().array()).max(0) / inflation_of(sum);
  const Matrix6d LV = L * tilt.eigenvectors();
  return (LV * kept.asDiagonal() * LV.transpose() + prior_information).inverse();
}

RegistrationResult Registration::align(std::span<const Eigen::Vector3d> points,
                                       const PosePrior& prior, const SE3& start, VoxelMap& map,
                                       double gate_m, Time established) {
  established_ = established;
  RegistrationResult result;
  result.T_odom_lidar = start;
  const Matrix6d prior_information = prior.covariance.inverse();
  const double range_m = rms_range(points);
  SE3 T_associated = start;
  associate(points, start, map, gate_m > 1);
  double kernel_m = gate_m;
  Matrix6d information = prior_information;
  while (result.iterations < config_.max_iterations && !result.converged) {
    if (shift(T_associated.inverse() * result.T_odom_lidar, range_m) > config_.keep_planes_m) {
      T_associated = result.T_odom_lidar;
      associate(points, T_associated, map, gate_m > 1);
    }
    const NormalEquations sum = linearise(result.T_odom_lidar, gate_m, kernel_m);
    const double inflation = inflation_of(sum);
    const Vector6d from_prior = core::se3_log(prior.T_odom_lidar.inverse() * result.T_odom_lidar);
    information = sum.H / inflation + prior_information;
    const Vector6d step =
        -information.ldlt().solve(sum.g / inflation + prior_information * from_prior);
    if (!step.allFinite()) break;
    result.T_odom_lidar = result.T_odom_lidar * core::se3_exp(step);
    ++result.iterations;
    result.inliers = sum.inliers;
    result.established = sum.established;
    result.rms_m = sum.inliers > 0 ? std::sqrt(sum.square_sum / sum.inliers) : 0;
    result.converged =
        step.head<3>().norm() < config_.stop_rad && step.tail<3>().norm() < config_.stop_m;
    kernel_m = next_kernel(gate_m);
  }
  result.covariance = information.inverse();
  result.held_covariance =
      held_covariance(linearise(result.T_odom_lidar, gate_m, kernel_m, true), prior_information);
  const Vector6d deviation = core::se3_log(prior.T_odom_lidar.inverse() * result.T_odom_lidar);
  result.deviation_sd = std::sqrt(std::max(0.0, deviation.dot(prior_information * deviation)) / 6);
  return result;
}

bool Registration::trustworthy(const RegistrationResult& result, std::size_t points) const {
  return result.inliers >= config_.min_inliers &&
         result.inliers >= config_.min_inlier_ratio * static_cast<double>(points) &&
         result.rms_m <= config_.max_rms_m && result.deviation_sd <= config_.max_deviation_sd &&
         result.covariance.allFinite();
}

}  // namespace saker::odometry
