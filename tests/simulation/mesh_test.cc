#include "saker/simulation/world/mesh.h"

#include <gtest/gtest.h>

#include <numbers>

#include "drawn.h"

namespace saker::simulation {
namespace {

constexpr double kPi = std::numbers::pi;

Mesh boxed(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Mesh mesh;
  Pen(mesh).box(low, high, 0);
  return mesh;
}

TEST(Pen, ABoxIsClosedAndHasTheAreaOfItsSixFaces) {
  core::Rng rng(3);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d low(rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(-5, 5));
    const Eigen::Vector3d size(rng.uniform(0.1, 4), rng.uniform(0.1, 4), rng.uniform(0.1, 4));
    const Mesh mesh = boxed(low, low + size);
    EXPECT_EQ(open_edges(mesh), 0);
    EXPECT_NEAR(area_of(mesh),
                2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x()), 1e-3);
  }
}

TEST(Pen, ABoxReachesFromOneCornerToTheOther) {
  const Eigen::AlignedBox3d box = box_of(boxed({-1, 2, 3}, {4, 5, 7}));
  EXPECT_TRUE(box.min().isApprox(Eigen::Vector3d(-1, 2, 3)));
  EXPECT_TRUE(box.max().isApprox(Eigen::Vector3d(4, 5, 7)));
}

TEST(Pen, EachTriangleHasItsMaterialAndItsObject) {
  Mesh mesh;
  Pen first(mesh, SE3::Identity(), 4);
  Pen second(mesh, SE3::Identity(), 9);
  first.box({0, 0, 0}, {1, 1, 1}, 2);
  second.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 5);
  ASSERT_EQ(mesh.triangles.size(), 13U);
  ASSERT_EQ(mesh.materials.size(), 13U);
  ASSERT_EQ(mesh.objects.size(), 13U);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(mesh.materials[i], 2);
    EXPECT_EQ(mesh.objects[i], 4);
  }
  EXPECT_EQ(mesh.materials[12], 5);
  EXPECT_EQ(mesh.objects[12], 9);
}

TEST(Pen, AQuadIsTwoTrianglesOverOneDiagonal) {
  Mesh mesh;
  Pen(mesh).quad({0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, 0);
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_NEAR(area_of(mesh), 6, 1e-6);
  EXPECT_EQ(open_edges(mesh), 4);
}

TEST(Pen, APolygonIsCutIntoTwoTrianglesLessThanItsCorners) {
  for (int corners = 3; corners < 12; ++corners) {
    std::vector<Eigen::Vector3d> ring;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * kPi * i / corners;
      ring.emplace_back(std::cos(angle), std::sin(angle), 1);
    }
    Mesh mesh;
    Pen(mesh).polygon(ring, 0);
    EXPECT_EQ(mesh.triangles.size(), static_cast<std::size_t>(corners - 2));
    EXPECT_NEAR(area_of(mesh), 0.5 * corners * std::sin(2 * kPi / corners), 1e-5);
    EXPECT_EQ(open_edges(mesh), corners);
  }
}

TEST(Pen, ACappedTubeIsClosed) {
  Mesh mesh;
  Pen(mesh).tube({{0, 0, 0}, {0, 0.2, 1}, {0.5, 0.2, 2}}, {0.3, 0.2, 0.1}, 9, 0);
  EXPECT_EQ(open_edges(mesh), 0);
}

TEST(Pen, ATubeWithoutCapsIsOpenAtBothEnds) {
  Mesh mesh;
  Pen(mesh).tube({{0, 0, 0}, {0, 0, 2}}, {0.3, 0.3}, 7, 0, false);
  EXPECT_EQ(open_edges(mesh), 2 * 7);
}

TEST(Pen, EachRingOfATubeHasTheRadiusOfItsPoint) {
  const std::vector<double> radii{0.5, 0.2, 0.35};
  Mesh mesh;
  Pen(mesh).tube({{0, 0, 0}, {0, 0, 1}, {0, 0, 3}}, radii, 16, 0);
  std::map<double, double> widest;
  for (const Eigen::Vector3f& p : mesh.vertices) {
    double& radius = widest[std::round(p.z())];
    radius = std::max(radius, static_cast<double>(p.head<2>().norm()));
  }
  ASSERT_EQ(widest.size(), 3U);
  EXPECT_NEAR(widest[0], 0.5, 1e-6);
  EXPECT_NEAR(widest[1], 0.2, 1e-6);
  EXPECT_NEAR(widest[3], 0.35, 1e-6);
}

