#include "detection/edges.h"

#include <algorithm>
#include <cmath>

namespace saker::detection {
namespace {

using Quality = std::array<std::array<double, 2>, 2>;

/// Sine of the steepest angle under which any sensor looked at each face, 0 from behind.
Quality face_sines(const Footprint& footprint, double top,
                   const std::vector<Eigen::Vector3d>& sensors) {
  Quality sines{};
  const Eigen::Vector2d x(std::cos(footprint.direction), std::sin(footprint.direction));
  const Eigen::Vector2d y(-x.y(), x.x());
  const Eigen::Vector2d centre = 0.5 * (footprint.low + footprint.high);
  for (const Eigen::Vector3d& sensor : sensors) {
    const Eigen::Vector2d at(x.dot(sensor.head<2>()), y.dot(sensor.head<2>()));
    for (int k = 0; k < 2; ++k) {
      for (int end = 0; end < 2; ++end) {
        Eigen::Vector2d face = centre;
        face[k] = end == 0 ? footprint.low[k] : footprint.high[k];
        const double outward = (end == 0 ? -1 : 1) * (at[k] - face[k]);
        const double distance = std::hypot((at - face).norm(), sensor.z() - 0.5 * top);
        sines[k][end] = std::max(sines[k][end], outward / std::max(distance, 0.1));
      }
    }
  }
  return sines;
}

double roof_sine(const Footprint& footprint, double top,
                 const std::vector<Eigen::Vector3d>& sensors) {
  const Eigen::Vector2d x(std::cos(footprint.direction), std::sin(footprint.direction));
  const Eigen::Vector2d y(-x.y(), x.x());
  const Eigen::Vector2d middle = 0.5 * (footprint.low + footprint.high);
  const Eigen::Vector2d centre = middle.x() * x + middle.y() * y;
  double sine = 0;
  for (const Eigen::Vector3d& sensor : sensors) {
    const double rise = sensor.z() - top;
    sine =
        std::max(sine, rise / std::max(std::hypot((sensor.head<2>() - centre).norm(), rise), 0.1));
  }
  return sine;
}

double nearest_range(const Footprint& footprint, const std::vector<Eigen::Vector3d>& sensors) {
  const Eigen::Vector2d x(std::cos(footprint.direction), std::sin(footprint.direction));
  const Eigen::Vector2d middle = 0.5 * (footprint.low + footprint.high);
  const Eigen::Vector2d centre = middle.x() * x + middle.y() * Eigen::Vector2d(-x.y(), x.x());
  double range = 1e3;
  for (const Eigen::Vector3d& sensor : sensors) {
    range = std::min(range, (sensor.head<2>() - centre).norm());
  }
  return range;
}

/// 0 below a, 1 above b, smooth between.
double smooth_step(double x, double a, double b) {
  const double t = std::clamp((x - a) / std::max(b - a, 1e-9), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

std::array<std::array<double, 2>, 2> edge_sds(const Footprint& footprint, double top,
                                              const std::vector<Eigen::Vector3d>& sensors,
                                              const VehicleNoiseConfig& noise) {
  const Quality sines = face_sines(footprint, top, sensors);
  const double roof = roof_sine(footprint, top, sensors);
  const double seen_sd =
      std::hypot(noise.edge_m, noise.edge_per_m * nearest_range(footprint, sensors));
  const double low = std::sin(noise.glancing_deg * M_PI / 180);
  const double high = std::sin(noise.clear_deg * M_PI / 180);
  Quality sds{};
  for (int k = 0; k < 2; ++k) {
    // A face beside an edge, or the roof, ends in the edge and shows where it is.
    const double beside = std::max({sines[1 - k][0], sines[1 - k][1], roof});
    for (int end = 0; end < 2; ++end) {
      const double seen = smooth_step(std::max(sines[k][end], beside), low, high);
      sds[k][end] = seen_sd + (1 - seen) * noise.unseen_m;
    }
  }
  return sds;
}

}  // namespace saker::detection
