#include "lidar/made_scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "saker/core/rng.h"

namespace saker::lidar::testing {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kWallTop = 4;

/// Distance along a ray in level coordinates to the ground or the wall; NaN: neither.
float cast(const Eigen::Vector3f& ray, float height, float wall) {
  const float level = ray.head<2>().norm();
  const float at_wall = wall / std::max(level, 1e-6F);
  const float at_ground = ray.z() < 0 ? -height / ray.z() : 1e9F;
  if (at_ground < at_wall) return at_ground;
  return at_wall * ray.z() + height < kWallTop ? at_wall : NAN;
}

}  // namespace

Scan MadeScan::organised() const {
  Scan scan;
  scan.rows = rows;
  scan.columns = columns;
  for (int row = 0; row < rows; ++row) {
    const float even = 15 - 40 * static_cast<float>(row) / static_cast<float>(rows - 1);
    const float elevation = (elevation_deg.empty() ? even : elevation_deg[row]) * kPi / 180;
    for (int column = 0; column < columns; ++column) {
      const float azimuth =
          kPi - 2 * kPi * (static_cast<float>(column) + 0.5F) / static_cast<float>(columns);
      const Eigen::Vector3f ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      scan.points.push_back(cast(tilt * ray, height_m, wall_m) * ray);
    }
  }
  scan.reflectivity.assign(scan.size(), 0.5F);
  scan.offset_ns.assign(scan.size(), 0);
  return scan;
}

Scan with_handedness(Scan organised) {
  for (std::size_t i = 0; i < organised.size(); ++i) {
    const int column = static_cast<int>(i) % organised.columns;
    const bool hit = (column > 100 && column < 160) || (column > 180 && column < 195);
    if (hit && organised.points[i].z() > -1.5F) organised.points[i] *= 0.5F;
  }
  return organised;
}

Scan mirrored(const Scan& organised) {
  Scan scan = organised;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const std::size_t column = i % scan.columns;
    const Eigen::Vector3f& p = organised.points[i - column + scan.columns - 1 - column];
    scan.points[i] = {p.x(), -p.y(), p.z()};
  }
  return scan;
}

std::vector<float> uneven_elevations() {
  std::vector<float> elevation = {15, 11, 8, 5, 3};
  for (int k = 0; k < 49; ++k) elevation.push_back(2 - static_cast<float>(k) / 6);
  for (const float low : {-7.F, -8.F, -9.F, -10.F, -11.F, -12.F, -13.F, -14.F, -19.F, -25.F})
    elevation.push_back(low);
  return elevation;
}

RingFile shuffled(RingFile file, std::uint64_t seed) {
  core::Rng rng(seed);
  for (std::size_t i = file.row.size() - 1; i > 0; --i) {
    const auto other = static_cast<std::size_t>(rng.index(static_cast<int>(i) + 1));
    std::swap(file.scan.points[i], file.scan.points[other]);
    std::swap(file.row[i], file.row[other]);
  }
  return file;
}

RingFile ring_by_ring(const Scan& organised) {
  RingFile file;
  const int columns = organised.columns, half = columns / 2;
  for (int row = 0; row < organised.rows; ++row) {
    for (int k = 0; k < columns; ++k) {
      const int column = (half - 1 - k + columns) % columns;
      const Eigen::Vector3f& p = organised.points[static_cast<std::size_t>(row) * columns + column];
      if (!p.allFinite()) continue;
      file.scan.points.push_back(p);
      file.row.push_back(row);
    }
  }
  file.scan.reflectivity.assign(file.scan.size(), 0.5F);
  file.scan.offset_ns.assign(file.scan.size(), 0);
  return file;
}

Scan scan_in(const Eigen::Isometry3f& T_frame_sensor, std::uint64_t place) {
  constexpr int kColumns = 900, kBlocks = 450;
  core::Rng rng(place);
  std::array<float, kBlocks> block_m{};
  for (float& distance : block_m) distance = static_cast<float>(rng.uniform(4, 40));
  std::array<float, kBlocks> height_m{};
  for (float& height : height_m) height = static_cast<float>(rng.uniform(1.6, 2.1));
  Scan scan;
  for (const float degrees : uneven_elevations()) {
    const float elevation = degrees * (kPi / 180);
    for (int column = 0; column < kColumns; ++column) {
      const float azimuth = static_cast<float>(column) * 360 / kColumns * (kPi / 180);
      const int block = column * kBlocks / kColumns;
      const float to_block = block_m[block];
      const float to_ground = elevation < 0 ? height_m[block] / std::tan(-elevation) : 1000;
      const float level = std::min(to_block, to_ground) + static_cast<float>(rng.normal(0, 0.01));
      scan.ring.push_back(static_cast<std::uint16_t>(scan.size() / kColumns));
      scan.points.push_back(T_frame_sensor * Eigen::Vector3f(level * std::cos(azimuth),
                                                             level * std::sin(azimuth),
                                                             level * std::tan(elevation)));
    }
  }
  return scan;
}

}  // namespace saker::lidar::testing
