#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "saker/motion/geofence.h"

/// Geofences of all shapes for tests.
namespace saker::active::made {

using Corners = std::vector<Eigen::Vector2d>;

inline motion::Geofence fence_of(const Corners& corners) {
  motion::GeofenceConfig config;
  config.polygon_m.clear();
  for (const Eigen::Vector2d& corner : corners) {
    config.polygon_m.insert(config.polygon_m.end(), {corner.x(), corner.y()});
  }
  return motion::Geofence(config);
}

inline motion::Geofence box_fence(double half_x, double half_y) {
  return fence_of({{-half_x, -half_y}, {half_x, -half_y}, {half_x, half_y}, {-half_x, half_y}});
}

inline Corners turned(Corners corners, double angle) {
  for (Eigen::Vector2d& corner : corners) corner = Eigen::Rotation2Dd(angle) * corner;
  return corners;
}

inline std::map<std::string, Corners> shapes() {
  const Corners l = {{0, 0}, {80, 0}, {80, 20}, {20, 20}, {20, 60}, {0, 60}};
  const Corners comb = {{0, 0},   {90, 0},  {90, 50}, {70, 50}, {70, 12}, {55, 12},
                        {55, 45}, {35, 45}, {35, 12}, {20, 12}, {20, 50}, {0, 50}};
  return {{"rectangle", {{-30, -20}, {50, -20}, {50, 25}, {-30, 25}}},
          {"triangle", {{0, 0}, {70, 10}, {20, 50}}},
          {"L", l},
          {"turned L", turned(l, 0.7)},
          {"U", {{0, 0}, {60, 0}, {60, 50}, {40, 50}, {40, 15}, {20, 15}, {20, 50}, {0, 50}}},
          {"comb", comb},
          {"turned comb", turned(comb, -1.1)},
          {"arrow", {{0, 0}, {60, 25}, {0, 50}, {18, 25}}},
          {"clockwise", {{0, 0}, {0, 40}, {70, 40}, {70, 0}}}};
}

/// On a grid of half a metre.
inline Corners points_in(const motion::Geofence& fence) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : fence.corners()) box.extend(corner);
  Corners points;
  for (double y = box.min().y(); y <= box.max().y(); y += 0.5) {
    for (double x = box.min().x(); x <= box.max().x(); x += 0.5) {
      if (fence.inside_polygon_m({x, y}) >= 0) points.emplace_back(x, y);
    }
  }
  return points;
}

}  // namespace saker::active::made
