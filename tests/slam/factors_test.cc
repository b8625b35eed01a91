#include "saker/slam/factors.h"

#include <ceres/gradient_checker.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <numbers>
#include <vector>

#include "saker/slam/model_algebra.h"

namespace saker::slam {
namespace {

using objects::Cuboid;
using objects::Cylinder;

template <int N>
Eigen::Matrix<double, N, N> some_covariance() {
  Eigen::Matrix<double, N, N> A;
  for (int i = 0; i < N * N; ++i) A(i / N, i % N) = 0.1 * std::sin(1.0 + 3 * i);
  return A * A.transpose() + 0.01 * Eigen::Matrix<double, N, N>::Identity();
}

SE3 pose_at(double yaw, double x, double y) {
  return core::se3_exp((Vector6d() << 0.05, -0.03, yaw, x, y, 1.2).finished());
}

std::vector<double> pose_parameters(const SE3& T) {
  std::vector<double> x(kPoseParameters);
  write_pose(T, x.data());
  return x;
}

std::vector<double> cuboid_parameters(const Cuboid& cuboid) {
  std::vector<double> x = pose_parameters(cuboid.pose);
  x.insert(x.end(), cuboid.size.begin(), cuboid.size.end());
  return x;
}

std::vector<double> cylinder_parameters(const Cylinder& c) {
  return {c.root.x(), c.root.y(), c.root.z(), c.axis.x(), c.axis.y(), c.axis.z(), c.radius};
}

Cylinder some_cylinder() {
  return {{7, -3, 0.2}, Eigen::Vector3d(0.1, -0.05, 1).normalized(), 0.17, 3};
}

using Dense = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Parameters = std::vector<std::vector<double>>;

Eigen::VectorXd residuals_of(const ceres::CostFunction& cost, const Parameters& x) {
  Eigen::VectorXd residuals(cost.num_residuals());
  const double* blocks[] = {x[0].data(), x[1].data()};
  EXPECT_TRUE(cost.Evaluate(blocks, residuals.data(), nullptr));
  return residuals;
}

Dense analytic(const ceres::CostFunction& cost, const ceres::Manifold& manifold,
               const Parameters& x, std::size_t block) {
  Dense J(cost.num_residuals(), manifold.AmbientSize());
  Dense plus(manifold.AmbientSize(), manifold.TangentSize());
  Eigen::VectorXd residuals(cost.num_residuals());
  const double* blocks[] = {x[0].data(), x[1].data()};
  double* jacobians[] = {nullptr, nullptr};
  jacobians[block] = J.data();
  EXPECT_TRUE(cost.Evaluate(blocks, residuals.data(), jacobians));
  EXPECT_TRUE(manifold.PlusJacobian(x[block].data(), plus.data()));
  return J * plus;
}

Dense by_differences(const ceres::CostFunction& cost, const ceres::Manifold& manifold,
                     const Parameters& x, std::size_t block) {
  constexpr double h = 1e-5;
  Dense J(cost.num_residuals(), manifold.TangentSize());
  for (int i = 0; i < manifold.TangentSize(); ++i) {
    Parameters ahead = x, behind = x;
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(manifold.TangentSize(), i);
    const Eigen::VectorXd back = -step;
    manifold.Plus(x[block].data(), step.data(), ahead[block].data());
    manifold.Plus(x[block].data(), back.data(), behind[block].data());
    J.col(i) = (residuals_of(cost, ahead) - residuals_of(cost, behind)) / (2 * h);
  }
  return J;
}

/// Residuals mixed by a fixed matrix without zeros. Ceres' checker compares entry by entry in
/// relative terms; where a derivative is 0 it would compare rounding with rounding.
class Mixed final : public ceres::CostFunction {
 public:
  explicit Mixed(const ceres::CostFunction& cost) : cost_(cost) {
    set_num_residuals(cost.num_residuals());
    *mutable_parameter_block_sizes() = cost.parameter_block_sizes();
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    if (!cost_.Evaluate(parameters, residuals, jacobians)) return false;
    mix(residuals, 1);
    for (std::size_t block = 0; jacobians != nullptr && block < 2; ++block) {
      if (jacobians[block] != nullptr) mix(jacobians[block], parameter_block_sizes()[block]);
    }
    return true;
  }

 private:
  void mix(double* values, int columns) const {
    Eigen::Map<Dense> matrix(values, num_residuals(), columns);
    const auto entry = [](Eigen::Index i, Eigen::Index j) {
      return 1.5 + std::sin(static_cast<double>(1 + i + 5 * j));
    };
    matrix = (Dense::NullaryExpr(num_residuals(), num_residuals(), entry) * matrix).eval();
  }

