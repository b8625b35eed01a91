#include "detection/motion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace saker::detection {
namespace {

/// Squares covered by the points, each moved to time 0.
std::size_t squares_covered(std::span<const TimedPoint> points, const Eigen::Vector2f& velocity,
                            float square, std::vector<std::int64_t>& keys) {
  keys.clear();
  for (const TimedPoint& p : points) {
    const Eigen::Vector2f at = (p.position - velocity * p.seconds) / square;
    keys.push_back((static_cast<std::int64_t>(std::floor(at.x())) << 32) +
                   static_cast<std::int64_t>(std::floor(at.y())));
  }
  std::sort(keys.begin(), keys.end());
  return static_cast<std::size_t>(std::unique(keys.begin(), keys.end()) - keys.begin());
}

std::vector<TimedPoint> evenly(std::span<const TimedPoint> points, int most) {
  const std::size_t stride = points.size() / static_cast<std::size_t>(most) + 1;
  std::vector<TimedPoint> some;
  for (std::size_t i = 0; i < points.size(); i += stride) some.push_back(points[i]);
  return some;
}

}  // namespace

Motion estimate_motion(std::span<const TimedPoint> points, double direction,
                       const MotionConfig& config) {
  const auto by_time = [](const TimedPoint& a, const TimedPoint& b) {
    return a.seconds < b.seconds;
  };
  const auto [first, last] = std::minmax_element(points.begin(), points.end(), by_time);
  if (points.empty() || last->seconds - first->seconds < config.least_seconds) return {};
  const std::vector<TimedPoint> some = evenly(points, config.most_points);
  const float square = static_cast<float>(config.square_m);
  std::vector<std::int64_t> keys;
  const std::size_t at_rest = squares_covered(some, Eigen::Vector2f::Zero(), square, keys);
  std::size_t fewest = at_rest;
  Motion best;
  const int steps = static_cast<int>(config.fastest / config.step);
  for (const double turn : {0.0, M_PI / 2}) {
    const Eigen::Vector2d along(std::cos(direction + turn), std::sin(direction + turn));
    for (int i = -steps; i <= steps; ++i) {
      const Eigen::Vector2d velocity = i * config.step * along;
      const std::size_t covered = squares_covered(some, velocity.cast<float>(), square, keys);
      if (covered >= fewest) continue;
      fewest = covered;
      best.velocity = velocity;
    }
  }
  const double gain = 1 - static_cast<double>(fewest) / static_cast<double>(at_rest);
  best.moving = gain >= config.least_gain && best.velocity.norm() >= config.slowest;
  if (!best.moving) best.velocity.setZero();
  return best;
}

}  // namespace saker::detection
