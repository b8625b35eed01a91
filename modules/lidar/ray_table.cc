#include "saker/lidar/ray_table.h"

#include <cmath>
#include <numbers>

namespace saker::lidar {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

RayTable::Ray make_ray(const SensorInfo& info, int row, int column) {
  const double encoder = 2 * std::numbers::pi * (1 - static_cast<double>(column) / info.columns);
  const double azimuth = encoder - info.beam_azimuth_deg[row] * kDegree;
  const double altitude = info.beam_altitude_deg[row] * kDegree;
  const Eigen::Vector3d direction(std::cos(azimuth) * std::cos(altitude),
                                  std::sin(azimuth) * std::cos(altitude), std::sin(altitude));
  const Eigen::Vector3d beam(info.beam_origin_m * std::cos(encoder),
                             info.beam_origin_m * std::sin(encoder), info.beam_origin_height_m);
  const double path = info.beam_origin_height_m == 0
                          ? info.beam_origin_m
                          : std::hypot(info.beam_origin_m, info.beam_origin_height_m);
  const Eigen::Vector3d origin = info.T_sensor_lidar * (beam - path * direction);
  return {(info.T_sensor_lidar.linear() * direction).cast<float>(), origin.cast<float>()};
}

}  // namespace

RayTable::RayTable(const SensorInfo& info) : columns_(static_cast<std::size_t>(info.columns)) {
  rays_.reserve(columns_ * info.rows);
  for (int row = 0; row < info.rows; ++row) {
    for (int column = 0; column < info.columns; ++column) {
      rays_.push_back(make_ray(info, row, column));
    }
  }
}

}  // namespace saker::lidar
