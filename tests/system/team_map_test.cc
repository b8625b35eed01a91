#include "saker/team_map.h"

#include <gtest/gtest.h>

namespace saker::tools {
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

TEST(Surveyed, ErrsAsMuchAsItsCovarianceSays) {
  const TakeoffSurveyConfig config{.place_sd_m = 0.2, .heading_sd_deg = 3};
  SE3 T_base_world = SE3::Identity();
  T_base_world.translation() = Eigen::Vector3d(4, -2, 1);
  T_base_world.rotate(Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ()));
  constexpr int kTries = 2000;
  double nees = 0;
  for (int i = 0; i < kTries; ++i) {
    const slam::PosePrior prior = surveyed(T_base_world, config, core::Rng(7).fork(i));
    const Vector6d error = core::se3_log(prior.pose.inverse() * T_base_world);
    EXPECT_NEAR(error.head<2>().norm(), 0, 1e-9);
    nees += error.tail<4>().cwiseAbs2().cwiseQuotient(prior.covariance.diagonal().tail<4>()).sum();
  }
  EXPECT_NEAR(nees / (4 * kTries), 1, 0.1);
}

}  // namespace
}  // namespace saker::tools
