#include "saker/objects/models.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saker::objects {
namespace {

SE3 some_motion() { return core::se3_exp((Vector6d() << 0.3, -0.2, 1.4, 3, -2, 1).finished()); }

TEST(Models, CuboidMovesWithItsFrame) {
  const Cuboid cuboid{core::se3_exp((Vector6d() << 0, 0, 0.4, 5, 2, 0.7).finished()), {4, 2, 1.5}};
  const Cuboid moved = transformed(some_motion(), cuboid);
  const Eigen::Vector3d corner(2, -1, 0.75);
  EXPECT_TRUE((moved.pose * corner).isApprox(some_motion() * (cuboid.pose * corner), 1e-12));
  EXPECT_EQ(moved.size, cuboid.size);
  EXPECT_TRUE(place(Model(moved)).isApprox(some_motion() * place(Model(cuboid)), 1e-12));
}

TEST(Models, CylinderMovesWithItsFrame) {
  const Cylinder cylinder{{1, 2, 3}, Eigen::Vector3d(0.1, 0.2, 1).normalized(), 0.2, 4};
  const Cylinder moved = transformed(some_motion(), cylinder);
  const Eigen::Vector3d top = cylinder.root + cylinder.height * cylinder.axis;
  EXPECT_TRUE((moved.root + moved.height * moved.axis).isApprox(some_motion() * top, 1e-12));
  EXPECT_EQ(moved.radius, cylinder.radius);
}

TEST(Models, HeightAboveAPlaneDoesNotDependOnTheFrame) {
  const GroundPlane plane{Eigen::Vector3d(0.1, -0.1, 1).normalized(), {2, 3, 0.1}, 5};
  const Eigen::Vector3d p(4, 1, 2);
  EXPECT_NEAR(transformed(some_motion(), plane).height_of(some_motion() * p), plane.height_of(p),
              1e-12);
}

TEST(Models, TangentBasisIsOrthonormalAndNormalToTheAxis) {
  for (double lean = 0; lean < 1.5; lean += 0.1) {
    for (double turn = 0; turn < 6.3; turn += 0.3) {
      const Eigen::Vector3d axis(std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn),
                                 std::cos(lean));
      const Eigen::Matrix<double, 3, 2> basis = tangent_basis(axis);
      EXPECT_TRUE((basis.transpose() * basis).isIdentity(1e-12));
      EXPECT_LT((basis.transpose() * axis).norm(), 1e-12);
      EXPECT_GT(basis.col(0).cross(basis.col(1)).dot(axis), 0.99);
    }
  }
}

TEST(Models, TangentBasisIsSmoothAtTheVertical) {
  const Eigen::Matrix<double, 3, 2> up = tangent_basis(Eigen::Vector3d::UnitZ());
  for (double turn = 0; turn < 6.3; turn += 0.5) {
    const Eigen::Vector3d near =
        Eigen::Vector3d(1e-6 * std::cos(turn), 1e-6 * std::sin(turn), 1).normalized();
    EXPECT_LT((tangent_basis(near) - up).norm(), 3e-6);
  }
}

}  // namespace
}  // namespace saker::objects
