#include "detection/footprint.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/rng.h"
#include "detection/edges.h"

namespace saker::detection {
namespace {

using Places = std::vector<Eigen::Vector2d>;

constexpr double kLength = 4.5, kWidth = 1.8;
constexpr std::array<double, 2> kBonnetAhead = {1.2, 0.75};  // m, of the low and the high end

/// The outline of a box about the origin with its length along `yaw`.
Places outline(double yaw) {
  const Eigen::Rotation2Dd turn(yaw);
  Places places;
  const auto add = [&](double x, double y) { places.emplace_back(turn * Eigen::Vector2d(x, y)); };
  for (double x = -kLength / 2; x <= kLength / 2; x += 0.05) {
    add(x, -kWidth / 2);
    add(x, kWidth / 2);
  }
  for (double y = -kWidth / 2; y <= kWidth / 2; y += 0.05) {
    add(-kLength / 2, y);
    add(kLength / 2, y);
  }
  return places;
}

/// Wing mirrors: 0.15 m out of both sides, 0.15 m long.
Places with_mirrors(Places places, double yaw) {
  const Eigen::Rotation2Dd turn(yaw);
  for (const double side : {-1.0, 1.0}) {
    for (double x = 0.8; x <= 0.95; x += 0.05) {
      for (double out = 0.05; out <= 0.15; out += 0.05)
        places.emplace_back(turn * Eigen::Vector2d(x, side * (kWidth / 2 + out)));
    }
  }
  return places;
}

double turned_off(const Footprint& footprint, double yaw) {
  return std::abs(std::remainder(footprint.direction - yaw, M_PI));
}

TEST(Footprint, OfAnOutlineIsItsRectangle) {
  for (const double yaw : {0.0, 0.3, 1.2, -0.9, 2.5}) {
    const Footprint footprint = fit_footprint(outline(yaw), {});
    EXPECT_LT(turned_off(footprint, yaw), 0.01) << yaw;
    EXPECT_NEAR(footprint.size().x(), kLength, 0.05) << yaw;
    EXPECT_NEAR(footprint.size().y(), kWidth, 0.05) << yaw;
  }
}

TEST(Footprint, SideLiesAmidTheNoiseOfItsPlaces) {
  core::Rng rng(3);
  Places noisy;
  for (int scan = 0; scan < 20; ++scan) {
    for (const Eigen::Vector2d& place : outline(0)) {
      noisy.emplace_back(place.x() + 0.012 * rng.normal(), place.y() + 0.012 * rng.normal());
    }
  }
  const Footprint footprint = fit_footprint(noisy, {});
  EXPECT_NEAR(footprint.size().x(), kLength, 0.02);
  EXPECT_NEAR(footprint.size().y(), kWidth, 0.02);
  EXPECT_GT((footprint.outer_high - footprint.outer_low).x(), kLength + 0.04);
}

TEST(Footprint, MirrorsMoveNoSide) {
  const double yaw = 0.3;
  const Places places = with_mirrors(outline(yaw), yaw);
  const Footprint footprint = fit_footprint(places, {});
  EXPECT_LT(turned_off(footprint, yaw), 0.01);
  EXPECT_NEAR(footprint.size().y(), kWidth, 0.05);
  EXPECT_GT((footprint.outer_high - footprint.outer_low).y(), footprint.size().y());
}

TEST(Footprint, WhatReachesFartherThanAnyStripsTogetherIsNoSide) {
  const auto with_posts = [](double spread) {
    Places places = outline(0);
    for (int i = 0; i < 4; ++i) {  // of eight strips
      const double y = -0.85 + 0.25 * i;
      places.emplace_back(-kLength / 2 - 0.2 - spread * i, y);
    }
    return fit_footprint(places, {});
  };
  EXPECT_NEAR(with_posts(0.25).low.x(), -kLength / 2, 0.01) << "each somewhere else";
  EXPECT_NEAR(with_posts(0.02).low.x(), -kLength / 2 - 0.22, 0.05) << "half of it, equally far";
}

TEST(Footprint, OnlyOfAFaceThatWasLookedAtNothingStandsOut) {
  const Footprint footprint = fit_footprint(outline(0), {});
  Beams none;
  none.fill(Window());
  const Surroundings bare({});
  const Sight from_behind{{{-9, 0, 2}}, none, bare, SE3::Identity()};
  const VehicleConfig config;
  const double out = 2 * config.footprint.stands_out_m;
  const Places places = {{0, 0}, {footprint.low.x() - out, 0}, {footprint.high.x() + out, 0}};
  const Places kept = within(footprint, places, from_behind, config);
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[0], places[0]);
  EXPECT_EQ(kept[1], places[2]);
}

TEST(Footprint, OfTheHullIsThePapersPercentiles) {
  FootprintConfig config;
  config.method = FootprintMethod::hull;
  config.low_percentile = 0;
  config.high_percentile = 100;
  const Eigen::Vector2d half(kLength / 2, kWidth / 2);
  const Places corners = {-half, {half.x(), -half.y()}, half, {-half.x(), half.y()}};
  const Footprint whole = fit_footprint(corners, config);
  EXPECT_NEAR(whole.size().x(), kLength, 1e-9);
  EXPECT_NEAR(whole.size().y(), kWidth, 1e-9);
  config.low_percentile = 40;
  EXPECT_NEAR(fit_footprint(corners, config).size().x(), 0.8 * kLength, 1e-9);
}

TEST(Footprint, QuarterTurnIsTheSameRectangle) {
  const Footprint footprint = fit_footprint(with_mirrors(outline(0.3), 0.3), {});
  const Footprint turned = detection::turned(footprint);
  const auto corner = [](const Footprint& f, double x, double y) {
    return Eigen::Vector2d(Eigen::Rotation2Dd(f.direction) * Eigen::Vector2d(x, y));
  };
  EXPECT_TRUE(corner(turned, turned.low.x(), turned.low.y())
                  .isApprox(corner(footprint, footprint.high.x(), footprint.low.y())));
  EXPECT_TRUE(corner(turned, turned.outer_high.x(), turned.outer_high.y())
                  .isApprox(corner(footprint, footprint.outer_low.x(), footprint.outer_high.y())));
}

TEST(Footprint, FaceNobodyLookedAtStandsBackAndIsLessWellKnown) {
  const Footprint footprint = fit_footprint(outline(0), {});
  Beams none;
  none.fill(Window());
  const Surroundings bare({});
  const Sight from_the_right{{{0, -8, 3}}, none, bare, SE3::Identity()};
  const VehicleNoiseConfig noise;
  const Footprint seen = as_seen(footprint, from_the_right, noise.setback);
  EXPECT_DOUBLE_EQ(seen.low.y(), footprint.low.y());
  EXPECT_NEAR(seen.high.y(), footprint.outer_high.y() + noise.setback.mean_m, 1e-12);
  const Edges edges = edges_of(seen, kBonnetAhead, from_the_right, noise);
  EXPECT_NEAR(edges[1][1].sd - edges[1][0].sd, noise.setback.sd_m, 1e-12);
}

TEST(Footprint, FaceSeenFromBesideIsAnOutline) {
  const Footprint footprint = fit_footprint(with_mirrors(outline(0), 0), {});
  Beams none;
  none.fill(Window());
  const Surroundings bare({});
  const Sight from_behind{{{-9, 0, 2}}, none, bare, SE3::Identity()};
  const VehicleNoiseConfig noise;
  const Footprint seen = as_seen(footprint, from_behind, noise.setback);
  EXPECT_DOUBLE_EQ(seen.low.y(), footprint.outer_low.y());
  EXPECT_DOUBLE_EQ(seen.high.y(), footprint.outer_high.y());
  const Edges edges = edges_of(seen, kBonnetAhead, from_behind, noise);
  EXPECT_DOUBLE_EQ(edges[1][0].sd, edges[1][1].sd);
  EXPECT_GT(edges[1][0].sd, edges[0][0].sd) << "than of the face that it looks at";
  EXPECT_LT(edges[1][0].sd, edges[0][1].sd) << "than of the one behind the vehicle";
}

/// Of beams from high above the rear that meet the ground beyond the front, clear of it from
/// `free_from_m` beyond the edge on.
Edges edges_over_the_roof(const Footprint& footprint, double free_from_m,
                          const std::array<double, 2>& tops = kBonnetAhead) {
  const Eigen::Vector3d sensor(footprint.low.x() - 8, 0, 6);
  Window window;
  window.sensors = {sensor};
  for (const double y : {-0.4, -0.2, 0.0, 0.2, 0.4}) {
    const Eigen::Vector3d grazes(footprint.high.x() + free_from_m, y, BeyondConfig().highest_m);
    const Eigen::Vector3d end = sensor + 1.2 * (grazes - sensor);
    window.beams.push_back({end.cast<float>(), 0});
  }
  Beams beams;
  beams.fill(window);
  return edges_of(footprint, tops, {window.sensors, beams, Surroundings({}), SE3::Identity()}, {});
}

TEST(Footprint, HiddenEndLiesBetweenWhatWasSeenAndWhereBeamsWentThrough) {
  const Footprint footprint = fit_footprint(outline(0), {});
  const double near = BeyondConfig().near_m;
  const ShadowConfig shadow;
  const Edges edges = edges_over_the_roof(footprint, near + 0.6, kBonnetAhead);
  EXPECT_NEAR(edges[0][1].position, footprint.high.x() + shadow.place * 0.6, 1e-3);
  EXPECT_DOUBLE_EQ(edges[0][0].position, footprint.low.x());
  const Edges nearer = edges_over_the_roof(footprint, near + 0.3, kBonnetAhead);
  EXPECT_NEAR(edges[0][1].sd - nearer[0][1].sd, shadow.spread * 0.3 / std::sqrt(12), 1e-3);
}

TEST(Footprint, HiddenTailLiesNearWhatWasSeenAndABonnetFartherOutTheLowerItIs) {
  const Footprint footprint = fit_footprint(outline(0), {});
  const auto ends = [&](double top, double other) {
    return edges_over_the_roof(footprint, BeyondConfig().near_m + 0.6, {other, top})[0];
  };
  const auto position = [&](double top, double other) { return ends(top, other)[1].position; };
  EXPECT_LT(position(1.2, 0.75), position(1.0, 1.6) - 0.1) << "a tail, a high bonnet";
  EXPECT_LT(position(1.0, 1.6), position(0.75, 1.6) - 0.1);
  EXPECT_NEAR(position(1, 1), (position(1, 2) + position(1, 0.5)) / 2, 1e-3) << "may be either";
  EXPECT_DOUBLE_EQ(ends(1.6, 0.75)[0].sd, ends(0.75, 1.6)[0].sd) << "the rear was looked at";
}

TEST(Footprint, EndBeyondWhichNoBeamWentMayLieAnywhere) {
  const Footprint footprint = fit_footprint(outline(0), {});
  const Edges edges = edges_over_the_roof(footprint, BeyondConfig().far_m + 0.2);
  EXPECT_DOUBLE_EQ(edges[0][1].position, footprint.high.x());
  EXPECT_GE(edges[0][1].sd, VehicleNoiseConfig().unseen_m);
}

}  // namespace
}  // namespace saker::detection
