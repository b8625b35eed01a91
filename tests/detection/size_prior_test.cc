#include "saker/detection/size_prior.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "saker/core/error.h"

namespace saker::detection {
namespace {

constexpr double kHighest = 2.6;  // m

const VehicleKinds kKinds = vehicle_kinds({});

std::string likeliest(double top) {
  return std::ranges::max_element(kKinds, {},
                                  [&](const VehicleKind& kind) {
                                    return log_likelihood_of_top(top, kind, kHighest, 0.06);
                                  })
      ->name;
}

TEST(SizePrior, WeightsAreThoseOfAllVehicles) {
  double sum = 0;
  for (const VehicleKind& kind : kKinds) sum += kind.weight;
  EXPECT_NEAR(sum, 1, 1e-9);
}

objects::ClassTable with_bins() {
  objects::ClassTable table;
  objects::ObjectClass& bin = table.classes.emplace_back();
  bin.name = "bin";
  bin.shape = objects::Shape::cuboid;
  return table;
}

TEST(SizePrior, KindsAreThoseOfTheCuboidClasses) {
  objects::ClassTable table = with_bins();
  EXPECT_EQ(vehicle_kinds(table).size(), kKinds.size());
  table.classes.back().kinds = {
      {.name = "wheeled", .length_m = {1.2, 0.1}, .width_m = {0.9, 0.1}, .height_m = {1.1, 0.1}}};
  ASSERT_EQ(vehicle_kinds(table).size(), kKinds.size() + 1);
  EXPECT_EQ(vehicle_kinds(table).back().plan[0].mean, 1.2);
  table.classes = {table.classes[0], table.classes.back()};
  EXPECT_EQ(vehicle_kinds(table).size(), 1u);
  table.classes.back().kinds.clear();
  EXPECT_EQ(vehicle_kinds(table).size(), kKinds.size());
}

TEST(SizePrior, AKindWithoutADeviationIsRefused) {
  objects::ClassTable table = with_bins();
  table.classes.back().kinds = {
      {.name = "wheeled", .length_m = {1.2}, .width_m = {0.9, 0.1}, .height_m = {1.1, 0.1}}};
  EXPECT_THROW((void)vehicle_kinds(table), Error);
}

/// Length to be expected of a vehicle of which only width and height are known, m.
double expected_length(double width, double height) {
  double sum = 0, weights = 0;
  for (const VehicleKind& kind : kKinds) {
    if (!kind.one_vehicle) continue;
    const double off = (width - kind.plan[1].mean) / kind.plan[1].sd;
    const double weight = kind.weight * std::exp(-0.5 * off * off) / kind.plan[1].sd *
                          std::exp(log_likelihood_of_top(height, kind, kHighest, 0.06));
    sum += weight * kind.plan[0].mean;
    weights += weight;
  }
  return sum / weights;
}

TEST(SizePrior, WidthAndHeightTellLengths) {
  constexpr double kSpread = 0.2;  // m, of lengths within a segment
  EXPECT_NEAR(expected_length(1.63, 1.49), 3.57, kSpread) << "Fiat 500";
  EXPECT_NEAR(expected_length(1.80, 1.48), 4.28, kSpread) << "VW Golf";
}

TEST(SizePrior, TopTellsTheKind) {
  EXPECT_EQ(likeliest(1.7), "suv");
  EXPECT_EQ(likeliest(2.1), "van");
  EXPECT_NE(likeliest(2.6), "van");
}

TEST(SizePrior, AHigherVehicleReachesToWherePointsEnd) {
  EXPECT_TRUE(likeliest(kHighest) == "truck" || likeliest(kHighest) == "bus");
}

TEST(SizePrior, WhatIsAsLongAsATruckAndNoHigherThanACarIsTwoCars) {
  const auto odds = [](double length, double top) {
    double two = 0, one = 0;
    for (const VehicleKind& kind : kKinds) {
      const double z = (length - kind.plan[0].mean) / kind.plan[0].sd;
      const double likelihood =
          kind.weight * std::exp(log_likelihood_of_top(top, kind, kHighest, 0.06) - 0.5 * z * z) /
          kind.plan[0].sd;
      (kind.one_vehicle ? one : two) += likelihood;
    }
    return two / one;
  };
  EXPECT_GT(odds(7.5, 1.6), 5);
  EXPECT_LT(odds(7.5, 2.6), 0.01);
  EXPECT_LT(odds(5.5, 2.0), 0.05);
  EXPECT_LT(odds(4.8, 1.5), 0.05);
}

TEST(SizePrior, NoKindIsAsWideAsTwoVehiclesUnlessThatIsDoubtful) {
  EXPECT_TRUE(is_of_some_kind({{{4.5, 0.2}, {1.8, 0.1}}}, 4, kKinds));
  EXPECT_TRUE(is_of_some_kind({{{11.5, 0.2}, {2.5, 0.1}}}, 4, kKinds));
  EXPECT_FALSE(is_of_some_kind({{{4.5, 0.2}, {3.5, 0.1}}}, 4, kKinds));
  EXPECT_TRUE(is_of_some_kind({{{4.5, 0.2}, {3.5, 0.5}}}, 4, kKinds));
}

TEST(SizePrior, AHiddenTopExcludesNoHigherKind) {
  const auto van = std::ranges::find(kKinds, "van", &VehicleKind::name);
  const auto car = std::ranges::find(kKinds, "medium car", &VehicleKind::name);
  const auto odds = [&](double top) {
    return log_likelihood_of_top(top, *van, kHighest, 0.06) -
           log_likelihood_of_top(top, *car, kHighest, 0.06);
  };
  EXPECT_LT(odds(1.45), -3);
  EXPECT_NEAR(odds(0.9), 0, 1);
}

}  // namespace
}  // namespace saker::detection
