#include "saker/objects/geodesy.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "saker/core/error.h"

namespace saker::objects {
namespace {

constexpr double kSemiMajor_m = 6378137;           // WGS 84
constexpr double kFlattening = 1 / 298.257223563;  // WGS 84
constexpr double kSemiMinor_m = kSemiMajor_m * (1 - kFlattening);
constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
constexpr double kSecondEccentricity2 = kEccentricity2 / (1 - kEccentricity2);

double radians(double degrees) { return degrees * std::numbers::pi / 180; }
double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// Rotation from east, north, up to Earth-centred axes.
Eigen::Matrix3d earth_from_enu(double latitude, double longitude) {
  const double sin_lat = std::sin(latitude), cos_lat = std::cos(latitude);
  const double sin_lon = std::sin(longitude), cos_lon = std::cos(longitude);
  Eigen::Matrix3d axes;
  axes.col(0) << -sin_lon, cos_lon, 0;
  axes.col(1) << -sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat;
  axes.col(2) << cos_lat * cos_lon, cos_lat * sin_lon, sin_lat;
  return axes;
}

void check(const char* what, double value, double most) {
  if (std::abs(value) <= most) return;
  throw Error(
      fmt::format("{} of the map's origin: {}, expected {} … {}", what, value, -most, most));
}

}  // namespace

Eigen::Vector3d earth_centred(const GeoPoint& point) {
  const double latitude = radians(point.latitude_deg), longitude = radians(point.longitude_deg);
  const double sin_lat = std::sin(latitude);
  const double normal = kSemiMajor_m / std::sqrt(1 - kEccentricity2 * sin_lat * sin_lat);
  const double across = (normal + point.height_m) * std::cos(latitude);
  return {across * std::cos(longitude), across * std::sin(longitude),
          (normal * (1 - kEccentricity2) + point.height_m) * sin_lat};
}

TangentPlane::TangentPlane(const GeoOrigin& origin) : map_heading_deg_(origin.heading_deg) {
  check("latitude", origin.latitude_deg, 90);
  check("longitude", origin.longitude_deg, 180);
  check("heading", origin.heading_deg, 360);
  origin_ = earth_centred({origin.latitude_deg, origin.longitude_deg, 0});
  const double from_east = radians(90 - origin.heading_deg);
  Eigen::Matrix3d enu_from_map = Eigen::Matrix3d::Identity();
  enu_from_map.topLeftCorner<2, 2>() << std::cos(from_east), -std::sin(from_east),
      std::sin(from_east), std::cos(from_east);
  earth_from_map_ =
      earth_from_enu(radians(origin.latitude_deg), radians(origin.longitude_deg)) * enu_from_map;
}

GeoPoint TangentPlane::geodetic(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d at = origin_ + earth_from_map_ * p;
  const double across = at.head<2>().norm();
  const double reduced = std::atan2(at.z() * kSemiMajor_m, across * kSemiMinor_m);
  const double latitude =
      std::atan2(at.z() + kSecondEccentricity2 * kSemiMinor_m * std::pow(std::sin(reduced), 3),
                 across - kEccentricity2 * kSemiMajor_m * std::pow(std::cos(reduced), 3));
  const double sin_lat = std::sin(latitude);
  const double normal = kSemiMajor_m / std::sqrt(1 - kEccentricity2 * sin_lat * sin_lat);
  // Holds at the poles too, where across / cos(latitude) does not.
  const double height =
      across * std::cos(latitude) + at.z() * sin_lat - kSemiMajor_m * kSemiMajor_m / normal;
  return {degrees(latitude), degrees(std::atan2(at.y(), at.x())), height};
}

double TangentPlane::heading_deg(double yaw) const {
  const double heading = map_heading_deg_ - degrees(yaw);
  const double within = heading - 360 * std::floor(heading / 360);
  return within < 360 ? within : 0;
}

}  // namespace saker::objects
