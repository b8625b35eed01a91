#include "saker/active/views/field_of_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/core/se3.h"

namespace saker::active {
namespace {

using Eigen::Vector3d;

constexpr double kRadians = std::numbers::pi / 180;
constexpr double kUpright = 1e-9;  // of an axis' level part: less has no direction
constexpr int kSections = 40;      // golden ones: 1e-8 of the range

/// Elevations, rad, over the plane across the lidar's axis.
struct Band {
  double lowest, highest;
  [[nodiscard]] bool holds(double elevation) const {
    return elevation >= lowest && elevation <= highest;
  }
};

Band band_of(const FieldOfViewConfig& config, double margin_deg) {
  return {(config.lowest_deg + margin_deg) * kRadians,
          (config.highest_deg - margin_deg) * kRadians};
}

Eigen::Matrix3d turned(double yaw) {
  return Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
}

double elevation_of(const Vector3d& direction, const Vector3d& axis) {
  const double along = direction.dot(axis);
  return std::atan2(along, (direction - along * axis).norm());
}

/// The least of a function with one minimum, by golden sections; ends once it is negative.
template <class Function>
double least(Function f, double low, double high) {
  const double share = 1 / std::numbers::phi;
  double a = high - share * (high - low), b = low + share * (high - low);
  double f_a = f(a), f_b = f(b);
  for (int i = 0; i < kSections && std::min(f_a, f_b) >= 0; ++i) {
    if (f_a < f_b) {
      high = b;
      b = a;
      f_b = f_a;
      f_a = f(a = high - share * (high - low));
    } else {
      low = a;
      a = b;
      f_a = f_b;
      f_b = f(b = low + share * (high - low));
    }
  }
  return std::min(f_a, f_b);
}

/// Whether a point of the box rises higher than `elevation` over the plane across `axis`, seen from
/// the origin. \param box whose corners do not.
///
/// What is not higher than 0 or less is convex: the corners decide. What is higher than more than 0
/// is a cone, the union of balls about t · axis with radius t · cos(elevation).
bool bulges_above(const Eigen::AlignedBox3d& box, const Vector3d& axis, double elevation) {
  if (elevation <= 0) return false;
  const double farthest = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm();
  const auto outside = [&](double t) {
    return box.exteriorDistance(Vector3d(t * axis)) - t * std::cos(elevation);
  };
  return least(outside, 0, farthest / std::sin(elevation)) < 0;
}

bool corners_in(const Eigen::AlignedBox3d& box, const Vector3d& axis, const Band& band) {
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    if (!band.holds(elevation_of(corner, axis))) return false;
  }
  return true;
}

}  // namespace

bool in_field_of_view(const Vector3d& eye, double yaw, const objects::Cuboid& target,
                      const FieldOfViewConfig& config, double margin_deg) {
  const Vector3d in_target = target.pose.inverse() * eye;
  const Vector3d half = 0.5 * target.size;
  const Eigen::Array2d from_axes = in_target.head<2>().cwiseAbs();
  const double nearest = (from_axes - half.head<2>().array()).max(0).matrix().norm();
  if (nearest < config.nearest_m || in_target.head<2>().norm() > config.farthest_m) return false;
  const Band band = band_of(config, margin_deg);
  const Eigen::AlignedBox3d box(-half - in_target, half - in_target);
  const Vector3d axis = turned(yaw - core::yaw(target.pose.linear())) * config.R_body_lidar.col(2);
  return corners_in(box, axis, band) && !bulges_above(box, axis, band.highest) &&
         !bulges_above(box, -axis, -band.lowest);
}

bool between_beams(const Vector3d& eye, double yaw, const Vector3d& point,
                   const FieldOfViewConfig& config) {
  const Vector3d axis = turned(yaw) * config.R_body_lidar.col(2);
  return band_of(config, 0).holds(elevation_of(point - eye, axis));
}

double viewing_azimuth(double elevation, const FieldOfViewConfig& config) {
  const Vector3d axis = config.R_body_lidar.col(2);
  const double leaning = axis.head<2>().norm();
  if (leaning < kUpright) return 0;
  const double to_low_side = std::atan2(axis.y(), axis.x());
  const double cosine = -axis.z() * std::tan(elevation) / leaning;
  const double aside = std::acos(std::clamp(cosine, -1.0, 1.0));
  const double left = std::remainder(to_low_side + aside, 2 * std::numbers::pi);
  const double right = std::remainder(to_low_side - aside, 2 * std::numbers::pi);
  return std::abs(left) < std::abs(right) ? left : right;
}

bool sees_all_around(const FieldOfViewConfig& config) {
  const double steepest = std::asin(std::min(1.0, config.R_body_lidar.col(2).head<2>().norm()));
  const Band band = band_of(config, config.margin_deg);
  return band.holds(steepest) && band.holds(-steepest);
}

bool sees_ahead(const FieldOfViewConfig& config) {
  return band_of(config, config.margin_deg)
      .holds(elevation_of(Vector3d::UnitX(), config.R_body_lidar.col(2)));
}

}  // namespace saker::active
