#include "saker/autonomy/open_beams.h"

#include <gtest/gtest.h>

#include <cmath>

#include "saker/core/rng.h"
#include "saker/occupancy/open_beam.h"

namespace saker::autonomy {
namespace {

const lidar::SensorInfo kSensor =
    lidar::SensorInfo::make_os1(16, 512, lidar::PacketProfile::kRng19Rfl8Sig16Nir16);

/// Everything below the horizon answers at 10 m, along its beam; nothing above it.
class OpenBeamsTest : public testing::Test {
 protected:
  OpenBeamsTest() : rays(kSensor), beams(kSensor) {
    scan.rows = kSensor.rows;
    scan.columns = kSensor.columns;
    scan.points.assign(static_cast<std::size_t>(scan.rows) * scan.columns,
                       Eigen::Vector3f::Constant(NAN));
    for (int row = 0; row < scan.rows; ++row) {
      for (int column = 0; column < scan.columns; ++column) {
        if (ray(row, column).direction.z() < 0) {
          at(row, column) = ray(row, column).origin + 10 * ray(row, column).direction;
        }
      }
    }
  }

  const lidar::RayTable::Ray& ray(int row, int column) const {
    const int shift = kSensor.pixel_shift_by_row[row];
    return rays.ray(row, (column - shift + 2 * scan.columns) % scan.columns);
  }
  Eigen::Vector3f& at(int row, int column) {
    return scan.points[static_cast<std::size_t>(row) * scan.columns + column];
  }
  Eigen::Vector3f filled(int row, int column) {
    return beams.added_to(scan)[static_cast<std::size_t>(row) * scan.columns + column];
  }

