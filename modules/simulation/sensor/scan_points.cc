#include "saker/simulation/sensor/scan_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace saker::simulation {
namespace {

constexpr float kToldApart = 1.0F;  ///< m between two returns of a beam that a receiver tells apart

/// The farther of the neighbours in the ring, where it is that of another surface; the beam itself:
/// none.
std::size_t behind_edge(const CastScan& scan, int row, int column) {
  const auto index = [&](int c) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(scan.columns) +
           static_cast<std::size_t>((c + scan.columns) % scan.columns);
  };
  const std::size_t i = index(column);
  std::size_t farthest = i;
  for (const int c : {column - 1, column + 1}) {
    const bool surface = scan.labels[index(c)] > kOutlier;
    if (surface && scan.range_m[index(c)] > scan.range_m[farthest]) farthest = index(c);
  }
  return scan.range_m[farthest] > scan.range_m[i] + kToldApart ? farthest : i;
}

ScanPoint point_of(const CastScan& scan, std::size_t i, int row, int column,
                   const SensorUnit& unit) {
  ScanPoint point;
  point.position = scan.points[i];
  point.reflectivity = scan.reflectivity[i];
  point.label = scan.labels[i];
  point.object = scan.objects[i];
  point.ring = static_cast<std::uint16_t>(row);
  point.column = column;
  point.part = unit.part_of_row[static_cast<std::size_t>(row)];
  return point;
}

/// Places of the rows in a firing: lasers that are neighbours do not fire one after the other.
std::vector<int> firing_order(int rows, core::Rng& rng) {
  std::vector<int> place(static_cast<std::size_t>(rows));
  std::iota(place.begin(), place.end(), 0);
  for (int i = rows - 1; i > 0; --i)
    std::swap(place[static_cast<std::size_t>(i)],
              place[static_cast<std::size_t>(rng.index(i + 1))]);
  return place;
}

template <class Key>
void sort_by(const Key& key, std::vector<ScanPoint>& points) {
  std::stable_sort(points.begin(), points.end(), [&](const ScanPoint& a, const ScanPoint& b) {
    return std::pair(a.part, key(a)) < std::pair(b.part, key(b));
  });
}

float azimuth(const ScanPoint& p) { return std::atan2(p.position.y(), p.position.x()); }

}  // namespace

const char* name_of(PointOrder order) {
  constexpr std::array<const char*, 3> kNames = {"rings", "firings", "packets"};
  return kNames[static_cast<std::size_t>(order)];
}

std::vector<ScanPoint> points_of(const CastScan& scan, const SensorUnit& unit, double echo_share,
                                 core::Rng& rng) {
  std::vector<ScanPoint> points;
  for (int row = 0; row < scan.rows; ++row) {
    for (int column = 0; column < scan.columns; ++column) {
      const std::size_t i = unit.beams.index(row, column);
      if (scan.range_m[i] <= 0) continue;
      points.push_back(point_of(scan, i, row, column, unit));
      if (echo_share <= 0) continue;
      const std::size_t other = behind_edge(scan, row, column);
      if (other == i || !rng.chance(echo_share)) continue;
      ScanPoint echo = point_of(scan, other, row, column, unit);
      echo.position = unit.beams.origins[i] + scan.range_m[other] * unit.beams.directions[i];
      points.push_back(echo);
    }
  }
  return points;
}

void put_in_order(PointOrder order, int rows, int packet_columns, core::Rng& rng,
                  std::vector<ScanPoint>& points) {
  if (order == PointOrder::rings) {
    sort_by([](const ScanPoint& p) { return std::pair(p.ring, azimuth(p)); }, points);
    return;
  }
  const std::vector<int> place = firing_order(rows, rng);
  if (order == PointOrder::firings) {
    sort_by([&](const ScanPoint& p) { return std::pair(p.column, place[p.ring]); }, points);
    return;
  }
  sort_by(
      [&](const ScanPoint& p) {
        return std::tuple(p.column / packet_columns, place[p.ring], p.column);
      },
      points);
}

void move_points(const PoseOfColumn& T_target_lidar, int columns, std::vector<ScanPoint>& points) {
  std::vector<Eigen::Isometry3f> poses;
  for (int column = 0; column < columns; ++column)
    poses.push_back(T_target_lidar(column).cast<float>());
  for (ScanPoint& point : points)
    point.position = poses[static_cast<std::size_t>(point.column)] * point.position;
}

}  // namespace saker::simulation
