#include "saker/detection/motion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace saker::detection {
namespace {

/// Counts squares, each remembered by the number of the count that covered it last. The field wraps
/// around after kEdge squares: farther than a cluster reaches.
class SquareCounter {
 public:
  explicit SquareCounter(double square) : per_m_(1 / static_cast<float>(square)) {}

  /// Squares covered by the points, each moved to time 0; counts no farther than to `most`.
  int covered(std::span<const TimedPoint> points, const Eigen::Vector2f& velocity, int most) {
    ++count_;
    int fresh = 0;
    for (const TimedPoint& p : points) {
      if (fresh >= most) break;
      const Eigen::Vector2f at = (p.position - velocity * p.seconds) * per_m_;
      const int column = static_cast<int>(std::floor(at.x())) & (kEdge - 1);
      const int row = static_cast<int>(std::floor(at.y())) & (kEdge - 1);
      std::int32_t& last = last_[static_cast<std::size_t>(row * kEdge + column)];
      fresh += last != count_;
      last = count_;
    }
    return fresh;
  }

 private:
  static constexpr int kEdge = 256;

  float per_m_;
  std::int32_t count_ = 0;
  std::vector<std::int32_t> last_ = std::vector<std::int32_t>(kEdge * kEdge, 0);
};

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
  SquareCounter counter(config.square_m);
  const int at_rest =
      counter.covered(some, Eigen::Vector2f::Zero(), std::numeric_limits<int>::max());
  int fewest = at_rest;
  Motion best;
  const int steps = static_cast<int>(config.fastest / config.step);
  for (const double turn : {0.0, M_PI / 2}) {
    const Eigen::Vector2d along(std::cos(direction + turn), std::sin(direction + turn));
    for (int i = -steps; i <= steps; ++i) {
      const Eigen::Vector2d velocity = i * config.step * along;
      const int covered = counter.covered(some, velocity.cast<float>(), fewest);
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
