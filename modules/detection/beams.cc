#include "saker/detection/beams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace saker::detection {
namespace {

constexpr int kBins = 360;   // of azimuth: a vehicle at 30 m is ten of them wide
constexpr int kSlopes = 24;  // bins of slope, the first and the last with all that is steeper
constexpr float kSteepest = 0.6F;

/// Of a beam that rises by so much over a horizontal distance.
int slope_bin(float rise, float distance) {
  const float slope = rise / std::max(distance, 1e-3F);
  const float at = (slope + kSteepest) * (static_cast<float>(kSlopes) / (2 * kSteepest));
  return static_cast<int>(std::clamp(at, 0.0F, static_cast<float>(kSlopes - 1)));
}

/// To 1e-5 rad, by a polynomial (Abramowitz and Stegun, 4.4.49): bins are a thousand times as wide.
float atan2_of(float y, float x) {
  constexpr auto kPi = static_cast<float>(M_PI);
  const float ax = std::abs(x), ay = std::abs(y);
  const float most = std::max(std::max(ax, ay), std::numeric_limits<float>::min());
  const float z = std::min(ax, ay) / most, s = z * z;
  float angle =
      z * (0.9998660F + s * (-0.3302995F + s * (0.1801410F + s * (-0.0851330F + s * 0.0208351F))));
  if (ay > ax) angle = kPi / 2 - angle;
  if (x < 0) angle = kPi - angle;
  return std::copysign(angle, y);
}

float azimuth_bins(const Eigen::Vector3f& direction) {
  constexpr auto kPerRadian = static_cast<float>(kBins / (2 * M_PI));
  return (atan2_of(direction.y(), direction.x()) + static_cast<float>(M_PI)) * kPerRadian;
}

/// Where a segment lies within a box, as shares of its length.
struct Passage {
  float enter = 0;
  float leave = 0;  ///< more than 1: it ends within
};

/// Bins of slope of the beams that may enter a box.
struct Slopes {
  int lowest = 0, highest = kSlopes - 1;
};

/// \param towards  from the sensor to the middle of the box
/// \param reach    m, horizontally, of the box from its middle
/// \param up       m, the same vertically
Slopes slopes_towards(const Eigen::Vector3f& towards, float reach, float up) {
  const float middle = towards.head<2>().norm();
  const float nearest = middle - reach, farthest = middle + reach;
  if (nearest <= 0) return {};
  const float low = towards.z() - up, high = towards.z() + up;
  return {slope_bin(low, low < 0 ? nearest : farthest),
          slope_bin(high, high < 0 ? farthest : nearest)};
}

/// The segment against the box |x| ≤ half, slab by slab (Kay and Kajiya, SIGGRAPH 1986).
std::optional<Passage> passage(const Eigen::Vector3f& from, const Eigen::Vector3f& to,
                               const Eigen::Vector3f& half) {
  Passage in{0, std::numeric_limits<float>::max()};
  for (const int k : {2, 0, 1}) {  // most beams pass above or below
    const float along = to[k] - from[k];
    if (along == 0) {
      if (std::abs(from[k]) > half[k]) return std::nullopt;
      continue;
    }
    const float a = (-half[k] - from[k]) / along, b = (half[k] - from[k]) / along;
    in.enter = std::max(in.enter, std::min(a, b));
    in.leave = std::min(in.leave, std::max(a, b));
    if (in.enter >= in.leave || in.enter >= 1) return std::nullopt;
  }
  return in;
}

}  // namespace

std::size_t Beams::bin(const Beam& beam) const {
  const Eigen::Vector3f along = beam.end - sensors_[beam.scan];
  const int azimuth = std::clamp(static_cast<int>(azimuth_bins(along)), 0, kBins - 1);
  const int slope = slope_bin(along.z(), along.head<2>().norm());
  return (static_cast<std::size_t>(beam.scan) * kBins + azimuth) * kSlopes + slope;
}

void Beams::fill(const Window& window) {
  sensors_.clear();
  for (const Eigen::Vector3d& sensor : window.sensors) sensors_.push_back(sensor.cast<float>());
  // A counting sort.
  first_.assign(sensors_.size() * kBins * kSlopes + 1, 0);
  bins_.resize(window.beams.size());
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    bins_[i] = static_cast<std::uint32_t>(bin(window.beams[i]));
    ++first_[bins_[i]];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& first : first_) sum += first, first = sum;
  ends_.resize(window.beams.size());
  for (std::size_t i = 0; i < bins_.size(); ++i) ends_[--first_[bins_[i]]] = window.beams[i].end;
}

