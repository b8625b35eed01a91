#include "saker/exchange/packed_measurement.h"

#include <gtest/gtest.h>

#include <numeric>

#include "made_measurement.h"

namespace saker::exchange {
namespace {

using objects::Cuboid;
using objects::Cylinder;
using objects::Measurement;

constexpr Time kStamp = 5'000'000'000;

std::optional<Measurement> there_and_back(const Measurement& measurement) {
  Statistics writers, readers;
  CodedWriter out(writers);
  pack(measurement, kStamp, out);
  const std::string bytes = out.finish();
  CodedReader in(bytes, readers);
  auto back = unpacked_measurement(kStamp, kClasses, in);
  EXPECT_TRUE(!back || in.done());
  return back;
}

Measurement vehicle(std::uint64_t seed = 1) {
  core::Rng rng(seed);
  return some_measurement(rng, kStamp, true);
}

Measurement trunk(std::uint64_t seed = 1) {
  core::Rng rng(seed);
  return some_measurement(rng, kStamp, false);
}

/// Whether it can be packed once `spoil` has changed it.
template <class Spoil>
bool packable_with(Measurement measurement, Spoil spoil) {
  spoil(measurement);
  return packable(measurement, kClasses);
}

TEST(PackedMeasurement, OfWhatIsPackedAlreadyNothingIsLost) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Measurement once = there_and_back(seed % 2 == 0 ? vehicle(seed) : trunk(seed)).value();
    const Measurement twice = there_and_back(once).value();
    EXPECT_LT((objects::place(twice.model) - objects::place(once.model)).norm(), 1e-9) << seed;
    EXPECT_NEAR(twice.front_log_odds, once.front_log_odds, 1e-9) << seed;
    EXPECT_EQ(twice.points, once.points) << seed;
    EXPECT_EQ(twice.stamp, once.stamp) << seed;
  }
}

TEST(PackedMeasurement, ProbabilitiesSumToOne) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const std::vector<double> p = there_and_back(vehicle(seed)).value().class_probability;
    ASSERT_EQ(p.size(), static_cast<std::size_t>(kClasses));
    EXPECT_NEAR(std::accumulate(p.begin(), p.end(), 0.0), 1, 1e-12) << seed;
  }
}

TEST(PackedMeasurement, WhatIsUnknownStaysUnknown) {
  Measurement bare = vehicle();
  bare.covariance.resize(0, 0);
  bare.length_sd = bare.reflectivity = NAN;
  bare.view_cell = -1;
  const Measurement back = there_and_back(bare).value();
  EXPECT_EQ(back.covariance.size(), 0);
  EXPECT_TRUE(std::isnan(back.length_sd) && std::isnan(back.reflectivity));
  EXPECT_EQ(back.view_cell, -1);
}

TEST(PackedMeasurement, OfAnotherTimeThanItsEntryKeepsIt) {
  Measurement late = trunk();
  late.stamp += 123'456'789;
  EXPECT_EQ(there_and_back(late).value().stamp, to_step(late.stamp));
  late.stamp = kStamp - 1;
  EXPECT_EQ(there_and_back(late).value().stamp, kStamp - kStampStep);
}

TEST(PackedMeasurement, StepsOfTimeAreRoundedDownOnBothSidesOfZero) {
  EXPECT_EQ(to_step(1999), 1000);
  EXPECT_EQ(to_step(1000), 1000);
  EXPECT_EQ(to_step(-1), -1000);
  EXPECT_EQ(to_step(-1000), -1000);
}

TEST(PackedMeasurement, WhatIsNotFiniteOrTooFarCannotBePacked) {
  EXPECT_TRUE(packable(vehicle(), kClasses));
  EXPECT_TRUE(packable(trunk(), kClasses));
  const auto cuboid = [](Measurement& m) -> Cuboid& { return std::get<Cuboid>(m.model); };
  const auto cylinder = [](Measurement& m) -> Cylinder& { return std::get<Cylinder>(m.model); };
  EXPECT_FALSE(packable_with(vehicle(), [&](auto& m) { cuboid(m).size.x() = NAN; }));
  EXPECT_FALSE(packable_with(vehicle(), [&](auto& m) { cuboid(m).size.y() = -1; }));
  EXPECT_FALSE(packable_with(vehicle(), [&](auto& m) { cuboid(m).pose.translation().x() = 2e5; }));
  EXPECT_FALSE(packable_with(trunk(), [&](auto& m) { cylinder(m).axis *= 2; }));
  EXPECT_FALSE(packable_with(trunk(), [&](auto& m) { cylinder(m).root.z() = INFINITY; }));
  EXPECT_FALSE(packable_with(trunk(), [&](auto& m) { cylinder(m).radius = NAN; }));
}

TEST(PackedMeasurement, WhatDoesNotFitItsClassesOrCovarianceCannotBePacked) {
  EXPECT_FALSE(packable(vehicle(), kClasses + 1));
  EXPECT_FALSE(packable_with(vehicle(), [](auto& m) { m.class_id = kClasses; }));
  EXPECT_FALSE(packable_with(vehicle(), [](auto& m) { m.class_probability[2] = 1.5; }));
  EXPECT_FALSE(packable_with(vehicle(), [](auto& m) { m.class_probability[m.class_id] = 0; }));
  EXPECT_FALSE(packable_with(vehicle(), [](auto& m) { m.covariance.resize(6, 6); }));
  EXPECT_FALSE(packable_with(vehicle(), [](auto& m) { m.covariance(3, 3) = NAN; }));
  EXPECT_FALSE(packable_with(vehicle(), [](auto& m) { m.points = -1; }));
}

TEST(PackedMeasurement, AnyBytesGiveAWholeMeasurementOrNone) {
  core::Rng rng(3);
  int whole = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes(60, '\0');
    for (char& byte : bytes) byte = static_cast<char>(rng.index(256));
    Statistics statistics;
    CodedReader in(bytes, statistics);
    const auto measurement = unpacked_measurement(kStamp, kClasses, in);
    if (!measurement) continue;
    ++whole;
    EXPECT_LT(measurement->class_id, kClasses);
    EXPECT_TRUE(objects::place(measurement->model).allFinite());
    EXPECT_TRUE(measurement->covariance.allFinite());
  }
  EXPECT_LT(whole, 3000);
}

TEST(UnpackedSteps, BeyondTheirMostAreNone) {
  Statistics writers, readers;
  CodedWriter out(writers);
  pack_steps(Eigen::Vector3d(1, -2, 3), kPlaceStep, out);
  pack_steps(Eigen::Vector3d(1, -2, 3.1), kPlaceStep, out);
  const std::string bytes = out.finish();
  CodedReader in(bytes, readers);
  const auto fits = unpacked_steps(kPlaceStep, 3, in);
  ASSERT_TRUE(fits.has_value());
  EXPECT_LT((*fits - Eigen::Vector3d(1, -2, 3)).norm(), 1e-9);
  EXPECT_FALSE(unpacked_steps(kPlaceStep, 3, in).has_value());
}

}  // namespace
}  // namespace saker::exchange
