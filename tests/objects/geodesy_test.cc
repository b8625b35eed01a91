#include "saker/objects/geodesy.h"

#include <gtest/gtest.h>

#include <numbers>

#include "saker/core/error.h"
#include "saker/core/rng.h"

namespace saker::objects {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(Geodesy, TheOriginIsWhereItWasPut) {
  const GeoPoint at = TangentPlane({48.1, 11.6}).geodetic({0, 0, 0});
  EXPECT_NEAR(at.latitude_deg, 48.1, 1e-12);
  EXPECT_NEAR(at.longitude_deg, 11.6, 1e-12);
  EXPECT_NEAR(at.height_m, 0, 1e-8);
}

TEST(Geodesy, AMetreNorthAtTheEquatorIsTheMeridiansRadiusThere) {
  const GeoPoint at = TangentPlane({0, 0}).geodetic({0, 1, 0});
  EXPECT_NEAR(at.latitude_deg * kDegree, 1 / 6335439.327, 1e-15);  // a (1 − e²)
  EXPECT_NEAR(at.longitude_deg, 0, 1e-12);
}

TEST(Geodesy, AMetreEastAtTheEquatorIsTheEarthsRadius) {
  const GeoPoint at = TangentPlane({0, 0}).geodetic({1, 0, 0});
  EXPECT_NEAR(at.longitude_deg * kDegree, 1 / 6378137.0, 1e-15);
}

TEST(Geodesy, XPointsWhereTheHeadingSays) {
  const TangentPlane north({52, 13, 0}), south({52, 13, 180});
  EXPECT_GT(north.geodetic({100, 0, 0}).latitude_deg, 52.0008);
  EXPECT_NEAR(north.geodetic({100, 0, 0}).longitude_deg, 13, 1e-9);
  EXPECT_LT(north.geodetic({0, 100, 0}).longitude_deg, 13);  // y is to the left of x
  EXPECT_LT(south.geodetic({100, 0, 0}).latitude_deg, 51.9992);
}

TEST(Geodesy, HeadingsAreClockwiseFromNorth) {
  EXPECT_NEAR(TangentPlane({0, 0}).heading_deg(0), 90, 1e-12);
  EXPECT_NEAR(TangentPlane({0, 0}).heading_deg(std::numbers::pi / 2), 0, 1e-12);
  EXPECT_NEAR(TangentPlane({0, 0, 30}).heading_deg(std::numbers::pi / 2), 300, 1e-12);
}

TEST(Geodesy, DistancesAreKeptAndPointsComeBack) {
  core::Rng rng(1);
  for (int i = 0; i < 200; ++i) {
    const TangentPlane plane({rng.uniform(-90, 90), rng.uniform(-180, 180), rng.uniform(0, 360)});
    const auto draw = [&] {
      return Eigen::Vector3d(rng.uniform(-2e4, 2e4), rng.uniform(-2e4, 2e4),
                             rng.uniform(-500, 500));
    };
    const Eigen::Vector3d p = draw(), q = draw();
    const Eigen::Vector3d on_earth =
        earth_centred(plane.geodetic(p)) - earth_centred(plane.geodetic(q));
    EXPECT_NEAR(on_earth.norm(), (p - q).norm(), 1e-4);
  }
}

TEST(Geodesy, WhatIsNoPlaceIsRefused) {
  EXPECT_THROW(TangentPlane({91, 0}), Error);
  EXPECT_THROW(TangentPlane({0, 181}), Error);
  EXPECT_THROW(TangentPlane({NAN, 0}), Error);
  EXPECT_THROW(TangentPlane({0, 0, 1000}), Error);
}

}  // namespace
}  // namespace saker::objects
