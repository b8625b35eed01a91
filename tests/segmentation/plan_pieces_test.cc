#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "saker/segmentation/pieces.h"
#include "segmentation/drawn_picture.h"

namespace saker::segmentation {
namespace {

using PieceList = std::vector<std::vector<std::int32_t>>;

struct Plan : testing::Picture {
  PlanPieces pieces;
  std::vector<std::uint8_t> member = std::vector<std::uint8_t>(image.range.size(), 0);

  std::size_t add(float azimuth, float distance, float width, float height) {
    const auto drawn = draw(azimuth, distance, width, height);
    for (const std::size_t i : drawn) member[i] = 1;
    return drawn.size();
  }
  PieceList found() {
    PieceList list;
    pieces.for_each(image, up, member, [&](const auto& piece) { list.push_back(piece); });
    return list;
  }
};

TEST(PlanPieces, ThatStandApartAreTwo) {
  Plan plan;
  const std::size_t left = plan.add(0.5F, 10, 2, 1.5F), right = plan.add(1.0F, 10, 2, 1.5F);
  const PieceList found = plan.found();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].size() + found[1].size(), left + right);
  EXPECT_EQ(std::max(found[0].size(), found[1].size()), std::max(left, right));
}

TEST(PlanPieces, WhatHidesTheMiddleOfOneDoesNotPartIt) {
  Plan plan;
  plan.add(0.5F, 10, 4, 1.5F);
  for (int row = 0; row < testing::kRows; ++row) {
    const int middle = static_cast<int>(0.5F / testing::kPitch);
    for (int column = middle - 4; column < middle + 4; ++column)
      plan.member[static_cast<std::size_t>(row) * testing::kColumns + column] = 0;
  }
  EXPECT_EQ(plan.found().size(), 1U);
}

TEST(PlanPieces, AreTheSameForATiltedSensor) {
  Plan level, tilted;
  for (Plan* plan : {&level, &tilted}) plan->add(0.5F, 10, 2, 1.5F), plan->add(1.2F, 8, 2, 1.5F);
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(0.4F, Eigen::Vector3f(0.6F, 0.8F, 0)).toRotationMatrix();
  for (Eigen::Vector3f& point : tilted.image.points) point = turn * point;
  tilted.up = turn * tilted.up;
  EXPECT_EQ(level.found().size(), tilted.found().size());
}

TEST(PlanPieces, LeaveNoMemberAndTakeNoneTwice) {
  Plan plan;
  const std::size_t drawn = plan.add(0.5F, 10, 4, 1.5F);
  EXPECT_EQ(plan.found().front().size(), drawn);
  EXPECT_EQ(std::ranges::count(plan.member, 1), 0);
  EXPECT_TRUE(plan.found().empty());
}

TEST(PlanPieces, BeyondTheirReachAreNone) {
  Plan plan;
  plan.add(0.5F, PlanPieces::kReach_m + 30, 4, 1.5F);
  EXPECT_TRUE(plan.found().empty());
}

}  // namespace
}  // namespace saker::segmentation