  lidar::RayTable rays;
  OpenBeams beams;
  lidar::Scan scan;
};

TEST_F(OpenBeamsTest, SkyBecomesPointsFarAwayAlongTheirBeams) {
  const Eigen::Vector3f sky = filled(0, 100);
  EXPECT_NEAR(sky.norm(), occupancy::kOpenBeam_m, 0.1);
  EXPECT_LT(sky.normalized().cross(ray(0, 100).direction).norm(), 1e-3);
}

TEST_F(OpenBeamsTest, ReturnsStayAsTheyAre) { EXPECT_EQ(filled(15, 100), at(15, 100)); }

TEST_F(OpenBeamsTest, ASingleDropOutIsNotOpen) {
  at(12, 50).setConstant(NAN);
  EXPECT_TRUE(filled(12, 50).hasNaN());
}

TEST_F(OpenBeamsTest, WhatBordersOnAReturnIsNotOpen) {
  at(2, 200) = 5 * ray(2, 200).direction;
  for (int row = 1; row <= 3; ++row) {
    for (int column = 199; column <= 201; ++column) {
      if (row == 2 && column == 200) continue;
      EXPECT_TRUE(filled(row, column).hasNaN());
    }
  }
  EXPECT_FALSE(filled(2, 203).hasNaN());
}

TEST_F(OpenBeamsTest, AColumnThatDidNotComeIsNotOpen) {
  for (int row = 0; row < scan.rows; ++row) {
    for (int lost = 300; lost < 316; ++lost) {
      at(row, (lost + kSensor.pixel_shift_by_row[row] + scan.columns) % scan.columns)
          .setConstant(NAN);
    }
  }
  const int column = (308 + kSensor.pixel_shift_by_row[0] + scan.columns) % scan.columns;
  EXPECT_TRUE(filled(0, column).hasNaN());
}

/// A pane about 3.21 m high and 6 m long, or the other way round, that swallows what meets it.
struct Pane {
  Eigen::Vector3f middle, along, up;  ///< along and up: half of its edges
  explicit Pane(core::Rng& rng) {
    const auto at = [&](double low, double high) {
      return static_cast<float>(rng.uniform(low, high));
    };
    const bool upright = at(0, 1) < 0.5F;
    const float azimuth = at(-3, 3), yaw = azimuth + at(-1.2, 1.2);
    middle = at(2, 14) * Eigen::Vector3f(std::cos(azimuth), std::sin(azimuth), at(0, 0.2));
    along = (upright ? 1.6F : 3.0F) * Eigen::Vector3f(-std::sin(yaw), std::cos(yaw), 0);
    up = (upright ? 3.0F : 1.6F) * Eigen::Vector3f::UnitZ();
  }
  /// Range at which a ray meets it; infinite where it does not.
  [[nodiscard]] float range(const lidar::RayTable::Ray& ray) const {
    const Eigen::Vector3f normal = along.cross(up).normalized();
    const float range = normal.dot(middle - ray.origin) / normal.dot(ray.direction);
    const Eigen::Vector3f off = ray.origin + range * ray.direction - middle;
    const bool met = range > 0 && std::abs(off.dot(along)) < along.squaredNorm() &&
                     std::abs(off.dot(up)) < up.squaredNorm();
    return met ? range : INFINITY;
  }
};

// Hazard: Surroundings | a pane of glass (up to 3.2 m by 6 m, in a frame that answers) swallows
//   beams | nothing before or in it is taken for free: it stays unknown | –
TEST_F(OpenBeamsTest, BeforeAndInAPaneNothingIsCleared) {
  core::Rng rng(4);
  int silent = 0, open = 0;
  for (int k = 0; k < 200; ++k) {
    const Pane pane(rng);
    for (int row = 0; row < scan.rows; ++row)
      for (int column = 0; column < scan.columns; ++column) {
        const bool met = std::isfinite(pane.range(ray(row, column)));
        at(row, column) = ray(row, column).origin + 40 * ray(row, column).direction;
        if (met) at(row, column).setConstant(NAN);
      }
    const auto points = beams.added_to(scan);
    for (int row = 0; row < scan.rows; ++row)
      for (int column = 0; column < scan.columns; ++column) {
        const float range = pane.range(ray(row, column));
        if (!std::isfinite(range)) continue;
        ++silent;
        const Eigen::Vector3f& point =
            points[static_cast<std::size_t>(row) * scan.columns + column];
        if (point.hasNaN()) continue;
        ++open;
        EXPECT_GT(occupancy::clears_from_m(point), 0.97F * range);
      }
  }
  EXPECT_GT(silent, 10000);
  EXPECT_GT(open, 0.3 * silent);
}

TEST_F(OpenBeamsTest, AGapOfATenthOfARadianTellsOnlyWhatIsFarAway) {
  for (int column = 0; column < scan.columns; ++column)
    for (int row = 0; row < scan.rows; ++row)
      if (std::abs(column - 100) > 4) at(row, column) = 10 * ray(row, column).direction;
  const float from_m = occupancy::clears_from_m(filled(0, 100));  // 0.1 rad wide, 0.37 rad high
  EXPECT_GT(from_m, 6 / 0.37F);
  EXPECT_LT(from_m, 3.21F / 0.098F);
}

TEST_F(OpenBeamsTest, AGapAcrossTheSeamIsOne) {
  for (int column = 0; column < scan.columns; ++column)
    for (int row = 0; row < scan.rows; ++row)
      if (column > 20 && column < scan.columns - 20)
        at(row, column) = 10 * ray(row, column).direction;
  EXPECT_NEAR(occupancy::clears_from_m(filled(0, 2)),
              occupancy::clears_from_m(filled(0, scan.columns - 2)), 0.3);
}

/// What is left of an open beam that leads down by `pitch` in rad, from a height of the lidar in m.
Eigen::Vector3f led_down(double pitch, double height) {
  SE3 T_odom_lidar = SE3::Identity();
  T_odom_lidar.linear() = Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()).toRotationMatrix();
  T_odom_lidar.translation().z() = height;
  std::vector<Eigen::Vector3f> points = {{occupancy::kOpenBeam_m, 0, 0}};
  OpenBeams::drop_steep(points, T_odom_lidar);
  return points[0];
}

TEST(OpenBeams, OneThatLeadsDownToTheGroundIsNot) { EXPECT_TRUE(led_down(0.2, 3).hasNaN()); }

TEST(OpenBeams, OneThatIsFarAboveTheGroundIs) { EXPECT_FALSE(led_down(0.2, 30).hasNaN()); }

TEST(OpenBeams, OneThatLeadsUpIs) { EXPECT_FALSE(led_down(-0.2, 3).hasNaN()); }

TEST(OpenBeams, ReturnsFromTheGroundAreKept) {
  std::vector<Eigen::Vector3f> points = {{10, 0, -10}};
  OpenBeams::drop_steep(points, SE3::Identity());
  EXPECT_FALSE(points[0].hasNaN());
}

TEST_F(OpenBeamsTest, AnUnorganisedScanHasNone) {
  scan.rows = 0;
  EXPECT_TRUE(filled(0, 100).hasNaN());
}

}  // namespace
}  // namespace saker::autonomy
