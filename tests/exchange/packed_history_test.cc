#include "saker/exchange/packed_history.h"

#include <gtest/gtest.h>

#include <cmath>

#include "made_measurement.h"

namespace saker::exchange {
namespace {

using objects::Cuboid;
using objects::Cylinder;
using objects::Measurement;

/// A flight around: a keyframe a second.
slam::History some_history(int entries, int measurements, std::uint64_t seed) {
  core::Rng rng(seed);
  slam::History history{"R1", 3, {}};
  SE3 T = SE3::Identity();
  for (int i = 0; i < entries; ++i) {
    slam::HistoryEntry entry;
    entry.stamp = from_seconds(1000 + i + rng.uniform(0, 0.1));
    T = T * core::se3_exp((Vector6d() << some_vector(rng, 0.3), some_vector(rng, 2)).finished());
    entry.T_odom_lidar = T;
    if (i > 0) entry.motion_covariance = 1e-4 * some_covariance(rng, 6);
    for (int k = 0; k < measurements; ++k) {
      entry.measurements.push_back(some_measurement(rng, entry.stamp, rng.chance(0.5)));
    }
    history.entries.push_back(entry);
  }
  return history;
}

slam::History there_and_back(const slam::History& history) {
  return unpacked(packed(history, kClasses)).value().history;
}

double angle(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return core::so3_log(a.transpose() * b).norm();
}

constexpr double kHundredthDegree = 1.7453e-4;
const double kHalfDiagonal = std::sqrt(3.0) / 2;  // of a cube of one step: the largest error

TEST(PackedHistory, PosesAreRightToAMillimetreHoweverLongTheFlight) {
  const slam::History before = some_history(2000, 0, 1), after = there_and_back(before);
  ASSERT_EQ(after.entries.size(), before.entries.size());
  EXPECT_EQ(after.robot, "R1");
  EXPECT_EQ(after.flight, 3u);
  for (std::size_t i = 0; i < before.entries.size(); ++i) {
    const SE3 &T = before.entries[i].T_odom_lidar, &U = after.entries[i].T_odom_lidar;
    EXPECT_LT((T.translation() - U.translation()).norm(), kHalfDiagonal * 1e-3 + 1e-9);
    EXPECT_LT(angle(T.rotation(), U.rotation()), 1.1 * kHalfDiagonal * kHundredthDegree);
    EXPECT_LT(std::abs(before.entries[i].stamp - after.entries[i].stamp), 1000);
  }
}

void expect_close(const Cuboid& a, const Cuboid& b) {
  EXPECT_LT((a.pose.translation() - b.pose.translation()).norm(), kHalfDiagonal * 1e-3 + 1e-9);
  EXPECT_LT(angle(a.pose.rotation(), b.pose.rotation()), 2 * kHundredthDegree);
  EXPECT_LT((a.size - b.size).cwiseAbs().maxCoeff(), 0.005 + 1e-9);
}

void expect_close(const Cylinder& a, const Cylinder& b) {
  EXPECT_LT((a.root - b.root).norm(), kHalfDiagonal * 1e-3 + 1e-9);
  EXPECT_LT((a.axis - b.axis).norm(), 1e-3);
  EXPECT_NEAR(a.radius, b.radius, 0.0005 + 1e-9);
  EXPECT_NEAR(a.height, b.height, 0.005 + 1e-9);
}

void expect_close(const Measurement& a, const Measurement& b) {
  ASSERT_EQ(a.model.index(), b.model.index());
  if (const auto* cuboid = std::get_if<Cuboid>(&a.model)) {
    expect_close(*cuboid, std::get<Cuboid>(b.model));
  } else {
    expect_close(std::get<Cylinder>(a.model), std::get<Cylinder>(b.model));
  }
  EXPECT_EQ(a.class_id, b.class_id);
  for (int c = 0; c < kClasses; ++c) {
    EXPECT_NEAR(a.class_probability[c], b.class_probability[c], 1.5 / 64);
  }
  EXPECT_NEAR(a.front_log_odds, b.front_log_odds, 1.0 / 16);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.view_cell, b.view_cell);
  EXPECT_EQ(a.moving, b.moving);
  EXPECT_EQ(std::isnan(a.reflectivity), std::isnan(b.reflectivity));
  if (!std::isnan(a.reflectivity)) {
    EXPECT_NEAR(a.reflectivity, b.reflectivity, 1.0 / 500);
  }
  EXPECT_EQ(std::isnan(a.length_sd), std::isnan(b.length_sd));
  if (!std::isnan(a.length_sd)) {
    EXPECT_NEAR(b.length_sd / a.length_sd, 1, 0.045);
  }
}

TEST(PackedHistory, MeasurementsAreRightToTheirSteps) {
  slam::History before = some_history(100, 4, 2);
  before.entries[7].measurements[1].moving = true;
  before.entries[8].measurements[2].stamp -= from_seconds(0.25);
  const slam::History after = there_and_back(before);
  for (std::size_t i = 0; i < before.entries.size(); ++i) {
    ASSERT_EQ(before.entries[i].measurements.size(), after.entries[i].measurements.size());
    for (std::size_t k = 0; k < before.entries[i].measurements.size(); ++k) {
      expect_close(before.entries[i].measurements[k], after.entries[i].measurements[k]);
    }
  }
  EXPECT_LT(
      std::abs(after.entries[8].measurements[2].stamp - before.entries[8].measurements[2].stamp),
      1000);
}

TEST(PackedHistory, AnEntryMoreOnlyAppendsBytes) {
  slam::History history = some_history(50, 3, 3);
  const std::string whole = packed(history, kClasses);
  while (!history.entries.empty()) {
    history.entries.pop_back();
    EXPECT_TRUE(whole.starts_with(packed(history, kClasses)));
  }
}

TEST(PackedHistory, SaysWhereTheFlightBeganIfAnybodyMeasuredIt) {
  const slam::History history = some_history(3, 1, 8);
  EXPECT_FALSE(unpacked(packed(history, kClasses))->takeoff);
  core::Rng rng(9);
  Vector6d pose, variances;
  pose << some_vector(rng, 1), some_vector(rng, 300);
  variances << 1e-4, 2e-4, 3e-4, 0.01, 0.02, 0.03;
  const slam::PosePrior takeoff{core::se3_exp(pose), variances.asDiagonal()};
  const auto found = unpacked(packed(history, kClasses, takeoff));
  ASSERT_TRUE(found && found->takeoff);
  EXPECT_TRUE(found->takeoff->pose.isApprox(takeoff.pose, 1e-6));
  EXPECT_TRUE(found->takeoff->covariance.isApprox(takeoff.covariance, 1e-6));
  EXPECT_EQ(found->history.entries.size(), 3U);
}

TEST(PackedHistory, ATakeOffThatIsNoneMakesTheHistoryNone) {
  slam::PosePrior takeoff{SE3::Identity(), Matrix6d::Identity()};
  takeoff.covariance(3, 3) = 0;
  EXPECT_FALSE(unpacked(packed(some_history(1, 0, 8), kClasses, takeoff)));
  takeoff.covariance(3, 3) = NAN;
  EXPECT_FALSE(unpacked(packed(some_history(1, 0, 8), kClasses, takeoff)));
}

TEST(PackedHistory, ACutEndCostsTheCutEntryOnly) {
  const slam::History history = some_history(5, 2, 4);
  const slam::PosePrior takeoff{SE3::Identity(), Matrix6d::Identity()};
  HistoryPacker packer("R1", 3, kClasses, takeoff);
  std::vector<std::size_t> ends = {packer.header().size()};
  for (const auto& entry : history.entries) ends.push_back(ends.back() + packer.pack(entry).size());
  const std::string whole = packed(history, kClasses, takeoff);
  ASSERT_EQ(whole.size(), ends.back());
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const auto found = unpacked(whole.substr(0, size));
    ASSERT_EQ(found.has_value(), size >= ends[0]) << size;
    if (!found) continue;
    const auto entries = static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), size) -
                                                  ends.begin() - 1);
    EXPECT_EQ(found->history.entries.size(), entries);
    EXPECT_EQ(found->bytes, ends[entries]);
  }
}

