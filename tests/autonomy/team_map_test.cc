#include "saker/autonomy/team_map.h"

#include <gtest/gtest.h>

#include <numbers>

namespace saker::autonomy {
namespace {

const objects::ClassTable kTable;
const Lot kEverything({});

objects::MapObject car(int id, double x, double y, double size_sd = NAN) {
  objects::MapObject object;
  object.id = id;
  object.class_id = kTable.find("vehicle");
  objects::Cuboid cuboid;
  cuboid.pose.translation() = Eigen::Vector3d(x, y, 0.7);
  cuboid.size = {4.4, 1.8, 1.5};
  object.model = cuboid;
  if (!std::isnan(size_sd)) {
    object.covariance = size_sd * size_sd * Eigen::MatrixXd::Identity(9, 9);
  }
  return object;
}

std::vector<int> ids(const objects::ObjectMap& map) {
  std::vector<int> list;
  for (const objects::MapObject& object : map.objects) list.push_back(object.id);
  return list;
}

TEST(InFrame, CornersTurnAndMoveWithTheFrame) {
  SE3 T_world_base = SE3::Identity();
  T_world_base.linear() =
      Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T_world_base.translation() = Eigen::Vector3d(10, 0, 2);
  const std::vector<double> seen = in_frame(T_world_base, {1, 0, 1, 3});
  ASSERT_EQ(seen.size(), 4U);
  EXPECT_NEAR(seen[0], 10, 1e-9);
  EXPECT_NEAR(seen[1], 1, 1e-9);
  EXPECT_NEAR(seen[2], 7, 1e-9);
  EXPECT_NEAR(seen[3], 1, 1e-9);
}

TEST(NextPrior, HasWhatRobotsMappedInThePlaceOfWhatWasSaid) {
  const objects::ObjectMap said{
      .frame = "base", .objects = {car(3, 0, 0), car(8, 20, 0)}, .ground = {}};
  const objects::ObjectMap mapped{.frame = "base", .objects = {car(0, 1, 0.5, 0.02)}, .ground = {}};
  const objects::ObjectMap prior = next_prior(said, mapped, kEverything, 3, kTable);
  EXPECT_EQ(ids(prior), (std::vector<int>{3, 8}));
  EXPECT_DOUBLE_EQ(objects::place(prior.objects[0].model).x(), 1);
  EXPECT_EQ(prior.objects[0].covariance.rows(), 9);
  EXPECT_EQ(prior.objects[1].covariance.size(), 0);
}

TEST(NextPrior, TakesInWhatNobodyHadSaidUnderAnIdOfItsOwn) {
  const objects::ObjectMap said{.frame = "base", .objects = {car(3, 0, 0)}, .ground = {}};
  const objects::ObjectMap mapped{.frame = "base", .objects = {car(3, 30, 0, 0.1)}, .ground = {}};
  EXPECT_EQ(ids(next_prior(said, mapped, kEverything, 3, kTable)), (std::vector<int>{3, 4}));
}

TEST(NextPrior, EndsWhereTheLotEnds) {
  const Lot lot({-5, -5, 5, -5, 5, 5, -5, 5});
  const objects::ObjectMap said{
      .frame = "base", .objects = {car(1, 0, 0), car(2, 20, 0)}, .ground = {}};
  const objects::ObjectMap mapped{.frame = "base", .objects = {car(0, 20.5, 0, 0.1)}, .ground = {}};
  EXPECT_EQ(ids(next_prior(said, mapped, lot, 3, kTable)), (std::vector<int>{1}));
}

TEST(NextPrior, LeavesATargetInTheLotInWhichItWasSaidToBe) {
  const Lot west({-9, -5, 0, -5, 0, 5, -9, 5}), east({0, -5, 9, -5, 9, 5, 0, 5});
  const objects::ObjectMap said{.frame = "base", .objects = {car(1, 0.5, 0)}, .ground = {}};
  const objects::ObjectMap mapped{.frame = "base", .objects = {car(0, -0.5, 0, 0.1)}, .ground = {}};
  EXPECT_TRUE(next_prior(said, mapped, west, 3, kTable).objects.empty());
  EXPECT_EQ(ids(next_prior(said, mapped, east, 3, kTable)), (std::vector<int>{1}));
}

}  // namespace
}  // namespace saker::autonomy
