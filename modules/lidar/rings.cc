#include "saker/lidar/rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "saker/lidar/elevation_bands.h"

namespace saker::lidar {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr int kMinRings = 8;
constexpr float kJumpBack = 0.35F;   // rad against the direction of rotation: a new ring
constexpr float kThinRing = 0.012F;  // rad, median spread of a ring's elevation

struct Angles {
  std::vector<std::int32_t> index;  // of the finite points
  std::vector<float> azimuth, elevation;

  explicit Angles(std::size_t points) {
    index.reserve(points);
    azimuth.reserve(points);
    elevation.reserve(points);
  }
};

Angles angles_of(const std::vector<Eigen::Vector3f>& points) {
  Angles angles(points.size());
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

/// Most angles are within half a turn already; rounding costs more than all the rest.
float wrapped(float angle) {
  constexpr float kHalfTurn = 3.14F;
  if (std::abs(angle) < kHalfTurn) return angle;
  return angle - 2 * kPi * std::round(angle / (2 * kPi));
}

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
    const bool passed = swept > kPi && step > 0 && step < kPi &&
                        direction * wrapped(azimuth[i - 1] - begin) < 0 &&
                        direction * wrapped(azimuth[i] - begin) >= 0;
    if (step < -kJumpBack || passed) {
      ++number;
      swept = 0;
    } else {
      swept += step;
    }
    ring[i] = number;
  }
  return ring;
}

/// Reorders the values; 0 where there are none.
float take_median(std::vector<float>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<std::vector<float>> elevations_by_ring(const Angles& angles,
                                                   const std::vector<int>& ring) {
  std::vector<std::vector<float>> by_ring(static_cast<std::size_t>(ring.back()) + 1);
  std::vector<std::size_t> counts(by_ring.size(), 0);
  for (const int r : ring) ++counts[r];
  for (std::size_t r = 0; r < counts.size(); ++r) by_ring[r].reserve(counts[r]);
  for (std::size_t i = 0; i < ring.size(); ++i) by_ring[ring[i]].push_back(angles.elevation[i]);
  return by_ring;
}

/// Median elevation of each ring, whose elevations are reordered.
std::vector<float> centres_of(std::vector<std::vector<float>>& by_ring) {
  std::vector<float> centre;
  for (std::vector<float>& elevation : by_ring) centre.push_back(take_median(elevation));
  return centre;
}

/// A beam's points share an elevation, but for calibration, motion and a sensor that is tilted.
bool thin(const std::vector<std::vector<float>>& by_ring, const std::vector<float>& centre) {
  std::vector<float> spread, away;
  for (std::size_t k = 0; k < by_ring.size(); ++k) {
    away.clear();
    for (const float e : by_ring[k]) away.push_back(std::abs(e - centre[k]));
    spread.push_back(take_median(away));
  }
  return take_median(spread) < kThinRing;
}

/// Whether the file goes from the lowest beam up. Only the whole is asked: where the sensor is
/// tilted, a ring's own median says little.
bool rises(const std::vector<float>& centre) {
  std::ptrdiff_t up = 0;
  for (std::size_t k = 1; k < centre.size(); ++k) up += centre[k] > centre[k - 1] ? 1 : -1;
  return up > 0;
}

/// Median over neighbours in the order of the file; jumps are few.
float azimuth_step(const std::vector<float>& azimuth) {
  std::vector<float> steps;
  steps.reserve(azimuth.size());
  for (std::size_t i = 1; i < azimuth.size(); ++i) {
    steps.push_back(std::abs(wrapped(azimuth[i] - azimuth[i - 1])));
  }
  return take_median(steps);
}

/// Numbers the rings from the highest down, `ring` being consecutive from 0 in any order.
std::vector<std::int32_t> by_height(const std::vector<float>& centre) {
  std::vector<std::int32_t> order(centre.size()), number(centre.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::int32_t a, std::int32_t b) { return centre[a] > centre[b]; });
  for (std::size_t k = 0; k < order.size(); ++k) number[order[k]] = static_cast<std::int32_t>(k);
  return number;
}

bool take_given(const Angles& angles, const std::vector<std::uint16_t>& given, Rings& rings) {
  std::vector<int> seen(std::size_t{1} << 16, -1), ring;
  int count = 0;
  for (const std::int32_t i : angles.index) {
    int& number = seen[given[i]];
    if (number < 0) number = count++;
    if (count > kMaxRings) return false;
    ring.push_back(number);
  }
  std::vector<std::vector<float>> elevations(count);
  for (std::size_t i = 0; i < ring.size(); ++i) elevations[ring[i]].push_back(angles.elevation[i]);
  const std::vector<float> centre = centres_of(elevations);
  if (count < kMinRings || !thin(elevations, centre)) return false;
  const std::vector<std::int32_t> number = by_height(centre);
  for (std::size_t i = 0; i < ring.size(); ++i) rings.of_point[angles.index[i]] = number[ring[i]];
  rings.count = count;
  rings.source = RingSource::given;
  rings.azimuth_step = find_azimuth_step(angles.azimuth, angles.elevation);
  return true;
}

bool take_order(const Angles& angles, Rings& rings) {
  const std::vector<int> ring = unfold(angles.azimuth);
  auto by_ring = elevations_by_ring(angles, ring);
  if (by_ring.size() < kMinRings || by_ring.size() > kMaxRings) return false;
  const std::vector<float> centre = centres_of(by_ring);
  if (!thin(by_ring, centre)) return false;
  rings.count = static_cast<int>(by_ring.size());
  rings.source = RingSource::order;
  rings.azimuth_step = azimuth_step(angles.azimuth);
  const bool upside_down = rises(centre);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    rings.of_point[angles.index[i]] = upside_down ? rings.count - 1 - ring[i] : ring[i];
  }
  return true;
}

void take_bands(const Angles& angles, Rings& rings) {
  constexpr float kUsualStep = 0.0035F;  // 0.2°, where the points are too few to tell
  rings.azimuth_step = find_azimuth_step(angles.azimuth, angles.elevation);
  const float step = rings.azimuth_step > 0 ? rings.azimuth_step : kUsualStep;
  const ElevationBands bands =
      find_elevation_bands(angles.azimuth, angles.elevation, step, kMaxRings);
  rings.count = bands.count();
  rings.source = RingSource::bands;
  for (std::size_t i = 0; i < angles.index.size(); ++i)
    rings.of_point[angles.index[i]] = bands.of(angles.elevation[i]);
}

}  // namespace

Rings recover_rings(const std::vector<Eigen::Vector3f>& points,
                    const std::vector<std::uint16_t>& given) {
  Rings rings;
  rings.of_point.assign(points.size(), -1);
  rings.azimuth.assign(points.size(), 0);
  const Angles angles = angles_of(points);
  if (angles.index.empty()) return rings;
  for (std::size_t i = 0; i < angles.index.size(); ++i)
    rings.azimuth[angles.index[i]] = angles.azimuth[i];
  if (given.size() == points.size() && take_given(angles, given, rings)) return rings;
  if (!take_order(angles, rings)) take_bands(angles, rings);
  return rings;
}

}  // namespace saker::lidar
