#include "saker/objects/consistency.h"

#include <gtest/gtest.h>

#include <numbers>

#include "saker/core/rng.h"

namespace saker::objects {
namespace {

constexpr ClassId kVehicle = 1, kTrunk = 2;
const ClassTable kTable;

MapObject car(int id, double x, double y, double yaw = 0) {
  MapObject object;
  object.id = id;
  object.class_id = kVehicle;
  Cuboid cuboid{core::se3_exp((Vector6d() << 0, 0, yaw, 0, 0, 0).finished()), {4.4, 1.8, 1.5}};
  cuboid.pose.translation() = Eigen::Vector3d(x, y, 0.75);
  object.model = cuboid;
  object.covariance = Matrix9d(0.01 * Matrix9d::Identity());
  return object;
}

MapObject trunk(int id, double x, double y) {
  MapObject object;
  object.id = id;
  object.class_id = kTrunk;
  object.model = Cylinder{{x, y, 0}, Eigen::Vector3d::UnitZ(), 0.15, 3};
  object.covariance = Matrix6d(0.0025 * Matrix6d::Identity());
  return object;
}

void shift(MapObject& object, const Eigen::Vector2d& by) {
  if (auto* cuboid = std::get_if<Cuboid>(&object.model)) {
    cuboid->pose.translation().head<2>() += by;
  } else {
    std::get<Cylinder>(object.model).root.head<2>() += by;
  }
}

std::vector<ObjectConsistency> judged(const ObjectMap& mapped, const ObjectMap& truth) {
  return consistency(mapped, truth, compare(mapped, truth, kTable, {}));
}

Eigen::Vector2d normal(core::Rng& rng, double sd_x, double sd_y) {
  return {rng.normal(0, sd_x), rng.normal(0, sd_y)};
}

/// The error that a car's covariance speaks of: along and across its own axes, and of its size.
void disturb(MapObject& object, core::Rng& rng) {
  if (auto* cuboid = std::get_if<Cuboid>(&object.model)) {
    const Eigen::Vector2d own = normal(rng, 0.2, 0.05);
    cuboid->pose.translation() += cuboid->pose.linear() * Eigen::Vector3d(own.x(), own.y(), 0);
    cuboid->size.head<2>() += normal(rng, 0.3, 0.1);
    object.covariance.diagonal().segment<2>(3) << 0.04, 0.0025;
    object.covariance.diagonal().segment<2>(6) << 0.09, 0.01;
  } else {
    shift(object, normal(rng, 0.05, 0.05));
    std::get<Cylinder>(object.model).radius += rng.normal(0, 0.05);
  }
}

/// A street of cars and trunks whose map has the errors that it says.
std::vector<ObjectConsistency> made_street(core::Rng& rng, double variance_scale) {
  ObjectMap truth, mapped;
  for (int i = 0; i < 12; ++i) {
    truth.objects.push_back(car(2 * i, 9.0 * i, 6, rng.uniform(-3, 3)));
    truth.objects.push_back(trunk(2 * i + 1, 9.0 * i + 4, -6));
  }
  for (MapObject object : truth.objects) {
    disturb(object, rng);
    object.covariance *= variance_scale;
    mapped.objects.push_back(object);
  }
  return judged(mapped, truth);
}

ConsistencyFigures over_many(double variance_scale, ClassId id) {
  core::Rng rng(5);
  std::vector<ObjectConsistency> all;
  for (int i = 0; i < 200; ++i) {
    const auto street = made_street(rng, variance_scale);
    all.insert(all.end(), street.begin(), street.end());
  }
  return mean_consistency(all, id);
}

TEST(Consistency, IsOneWhereErrorsAreAsTheCovarianceSays) {
  const ConsistencyFigures vehicles = over_many(1, kVehicle), trunks = over_many(1, kTrunk);
  EXPECT_EQ(vehicles.objects, 2400);
  EXPECT_NEAR(vehicles.size, 1, 0.06);
  EXPECT_NEAR(vehicles.place, 1, 0.06);
  EXPECT_NEAR(trunks.size, 1, 0.09);
  EXPECT_NEAR(trunks.place, 1, 0.06);
}

TEST(Consistency, IsFourWhereTheMapIsTwiceAsSureAsItIsGood) {
  EXPECT_NEAR(over_many(0.25, kVehicle).size, 4, 0.2);
  EXPECT_NEAR(over_many(0.25, kVehicle).place, 4, 0.2);
}

TEST(Consistency, TheCovarianceOfACarIsAlongItsOwnAxes) {
  ObjectMap truth{"world", {car(0, 0, 0, std::numbers::pi / 2)}, {}};
  ObjectMap mapped = truth;
  mapped.objects[0].covariance.diagonal().segment<2>(3) << 0.25, 1e-4;
  shift(mapped.objects[0], {0, 0.5});
  EXPECT_NEAR(judged(mapped, truth)[0].place, 0.5, 0.01) << "one sd along the car";
  EXPECT_NEAR(judged(mapped, truth)[0].size, 0, 1e-9);
}

TEST(Consistency, CorrelationOfLengthAndWidthCounts) {
  ObjectMap truth{"world", {car(0, 0, 0)}, {}};
  ObjectMap mapped = truth;
  mapped.objects[0].covariance.block<2, 2>(6, 6) << 0.01, 0.008, 0.008, 0.01;
  std::get<Cuboid>(mapped.objects[0].model).size += Eigen::Vector3d(0.1, -0.1, 0);
  // Against the correlation: eᵀ P⁻¹ e = 0.02 / (0.01 − 0.008).
  EXPECT_NEAR(judged(mapped, truth)[0].size, 5, 1e-9);
}

TEST(Consistency, IsUnknownWithoutACovariance) {
  ObjectMap truth{"world", {car(0, 0, 0), trunk(1, 20, 0)}, {}};
  ObjectMap mapped = truth;
  mapped.objects[1].covariance.resize(0, 0);
  const auto all = judged(mapped, truth);
  EXPECT_EQ(all[0].size, 0);
  EXPECT_EQ(all[0].place, 0);
  EXPECT_TRUE(std::isnan(all[1].size));
  EXPECT_TRUE(std::isnan(all[1].place));
  EXPECT_EQ(mean_consistency(all, kTrunk).objects, 0);
}

}  // namespace
}  // namespace saker::objects
