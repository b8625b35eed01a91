#include "saker/slam/model_algebra.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "saker/slam/manifolds.h"

namespace saker::slam {
namespace {

using objects::Cuboid;
using objects::Cylinder;

Eigen::VectorXd difference_of(const Cuboid& b, const Cuboid& a) {
  Vector9d step;
  step << core::se3_log(a.pose.inverse() * b.pose), b.size - a.size;
  return step;
}

Eigen::VectorXd difference_of(const Cylinder& b, const Cylinder& a) {
  Vector6d step;
  step << b.root - a.root, axis_minus(b.axis, a.axis), b.radius - a.radius;
  return step;
}

Model moved_by(const Cuboid& a, const Eigen::VectorXd& step) {
  return Cuboid{a.pose * core::se3_exp(step.head<6>()),
                (a.size + step.tail<3>()).cwiseMax(kLeastSize)};
}

Model moved_by(const Cylinder& a, const Eigen::VectorXd& step) {
  return Cylinder{a.root + step.head<3>(), axis_plus(a.axis, step.segment<2>(3)),
                  std::max(a.radius + step[5], kLeastSize), a.height};
}

/// A step of T_b_a moves T_b_a · p by R (ν − p × ω): rows for root and axis of a cylinder.
Eigen::MatrixXd transformed_covariance(const SE3& T_b_a, const Matrix6d& motion,
                                       const Cylinder& in_a, const Eigen::MatrixXd& covariance) {
  const Eigen::Matrix3d& R = T_b_a.linear();
  const Eigen::Matrix<double, 2, 3> plane_b = objects::tangent_basis(R * in_a.axis).transpose();
  Matrix6d J = Matrix6d::Identity(), M = Matrix6d::Zero();
  J.block<3, 3>(0, 0) = R;
  J.block<2, 2>(3, 3) = plane_b * R * objects::tangent_basis(in_a.axis);
  M.block<3, 3>(0, 0) = -R * core::hat(in_a.root);
  M.block<3, 3>(0, 3) = R;
  M.block<2, 3>(3, 0) = -plane_b * R * core::hat(in_a.axis);
  return J * covariance * J.transpose() + M * motion * M.transpose();
}

Eigen::MatrixXd transformed_covariance(const SE3&, const Matrix6d& motion, const Cuboid& in_a,
                                       const Eigen::MatrixXd& covariance) {
  const Matrix6d A = core::se3_adjoint(in_a.pose.inverse());
  Eigen::MatrixXd in_b = covariance;
  in_b.topLeftCorner<6, 6>() += A * motion * A.transpose();
  return in_b;
}

Eigen::Matrix3d quarter_turn(int quarters) {
  return core::so3_exp({0, 0, quarters * std::numbers::pi / 2});
}

bool finite(const Cuboid& cuboid) {
  return cuboid.pose.matrix().allFinite() && cuboid.size.allFinite() && cuboid.size.minCoeff() > 0;
}

bool finite(const Cylinder& cylinder) {
  return cylinder.root.allFinite() && cylinder.axis.allFinite() &&
         std::abs(cylinder.axis.norm() - 1) < 1e-3 && std::isfinite(cylinder.height) &&
         cylinder.radius > 0 && std::isfinite(cylinder.radius);
}

using Polygon = std::vector<Eigen::Vector2d>;

/// The part of a convex polygon where side · p[axis] <= limit (Sutherland and Hodgman, 1974).
Polygon cut(const Polygon& polygon, int axis, double side, double limit) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& p = polygon[i];
    const Eigen::Vector2d& q = polygon[(i + 1) % polygon.size()];
    const double beyond_p = side * p[axis] - limit, beyond_q = side * q[axis] - limit;
    if (beyond_p <= 0) kept.push_back(p);
    if ((beyond_p <= 0) != (beyond_q <= 0)) {
      kept.push_back(p + (q - p) * beyond_p / (beyond_p - beyond_q));
    }
  }
  return kept;
}

double area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& p = polygon[i];
    const Eigen::Vector2d& q = polygon[(i + 1) % polygon.size()];
    twice += p.x() * q.y() - q.x() * p.y();
  }
  return std::abs(twice) / 2;
}

}  // namespace

bool is_cuboid(const Model& model) { return std::holds_alternative<Cuboid>(model); }

Eigen::VectorXd difference(const Model& b, const Model& a) {
  if (is_cuboid(a)) return difference_of(std::get<Cuboid>(b), std::get<Cuboid>(a));
  return difference_of(std::get<Cylinder>(b), std::get<Cylinder>(a));
}

Model moved(const Model& a, const Eigen::VectorXd& step) {
  return std::visit([&](const auto& model) { return moved_by(model, step); }, a);
}

