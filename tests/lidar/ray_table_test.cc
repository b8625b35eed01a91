#include "saker/lidar/ray_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace saker::lidar {
namespace {

SensorInfo sensor() { return SensorInfo::make_os1(32, 512, PacketProfile::kRng19Rfl8Sig16Nir16); }

/// Geometry step by step instead of the vendor's closed form: a beam's origin on a circle about the
/// axis, its direction turned by the encoder, the range counted from the axis side of the origin,
/// then the turn into the sensor frame.
Eigen::Vector3d reference_point(const SensorInfo& info, int row, int column, double range) {
  const double encoder = -2 * M_PI * column / info.columns;
  const Eigen::Matrix3d R_encoder =
      Eigen::AngleAxisd(encoder, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d R_beam =
      (Eigen::AngleAxisd(-info.beam_azimuth_deg[row] * M_PI / 180, Eigen::Vector3d::UnitZ()) *
       Eigen::AngleAxisd(-info.beam_altitude_deg[row] * M_PI / 180, Eigen::Vector3d::UnitY()))
          .toRotationMatrix();
  const Eigen::Vector3d beam_origin(info.beam_origin_m, 0, info.beam_origin_height_m);
  const Eigen::Vector3d in_turned =
      beam_origin + R_beam * Eigen::Vector3d(range - beam_origin.norm(), 0, 0);
  return info.T_sensor_lidar * (R_encoder * in_turned);
}

TEST(RayTable, PointsAgreeWithGeometryStepByStep) {
  SensorInfo info = sensor();
  for (const double height : {0.0, 0.02}) {
    info.beam_origin_height_m = height;
    const RayTable table(info);
    for (int row = 0; row < info.rows; row += 3) {
      for (int column = 0; column < info.columns; column += 17) {
        const RayTable::Ray& ray = table.ray(row, column);
        const Eigen::Vector3f point = ray.direction * 30.0F + ray.origin;
        const Eigen::Vector3d expected = reference_point(info, row, column, 30.0);
        EXPECT_LT((point.cast<double>() - expected).norm(), 1e-5) << row << " " << column;
      }
    }
  }
}

TEST(RayTable, DirectionsHaveLengthOne) {
  const SensorInfo info = sensor();
  const RayTable table(info);
  for (int row = 0; row < info.rows; ++row) {
    EXPECT_NEAR(table.ray(row, 100).direction.norm(), 1, 1e-6);
  }
}

TEST(RayTable, ColumnZeroLooksBackwardsAndColumnsGoClockwise) {
  SensorInfo info = sensor();
  std::fill(info.beam_azimuth_deg.begin(), info.beam_azimuth_deg.end(), 0.0);
  const RayTable table(info);
  EXPECT_LT(table.ray(16, 0).direction.x(), -0.9);
  EXPECT_GT(table.ray(16, info.columns / 2).direction.x(), 0.9);
  EXPECT_GT(table.ray(16, info.columns / 4).direction.y(), 0.9);  // from behind over the left
}

TEST(RayTable, HigherRowsLookHigher) {
  const SensorInfo info = sensor();
  const RayTable table(info);
  for (int row = 1; row < info.rows; ++row) {
    EXPECT_LT(table.ray(row, 0).direction.z(), table.ray(row - 1, 0).direction.z());
  }
}

}  // namespace
}  // namespace saker::lidar