TEST(PackedHistory, WhatIsNotFiniteIsLeftOutAndCounted) {
  slam::History history = some_history(3, 4, 5);
  auto& measurements = history.entries[1].measurements;
  std::visit([](auto& model) { model = {}; }, measurements[0].model);  // NaN
  measurements[1].class_probability.pop_back();
  measurements[2].covariance(2, 2) = -1;
  HistoryPacker packer("R1", 3, kClasses);
  std::string bytes = packer.header();
  for (const auto& entry : history.entries) bytes += packer.pack(entry);
  EXPECT_EQ(packer.left_out(), 3);
  EXPECT_EQ(unpacked(bytes)->history.entries[1].measurements.size(), 1u);
  slam::HistoryEntry no_pose = history.entries[2];
  no_pose.stamp += 1'000'000;
  no_pose.T_odom_lidar.translation().x() = NAN;
  EXPECT_EQ(packer.pack(no_pose), "");
  EXPECT_EQ(packer.pack(history.entries[0]), "");  // older than the last one
}

TEST(PackedHistory, ChangedBytesNeverGiveWhatIsNotFinite) {
  const std::string whole = packed(some_history(20, 3, 6), kClasses);
  core::Rng rng(1);
  for (int round = 0; round < 20'000; ++round) {
    std::string bytes = whole.substr(0, 1 + rng.index(static_cast<int>(whole.size())));
    for (int i = 0; i <= rng.index(4); ++i) {
      bytes[rng.index(static_cast<int>(bytes.size()))] = static_cast<char>(rng.index(256));
    }
    const auto found = unpacked(bytes);
    if (!found) continue;
    ASSERT_LE(found->bytes, bytes.size());
    for (const auto& entry : found->history.entries) {
      ASSERT_TRUE(entry.T_odom_lidar.matrix().allFinite());
      for (const Measurement& m : entry.measurements) {
        ASSERT_TRUE(m.covariance.allFinite());
        ASSERT_TRUE(objects::place(m.model).allFinite());
        ASSERT_LT(m.class_id, m.class_probability.size());
      }
    }
  }
}

/// The bar: ten minutes, a keyframe a second, in 200 kB; four objects in each, with
/// correlations everywhere, as never occur.
TEST(PackedHistory, TenMinutesFitInto200Kilobytes) {
  EXPECT_LT(packed(some_history(600, 4, 7), kClasses).size(), 200'000u);
}

}  // namespace
}  // namespace saker::exchange
