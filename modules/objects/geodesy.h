#pragma once

#include <Eigen/Core>
#include <cmath>

namespace saker::objects {

/// Where a map's origin is on the Earth, and where its x axis points there.
struct GeoOrigin {
  double latitude_deg = NAN;
  double longitude_deg = NAN;
  double heading_deg = 90;  ///< of x, clockwise from north; 90: x is east and y is north
};

struct GeoPoint {
  double latitude_deg = NAN, longitude_deg = NAN;
  double height_m = NAN;  ///< above the ellipsoid
};

/// The plane that touches WGS 84 at an origin of height 0, with z up: a map's frame on the Earth.
class TangentPlane {
 public:
  explicit TangentPlane(const GeoOrigin& origin);  ///< throws Error on what is no place

  /// p (m, the map's frame) on the Earth, to 1e-9 degrees within 1,000 km: through Earth-centred
  /// coordinates, back by Bowring's formula (Survey Review 28, 1985).
  [[nodiscard]] GeoPoint geodetic(const Eigen::Vector3d& p) const;

  /// Clockwise from north, in [0, 360), of what points `yaw` (rad) from the map's x axis.
  [[nodiscard]] double heading_deg(double yaw) const;

 private:
  double map_heading_deg_;
  Eigen::Vector3d origin_;          ///< Earth-centred, m
  Eigen::Matrix3d earth_from_map_;  ///< rotation
};

/// Earth-centred, Earth-fixed coordinates, m.
[[nodiscard]] Eigen::Vector3d earth_centred(const GeoPoint& point);

}  // namespace saker::objects
