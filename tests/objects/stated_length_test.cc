#include "saker/objects/stated_length.h"

#include <gtest/gtest.h>

#include "saker/objects/view_cell.h"

namespace saker::objects {
namespace {

/// With sd of 0.3 m along x and of 0.1 m along y.
Measurement measured(double x, double y) {
  Measurement measurement;
  measurement.model = Cuboid{SE3::Identity(), {x, y, 1.5}};
  measurement.covariance = Matrix9d::Identity();
  measurement.covariance(6, 6) = 0.09;
  measurement.covariance(7, 7) = 0.01;
  return measurement;
}

TEST(StatedLength, IsThatOfTheLongerEdgeWhicheverAxisItLiesAlong) {
  EXPECT_DOUBLE_EQ(length_sd(measured(4.5, 1.8)), 0.3);
  EXPECT_DOUBLE_EQ(width_sd(measured(4.5, 1.8)), 0.1);
  EXPECT_DOUBLE_EQ(length_sd(measured(1.8, 4.5)), 0.1);
  EXPECT_DOUBLE_EQ(width_sd(measured(1.8, 4.5)), 0.3);
}

TEST(StatedLength, OfASquareLiesAlongX) {
  EXPECT_EQ(longer_axis(Cuboid{SE3::Identity(), {2, 2, 1}}), 0);
}

TEST(StatedLength, ByItsOwnPointsGoesBeforeTheCovariance) {
  Measurement measurement = measured(4.5, 1.8);
  measurement.length_sd = 0.7;
  EXPECT_DOUBLE_EQ(length_sd(measurement), 0.7);
  EXPECT_DOUBLE_EQ(width_sd(measurement), 0.1) << "of which points say nothing";
}

TEST(PlanarRows, AreThoseOfPlaceLengthAndWidth) {
  EXPECT_EQ(planar_rows(Cuboid{}), (std::vector<int>{3, 4, 6, 7}));
  EXPECT_EQ(planar_rows(Cylinder{}), (std::vector<int>{0, 1}));
}

TEST(ViewCell, EachIntervalHasTwoOfItsOwn) {
  for (int interval = 0; interval < 100; ++interval) {
    EXPECT_TRUE(is_corrected(corrected_cell(interval)));
    EXPECT_FALSE(is_corrected(uncorrected_cell(interval)));
    EXPECT_EQ(corrected_cell(interval) / 2, interval);
    EXPECT_EQ(uncorrected_cell(interval) / 2, interval);
  }
}

TEST(ViewCell, OfAMeasurementThatCountsByItselfIsNotCorrected) { EXPECT_FALSE(is_corrected(-1)); }

}  // namespace
}  // namespace saker::objects