TEST(Pen, ATubesAreaTendsToThatOfACylinder) {
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(3, 0, 0), Eigen::Vector3d(0, 3, 0),
                                      Eigen::Vector3d(0, 0, 3), Eigen::Vector3d(2, 2, 1)}) {
    Mesh mesh;
    Pen(mesh).tube({Eigen::Vector3d::Zero(), axis}, {0.4, 0.4}, 96, 0);
    EXPECT_NEAR(area_of(mesh), 2 * kPi * 0.4 * 3 + 2 * kPi * 0.4 * 0.4, 0.01);
  }
}

TEST(Pen, APostStandsUprightOnItsOrigin) {
  Mesh mesh;
  Pen(mesh).at(3, 4, 5).post(0.1, 2.5, 0, 12);
  const Eigen::AlignedBox3d box = box_of(mesh);
  EXPECT_NEAR(box.min().z(), 5, 1e-6);
  EXPECT_NEAR(box.max().z(), 7.5, 1e-6);
  EXPECT_NEAR(box.center().x(), 3, 1e-5);
  EXPECT_NEAR(box.center().y(), 4, 1e-5);
  EXPECT_NEAR(box.sizes().x(), 0.2, 1e-5);
}

TEST(Pen, EveryVertexOfAnEllipsoidLiesOnIt) {
  const Eigen::Vector3d centre(1, -2, 3), radii(0.5, 1.5, 0.8);
  Mesh mesh;
  Pen(mesh).ellipsoid(centre, radii, 0);
  EXPECT_EQ(open_edges(mesh), 0);
  for (const Eigen::Vector3f& p : mesh.vertices) {
    const Eigen::Vector3d unit = (p.cast<double>() - centre).cwiseQuotient(radii);
    EXPECT_NEAR(unit.norm(), 1, 1e-5);
  }
}

TEST(Pen, FramesWithinFramesCompose) {
  const SE3 T_mesh_pen = placed(1, 2, 3, 0.7), T_pen_child = placed(-2, 0.5, 0.1, -0.3);
  Mesh nested, direct;
  Pen(nested, T_mesh_pen, 3).at(T_pen_child).box({0, 0, 0}, {1, 2, 3}, 1);
  Pen(direct, T_mesh_pen * T_pen_child, 3).box({0, 0, 0}, {1, 2, 3}, 1);
  ASSERT_EQ(nested.vertices.size(), direct.vertices.size());
  for (std::size_t i = 0; i < nested.vertices.size(); ++i)
    EXPECT_LT((nested.vertices[i] - direct.vertices[i]).norm(), 1e-6F);
  EXPECT_EQ(nested.objects, direct.objects);
}

TEST(Pen, WhatIsDrawnDoesNotChangeWithTheFrameButForTheMotion) {
  const SE3 T = placed(5, -3, 1, 1.1);
  Mesh plain, moved;
  Pen(plain).tube({{0, 0, 0}, {1, 0, 1}}, {0.2, 0.1}, 6, 0);
  Pen(moved, T).tube({{0, 0, 0}, {1, 0, 1}}, {0.2, 0.1}, 6, 0);
  ASSERT_EQ(plain.vertices.size(), moved.vertices.size());
  for (std::size_t i = 0; i < plain.vertices.size(); ++i) {
    const Eigen::Vector3d expected = T * plain.vertices[i].cast<double>();
    EXPECT_LT((moved.vertices[i].cast<double>() - expected).norm(), 1e-5);
  }
}

TEST(Placed, TurnsAboutTheVerticalAndThenMoves) {
  const Eigen::Vector3d p = placed(10, 20, 30, kPi / 2) * Eigen::Vector3d(1, 0, 0);
  EXPECT_LT((p - Eigen::Vector3d(10, 21, 30)).norm(), 1e-12);
  EXPECT_NEAR(core::yaw(placed(0, 0, 0, -0.4).linear()), -0.4, 1e-12);
}

}  // namespace
}  // namespace saker::simulation
