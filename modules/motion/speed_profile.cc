#include "saker/motion/speed_profile.h"

#include <algorithm>
#include <cmath>

namespace saker::motion {
namespace {

/// What is left of the acceleration along the curve, of two points the more bent.
double along_curve(const CurvePoint& a, const CurvePoint& b, double speed, double acceleration) {
  const double across = std::max(a.curvature, b.curvature) * speed * speed;
  return std::sqrt(std::max(0.0, acceleration * acceleration - across * across));
}

/// By the limits at the point alone.
double most_at(const CurvePoint& point, const LimitsConfig& limits) {
  if (point.stop) return 0;
  double most = limits.max_speed;
  const double climb = std::max(std::abs(point.arriving.z()), std::abs(point.leaving.z()));
  if (climb > 0) most = std::min(most, limits.max_climb_speed / climb);
  if (point.curvature > 0)
    most = std::min(most, std::sqrt(limits.max_acceleration / point.curvature));
  return most;
}

/// A start faster than the limit (they allow less on a climb) is braked from on the first leg.
void allow_braking(std::vector<double>& speeds, const Curve& curve, double start_speed,
                   double acceleration) {
  for (std::size_t i = 0; i < curve.size() && curve[i].curvature == 0 && !curve[i].stop; ++i) {
    const double squared = start_speed * start_speed - 2 * acceleration * curve[i].s;
    if (squared <= 0) return;
    speeds[i] = std::max(speeds[i], std::sqrt(squared));
  }
}

}  // namespace

std::optional<std::vector<double>> speed_profile(const Curve& curve, double start_speed,
                                                 const LimitsConfig& limits) {
  const double acceleration = limits.max_acceleration;
  std::vector<double> speeds(curve.size());
  std::transform(curve.begin(), curve.end(), speeds.begin(),
                 [&](const CurvePoint& point) { return most_at(point, limits); });
  allow_braking(speeds, curve, start_speed, acceleration);

  const auto reachable = [&](std::size_t from, std::size_t to) {
    const double a = along_curve(curve[from], curve[to], speeds[from], acceleration);
    const double squared =
        speeds[from] * speeds[from] + 2 * a * std::abs(curve[to].s - curve[from].s);
    return std::min(speeds[to], std::sqrt(squared));
  };
  speeds.back() = 0;
  for (std::size_t i = curve.size() - 1; i > 0; --i) speeds[i - 1] = reachable(i, i - 1);
  if (speeds.front() < start_speed - 1e-6) return std::nullopt;
  speeds.front() = start_speed;
  for (std::size_t i = 1; i < curve.size(); ++i) speeds[i] = reachable(i - 1, i);
  return speeds;
}

}  // namespace saker::motion