  const ceres::CostFunction& cost_;
};

void expect_gradient(const ceres::CostFunction& cost, const ceres::Manifold& first,
                     const ceres::Manifold& second, const Parameters& x) {
  const std::vector<const ceres::Manifold*> manifolds = {&first, &second};
  for (std::size_t block = 0; block < 2; ++block) {
    const Dense J = analytic(cost, *manifolds[block], x, block);
    EXPECT_LT((J - by_differences(cost, *manifolds[block], x, block)).norm(), 1e-7 * J.norm());
  }
  const Mixed mixed(cost);
  ceres::NumericDiffOptions options;
  options.ridders_relative_initial_step_size = 1e-4;
  const double* blocks[] = {x[0].data(), x[1].data()};
  EXPECT_TRUE(ceres::GradientChecker(&mixed, &manifolds, options).Probe(blocks, 1e-7, nullptr));
}

TEST(Factors, OdometryGradient) {
  const PoseManifold pose;
  const SE3 a = pose_at(0.4, 3, -2), b = pose_at(0.7, 4.2, -1.5);
  for (const double error : {0.0, 1e-9, 1e-3, 0.8, 3.0}) {
    const Vector6d step = error / 2 * (Vector6d() << 1, -1, 1.2, 0.3, 1, -1).finished();
    const OdometryFactor factor(a.inverse() * b * core::se3_exp(step), some_covariance<6>());
    expect_gradient(factor, pose, pose, {pose_parameters(a), pose_parameters(b)});
  }
}

TEST(Factors, PoseGradient) {
  const PoseManifold pose;
  const SE3 known = pose_at(0.4, 3, -2);
  for (const double error : {0.0, 1e-9, 1e-3, 0.8, 3.0}) {
    const Vector6d step = error / 2 * (Vector6d() << 1, -1, 1.2, 0.3, 1, -1).finished();
    const PoseFactor factor(known * core::se3_exp(step), some_covariance<6>());
    const Parameters x = {pose_parameters(known), {}};
    const Dense J = analytic(factor, pose, x, 0);
    EXPECT_LT((J - by_differences(factor, pose, x, 0)).norm(), 1e-7 * J.norm());
  }
}

TEST(Factors, CuboidGradient) {
  const PoseManifold pose;
  const CuboidManifold cuboid_manifold;
  const SE3 lidar = pose_at(-1.4, 3, -2);
  const Cuboid truth{pose_at(2.1, 9, 4), {4.4, 1.8, 1.5}};
  for (const double error : {0.0, 1e-9, 1e-3, 0.8, 3.0}) {
    const Vector6d step = error / 2 * (Vector6d() << 0.2, -0.1, 1.9, 0.3, 1, -1).finished();
    const Cuboid measured{lidar.inverse() * truth.pose * core::se3_exp(step), {4, 2, 1.4}};
    for (const double sds : {1e9, 3.0, 1.0}) {
      const CuboidFactor factor(measured, some_covariance<9>(), {.sds = sds});
      expect_gradient(factor, pose, cuboid_manifold,
                      {pose_parameters(lidar), cuboid_parameters(truth)});
    }
  }
}

TEST(Factors, CylinderGradient) {
  const PoseManifold pose;
  const CylinderManifold cylinder_manifold;
  const SE3 lidar = pose_at(-1.4, 3, -2);
  const Cylinder truth = some_cylinder();
  for (const double error : {0.0, 1e-3, 0.8}) {
    Model measured = objects::transformed(lidar.inverse(), Model(truth));
    measured = moved(measured, error * (Vector6d() << 0.2, -0.1, 0.4, 0.3, 1, 0.1).finished());
    const CylinderFactor factor(std::get<Cylinder>(measured), some_covariance<6>());
    expect_gradient(factor, pose, cylinder_manifold,
                    {pose_parameters(lidar), cylinder_parameters(truth)});
  }
}

TEST(Factors, TrueValuesHaveNoError) {
  const SE3 lidar = pose_at(0.3, 1, 1);
  const Cuboid cuboid{pose_at(2, 9, 4), {4.4, 1.8, 1.5}};
  const Cylinder cylinder = some_cylinder();
  const auto x = pose_parameters(lidar), c = cuboid_parameters(cuboid),
             l = cylinder_parameters(cylinder);
  Vector9d residuals = Vector9d::Ones();
  const double* with_cuboid[] = {x.data(), c.data()};
  CuboidFactor(objects::transformed(lidar.inverse(), cuboid), some_covariance<9>(),
               HiddenEndConfig{})
      .Evaluate(with_cuboid, residuals.data(), nullptr);
  EXPECT_LT(residuals.norm(), 1e-12);
  const double* with_cylinder[] = {x.data(), l.data()};
  CylinderFactor(objects::transformed(lidar.inverse(), cylinder), some_covariance<6>())
      .Evaluate(with_cylinder, residuals.data(), nullptr);
  EXPECT_LT(residuals.head<6>().norm(), 1e-12);
}

TEST(Factors, CostIsHalfTheSquaredMahalanobisDistance) {
  const Cuboid measured{pose_at(2, 9, 4), {4.4, 1.8, 1.5}};
  const Matrix9d covariance = some_covariance<9>();
  const Vector9d step = (Vector9d() << 0.1, 0, -0.2, 0.3, -0.1, 0.2, 0.5, -0.3, 0.1).finished();
  const auto x = pose_parameters(SE3::Identity());
  const auto c = cuboid_parameters(std::get<Cuboid>(moved(measured, step)));
  Vector9d residuals;
  const double* parameters[] = {x.data(), c.data()};
  constexpr HiddenEndConfig kNothingHidden{.sds = 1e9};
  CuboidFactor(measured, covariance, kNothingHidden)
      .Evaluate(parameters, residuals.data(), nullptr);
  EXPECT_NEAR(residuals.squaredNorm(), step.dot(covariance.llt().solve(step)), 1e-9);
}

}  // namespace
}  // namespace saker::slam
