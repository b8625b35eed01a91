#include "segmentation/rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "segmentation/range_image.h"

namespace saker::segmentation {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr int kMinRings = 8;
constexpr int kBins = 64;
constexpr float kJumpBack = 0.35F;   // rad against the direction of rotation: a new ring
constexpr float kThinRing = 0.012F;  // rad, median spread of a ring's elevation

struct Angles {
  std::vector<std::int32_t> index;  // of the finite points
  std::vector<float> azimuth, elevation;
};

Angles angles_of(const std::vector<Eigen::Vector3f>& points) {
  Angles angles;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f& p = points[i];
    const float range = p.norm();
    if (!std::isfinite(range) || range < kMinRange) continue;
    angles.index.push_back(static_cast<std::int32_t>(i));
    angles.azimuth.push_back(std::atan2(p.y(), p.x()));
    angles.elevation.push_back(std::asin(std::clamp(p.z() / range, -1.0F, 1.0F)));
  }
  return angles;
}

float wrapped(float angle) { return angle - 2 * kPi * std::round(angle / (2 * kPi)); }

/// +1 where the azimuth mostly rises from point to point, −1 where it falls.
float direction_of(const std::vector<float>& azimuth) {
  std::ptrdiff_t rising = 0;
  for (std::size_t i = 1; i < azimuth.size(); ++i) {
    const float step = wrapped(azimuth[i] - azimuth[i - 1]);
    if (std::abs(step) < kJumpBack) rising += step > 0 ? 1 : -1;
  }
  return rising >= 0 ? 1.0F : -1.0F;
}

/// Number of the ring of each finite point, by unfolding the azimuth.
std::vector<int> unfold(const std::vector<float>& azimuth) {
  std::vector<int> ring(azimuth.size(), 0);
  if (azimuth.empty()) return ring;
  const float direction = direction_of(azimuth);
  const float begin = azimuth.front() - direction * 1e-3F;
  float swept = 0;
  int number = 0;
  for (std::size_t i = 1; i < azimuth.size(); ++i) {
    const float step = direction * wrapped(azimuth[i] - azimuth[i - 1]);
    const bool passed = direction * wrapped(azimuth[i - 1] - begin) < 0 &&
                        direction * wrapped(azimuth[i] - begin) >= 0 && step > 0 && step < kPi;
    if (step < -kJumpBack || (passed && swept > kPi)) {
      ++number;
      swept = 0;
    } else {
      swept += step;
    }
    ring[i] = number;
  }
  return ring;
}

float median(std::vector<float> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<std::vector<float>> elevations_by_ring(const Angles& angles,
                                                   const std::vector<int>& ring) {
  std::vector<std::vector<float>> by_ring(static_cast<std::size_t>(ring.back()) + 1);
  for (std::size_t i = 0; i < ring.size(); ++i) by_ring[ring[i]].push_back(angles.elevation[i]);
  return by_ring;
}

/// A beam's points share an elevation, but for the calibration of the sensor.
bool thin(const std::vector<std::vector<float>>& by_ring) {
  std::vector<float> spread;
  for (const std::vector<float>& elevation : by_ring) {
    const float centre = median(elevation);
    std::vector<float> away;
    for (const float e : elevation) away.push_back(std::abs(e - centre));
    spread.push_back(median(away));
  }
  return median(spread) < kThinRing;
}

/// Whether the file goes from the lowest beam up. Only the whole is asked: where the sensor is
/// tilted, a ring's own median says little.
bool rises(const std::vector<std::vector<float>>& by_ring) {
  std::ptrdiff_t up = 0;
  for (std::size_t k = 1; k < by_ring.size(); ++k) {
    up += median(by_ring[k]) > median(by_ring[k - 1]) ? 1 : -1;
  }
  return up > 0;
}

/// Median over neighbours in the order of the file; jumps are few.
float azimuth_step(const std::vector<float>& azimuth) {
  std::vector<float> steps;
  for (std::size_t i = 1; i < azimuth.size(); ++i) {
    steps.push_back(std::abs(wrapped(azimuth[i] - azimuth[i - 1])));
  }
  return median(std::move(steps));
}

void take_order(const Angles& angles, const std::vector<int>& ring, Rings& rings) {
  const auto by_ring = elevations_by_ring(angles, ring);
  if (by_ring.size() < kMinRings || by_ring.size() > kMaxRings || !thin(by_ring)) return;
  rings.count = static_cast<int>(by_ring.size());
  rings.from_order = true;
  const bool upside_down = rises(by_ring);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    rings.of_point[angles.index[i]] = upside_down ? rings.count - 1 - ring[i] : ring[i];
  }
}

void take_bins(const Angles& angles, Rings& rings) {
  const auto [low, high] = std::minmax_element(angles.elevation.begin(), angles.elevation.end());
  const float height = std::max(*high - *low, 1e-3F);
  rings.count = kBins;
  for (std::size_t i = 0; i < angles.index.size(); ++i) {
    const float down = (*high - angles.elevation[i]) / height;
    rings.of_point[angles.index[i]] = std::min(static_cast<int>(down * kBins), kBins - 1);
  }
}

}  // namespace

Rings recover_rings(const std::vector<Eigen::Vector3f>& points) {
  Rings rings;
  rings.of_point.assign(points.size(), -1);
  const Angles angles = angles_of(points);
  if (angles.index.empty()) return rings;
  take_order(angles, unfold(angles.azimuth), rings);
  if (!rings.from_order) take_bins(angles, rings);
  if (rings.from_order) rings.azimuth_step = azimuth_step(angles.azimuth);
  return rings;
}

}  // namespace saker::segmentation