Gaussian transformed(const SE3& T_b_a, const Matrix6d& motion, const Gaussian& in_a) {
  const auto covariance = [&](const auto& model) {
    return transformed_covariance(T_b_a, motion, model, in_a.covariance);
  };
  return {objects::transformed(T_b_a, in_a.model), std::visit(covariance, in_a.model)};
}

Gaussian fused(const Gaussian& a, const Gaussian& b) {
  const Eigen::MatrixXd sum = a.covariance + b.covariance;
  const Eigen::MatrixXd gain = sum.llt().solve(a.covariance).transpose();
  Eigen::MatrixXd covariance = a.covariance - gain * a.covariance;
  covariance = 0.5 * (covariance + covariance.transpose()).eval();
  return {moved(a.model, gain * difference(b.model, a.model)), covariance};
}

objects::Cuboid turned(const Cuboid& cuboid, int quarters) {
  Cuboid result = cuboid;
  result.pose.linear() = cuboid.pose.linear() * quarter_turn(quarters);
  if (quarters % 2 != 0) std::swap(result.size.x(), result.size.y());
  return result;
}

Gaussian turned(const Gaussian& cuboid, int quarters) {
  Matrix9d J = Matrix9d::Zero();
  J.block<3, 3>(0, 0) = J.block<3, 3>(3, 3) = quarter_turn(-quarters);
  J.block<3, 3>(6, 6) = quarter_turn(-quarters).cwiseAbs();
  return {turned(std::get<Cuboid>(cuboid.model), quarters), J * cuboid.covariance * J.transpose()};
}

Eigen::Vector2d turned(const Eigen::Vector2d& front, int quarters) {
  switch (((quarters % 4) + 4) % 4) {
    case 1:
      return {front.y(), -front.x()};
    case 2:
      return -front;
    case 3:
      return {-front.y(), front.x()};
    default:
      return front;
  }
}

int nearest_turn(const Cuboid& cuboid, const Cuboid& reference) {
  const double heading = core::yaw(cuboid.pose.linear().transpose() * reference.pose.linear());
  const int turns = static_cast<int>(std::lround(heading / (std::numbers::pi / 2)));
  return (turns % 4 + 4) % 4;
}

double elongation(const Cuboid& cuboid) {
  const auto [shorter, longer] = std::minmax(cuboid.size.x(), cuboid.size.y());
  return longer / shorter;
}

Eigen::Vector2d end_variances(const Eigen::Ref<const Eigen::MatrixXd>& covariance, int axis) {
  const int centre = 3 + axis, size = 6 + axis;
  const double mean = covariance(centre, centre) + 0.25 * covariance(size, size);
  const double both = covariance(centre, size);
  return Eigen::Vector2d(mean - both, mean + both).cwiseMax(0);
}

void raise_end_variances(Eigen::MatrixXd& covariance, int axis, const Eigen::Vector2d& variances) {
  const Eigen::Vector2d lacking = variances - end_variances(covariance, axis);
  for (int end = 0; end < 2; ++end) {
    if (lacking[end] <= 0) continue;
    Vector9d moved = Vector9d::Zero();  // the end by one
    moved[3 + axis] = 0.5;
    moved[6 + axis] = end == 0 ? -1 : 1;
    covariance += lacking[end] * moved * moved.transpose();
  }
}

bool on_footprint(const Cuboid& cuboid, const Eigen::Vector3d& p) {
  const Eigen::Vector3d q = cuboid.pose.inverse() * p;
  return 2 * std::abs(q.x()) <= cuboid.size.x() && 2 * std::abs(q.y()) <= cuboid.size.y();
}

double footprint_overlap(const Cuboid& a, const Cuboid& b) {
  const SE3 T_a_b = a.pose.inverse() * b.pose;
  Polygon shared;
  for (const Eigen::Vector2d& corner : {Eigen::Vector2d(1, 1), {-1, 1}, {-1, -1}, {1, -1}}) {
    const Eigen::Vector2d in_b = corner.cwiseProduct(b.size.head<2>()) / 2;
    shared.push_back((T_a_b * Eigen::Vector3d(in_b.x(), in_b.y(), 0)).head<2>());
  }
  for (const int axis : {0, 1}) {
    for (const double side : {-1.0, 1.0}) shared = cut(shared, axis, side, a.size[axis] / 2);
  }
  const double smaller = std::min(a.size.head<2>().prod(), b.size.head<2>().prod());
  return area(shared) / smaller;
}

bool valid(const Gaussian& measured) {
  const int dimension = is_cuboid(measured.model) ? kCuboidTangent : kCylinderTangent;
  const Eigen::MatrixXd& covariance = measured.covariance;
  if (covariance.rows() != dimension || covariance.cols() != dimension) return false;
  if (!std::visit([](const auto& model) { return finite(model); }, measured.model)) return false;
  return covariance.allFinite() && covariance.llt().info() == Eigen::Success;
}

}  // namespace saker::slam