template <class Take>
void Beams::for_each_towards(const objects::Cuboid& box, const Take& take) const {
  if (box.size.minCoeff() <= 0) return;
  const Eigen::Isometry3f T_box_level = box.pose.inverse().cast<float>();
  const Eigen::Vector3f half = 0.5f * box.size.cast<float>();
  const Eigen::Vector3f centre = box.pose.translation().cast<float>();
  const Eigen::Matrix3f spread = T_box_level.linear().transpose().cwiseAbs();
  const float up = spread.row(2).dot(half);
  for (std::size_t scan = 0; scan < sensors_.size(); ++scan) {
    const Eigen::Vector3f from = T_box_level * sensors_[scan];
    const Eigen::Vector3f towards = centre - sensors_[scan];
    const Slopes slopes = slopes_towards(towards, half.norm(), up);
    const float sine = half.norm() / std::max(towards.head<2>().norm(), 1e-3f);
    const bool about = sine >= 1;  // the sensor: beams enter it from all sides
    const int middle = static_cast<int>(azimuth_bins(towards));
    const int bins = about ? 0 : static_cast<int>(std::asin(sine) * (kBins / (2 * M_PI))) + 2;
    const int first = about ? 0 : middle - bins, last_bin = about ? kBins - 1 : middle + bins;
    for (int b = first; b <= last_bin; ++b) {
      const std::size_t at = (scan * kBins + (b + kBins) % kBins) * kSlopes;
      const std::uint32_t last = first_[at + slopes.highest + 1];
      for (std::uint32_t i = first_[at + slopes.lowest]; i < last; ++i) {
        take(from, T_box_level * ends_[i]);
      }
    }
  }
}

template <class Take>
void Beams::for_each_in(const objects::Cuboid& box, const Take& take) const {
  const Eigen::Vector3f half = 0.5f * box.size.cast<float>();
  for_each_towards(box, [&](const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
    if (const auto in = passage(from, to, half)) take(from, to, *in);
  });
}

int Beams::through(const objects::Cuboid& box) const {
  int count = 0;
  for_each_in(box, [&](const auto&, const auto&, const Passage& in) { count += in.leave <= 1; });
  return count;
}

int Beams::through(const objects::Cuboid& box, const objects::Cuboid& body) const {
  const Eigen::Isometry3f T_body_box = (body.pose.inverse() * box.pose).cast<float>();
  const Eigen::Array3f half = 0.5f * body.size.cast<float>();
  int count = 0;
  for_each_in(box, [&](const auto&, const Eigen::Vector3f& to, const Passage& in) {
    count += in.leave <= 1 && ((T_body_box * to).array().abs() > half).any();
  });
  return count;
}

int Beams::ended(const objects::Cuboid& box) const {
  const Eigen::Array3f half = 0.5f * box.size.cast<float>();
  int count = 0;
  for_each_towards(box, [&](const auto&, const Eigen::Vector3f& to) {
    count += (to.array().abs() <= half).all();
  });
  return count;
}

double Beams::nearest(const objects::Cuboid& box, int count, double least_m, const Bow& bow) const {
  std::vector<double> nearest(static_cast<std::size_t>(count),
                              std::numeric_limits<double>::infinity());  // ascending
  const double face = -0.5 * box.size.x();
  for_each_in(box, [&](const Eigen::Vector3f& from, const Eigen::Vector3f& to, const Passage& in) {
    constexpr int kSteps = 8;
    const float leave = std::min(in.leave, 1.0f);
    double x = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kSteps; ++i) {
      const float share = in.enter + (leave - in.enter) * static_cast<float>(i) / kSteps;
      const Eigen::Vector3f at = from + share * (to - from);
      x = std::min(x, static_cast<double>(at.x()) - face + bow.at(static_cast<double>(at.y())));
    }
    if (x < least_m || x >= nearest.back()) return;
    nearest.pop_back();
    nearest.insert(std::ranges::upper_bound(nearest, x), x);
  });
  return nearest.back();
}

}  // namespace saker::detection
