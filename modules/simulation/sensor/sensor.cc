#include "saker/simulation/sensor/sensor.h"

#include <cmath>
#include <numbers>

#include "saker/lidar/ray_table.h"

namespace saker::simulation {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

Eigen::Vector3d direction(double azimuth, double elevation) {
  return {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
          std::sin(elevation)};
}

}  // namespace

BeamTable ouster_beams(const lidar::SensorInfo& info) {
  const lidar::RayTable rays(info);
  BeamTable table;
  table.rows = info.rows;
  table.columns = info.columns;
  for (int row = 0; row < info.rows; ++row) {
    for (int column = 0; column < info.columns; ++column) {
      table.origins.push_back(rays.ray(row, column).origin);
      table.directions.push_back(rays.ray(row, column).direction);
    }
  }
  return table;
}

BeamTable hdl64_beams(core::Rng& rng) {
  BeamTable table;
  table.rows = 64;
  table.columns = 2000 + rng.index(90);
  const double offset = rng.normal(0.1, 0.2);
  const double stretch = rng.normal(1, 0.01);
  const double first = rng.uniform(0, 2 * std::numbers::pi);
  for (int row = 0; row < table.rows; ++row) {
    const double nominal = row < 32 ? 2 - row / 3.0 : -8.83 - (row - 32) / 2.0;
    const double elevation = (stretch * nominal + offset + rng.normal(0, 0.04)) * kDegree;
    const double shift = rng.normal(0, 0.1) * kDegree;
    const Eigen::Vector3f origin(0, 0, row < 32 ? 0.04F : -0.04F);
    for (int column = 0; column < table.columns; ++column) {
      const double azimuth = first + shift - 2 * std::numbers::pi * column / table.columns;
      table.origins.push_back(origin);
      table.directions.push_back(direction(azimuth, elevation).cast<float>());
    }
  }
  return table;
}

}  // namespace saker::simulation
