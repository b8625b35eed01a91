#include "saker/slam/manifolds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace saker::slam {
namespace {

constexpr double kDifference = 1e-6;  // of central differences

using Vector = Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A manifold with points on it, and whether its tangent ends at π.
struct Case {
  const char* name;
  std::shared_ptr<ceres::Manifold> manifold;
  std::vector<Vector> points;
};

Vector pose_point(const Vector6d& tangent) {
  Vector x(kPoseParameters);
  write_pose(core::se3_exp(tangent), x.data());
  return x;
}

Vector join(const Vector& a, const Vector& b) {
  Vector x(a.size() + b.size());
  x.head(a.size()) = a;
  x.tail(b.size()) = b;
  return x;
}

std::vector<Case> cases() {
  const Vector near = pose_point((Vector6d() << 0.2, -0.4, 0.9, 3, -2, 1).finished());
  const Vector far = pose_point((Vector6d() << 1.2, -2.4, 0.9, 30, -20, 1).finished());
  const Vector up = Eigen::Vector3d::UnitZ();
  const Vector leaning = Eigen::Vector3d(0.3, -0.2, 0.9).normalized();
  const Vector size = Eigen::Vector3d(4.4, 1.8, 1.5), root = Eigen::Vector3d(8, -3, 0.1);
  const Vector radius = Vector::Constant(1, 0.2);
  return {{"pose", std::make_shared<PoseManifold>(), {near, far}},
          {"axis", std::make_shared<AxisManifold>(), {up, leaning}},
          {"cuboid", std::make_shared<CuboidManifold>(), {join(near, size), join(far, size)}},
          {"cylinder",
           std::make_shared<CylinderManifold>(),
           {join(join(root, up), radius), join(join(root, leaning), radius)}}};
}

/// Tiny, generic and almost π: every component at once, scaled so that no rotation passes π.
std::vector<Vector> steps(int size) {
  const Vector direction = Vector::LinSpaced(size, 1, -0.6).normalized();
  std::vector<Vector> all;
  for (const double length : {1e-10, 1e-5, 0.3, 1.5, std::numbers::pi - 1e-4}) {
    all.push_back(length * direction);
  }
  Vector turn = Vector::Zero(size);
  turn[0] = std::numbers::pi - 1e-5;
  all.push_back(turn);
  return all;
}

Vector plus(const ceres::Manifold& manifold, const Vector& x, const Vector& step) {
  Vector moved(manifold.AmbientSize());
  EXPECT_TRUE(manifold.Plus(x.data(), step.data(), moved.data()));
  return moved;
}

Vector minus(const ceres::Manifold& manifold, const Vector& y, const Vector& x) {
  Vector step(manifold.TangentSize());
  EXPECT_TRUE(manifold.Minus(y.data(), x.data(), step.data()));
  return step;
}

template <class Check>
void at_every_point(const Check& check) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    for (const Vector& x : c.points) check(*c.manifold, x);
  }
}

TEST(Manifolds, NoStepGoesNowhere) {
  at_every_point([](const ceres::Manifold& m, const Vector& x) {
    EXPECT_LT((plus(m, x, Vector::Zero(m.TangentSize())) - x).norm(), 1e-14);
    EXPECT_LT(minus(m, x, x).norm(), 1e-14);
  });
}

TEST(Manifolds, DifferenceUndoesStep) {
  at_every_point([](const ceres::Manifold& m, const Vector& x) {
    for (const Vector& step : steps(m.TangentSize())) {
      EXPECT_LT((minus(m, plus(m, x, step), x) - step).norm(), 1e-8) << step.transpose();
    }
  });
}

TEST(Manifolds, StepUndoesDifference) {
  for (const Case& c : cases()) {
    const Vector &x = c.points[0], &y = c.points[1];
    const Vector back = plus(*c.manifold, x, minus(*c.manifold, y, x));
    EXPECT_LT(minus(*c.manifold, back, y).norm(), 1e-9) << c.name;
  }
}

TEST(Manifolds, PlusJacobianIsTheDerivative) {
  at_every_point([](const ceres::Manifold& m, const Vector& x) {
    RowMajor J(m.AmbientSize(), m.TangentSize());
    ASSERT_TRUE(m.PlusJacobian(x.data(), J.data()));
    for (int i = 0; i < m.TangentSize(); ++i) {
      const Vector step = kDifference * Vector::Unit(m.TangentSize(), i);
      const Vector derivative = (plus(m, x, step) - plus(m, x, -step)) / (2 * kDifference);
      EXPECT_LT((J.col(i) - derivative).norm(), 1e-8) << i;
    }
  });
}

TEST(Manifolds, MinusJacobianIsTheDerivativeAlongTheManifold) {
  at_every_point([](const ceres::Manifold& m, const Vector& x) {
    RowMajor plus_J(m.AmbientSize(), m.TangentSize()), minus_J(m.TangentSize(), m.AmbientSize());
    ASSERT_TRUE(m.PlusJacobian(x.data(), plus_J.data()));
    ASSERT_TRUE(m.MinusJacobian(x.data(), minus_J.data()));
    EXPECT_LT((minus_J * plus_J - RowMajor::Identity(m.TangentSize(), m.TangentSize())).norm(),
              1e-12);
  });
}

TEST(Manifolds, MovedAxisIsAUnitVector) {
  const Eigen::Vector3d axis = Eigen::Vector3d(0.1, 0.2, 0.9).normalized();
  for (const double length : {1e-9, 0.1, 3.0}) {
    EXPECT_NEAR(axis_plus(axis, {length, -length / 3}).norm(), 1, 1e-15);
  }
}

}  // namespace
}  // namespace saker::slam
