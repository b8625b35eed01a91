#include "saker/lidar/ring_cones.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "saker/lidar/rings.h"

namespace saker::lidar {
namespace {

constexpr std::size_t kSampled = 4000, kFewest = 1000;
constexpr int kIterations = 10, kMinRings = 8;
constexpr float kThinCone = 0.004F;  // median distance of sines of elevation from their ring's mean
constexpr float kLeastShrink = 0.5F;  // of that distance, against the recording's own origin

struct RingPoints {
  std::vector<Eigen::Vector3f> position;
  std::vector<int> ring;  ///< consecutive from 0
  int rings = 0;
};

RingPoints sample(const std::vector<Eigen::Vector3f>& points,
                  const std::vector<std::uint16_t>& numbers) {
  // A stride that is prime to the number of rings, whatever the order of the file.
  constexpr std::size_t kPrime = 7919;
  std::vector<int> seen(std::size_t{1} << 16, -1);
  RingPoints sampled;
  const std::size_t n = points.size(), step = n % kPrime == 0 ? 1 : kPrime;
  for (std::size_t k = 0, i = 0; k < n && sampled.ring.size() < kSampled; ++k, i = (i + step) % n) {
    if (!points[i].allFinite() || points[i].norm() < kMinRange) continue;
    int& ring = seen[numbers[i]];
    if (ring < 0) ring = sampled.rings++;
    sampled.position.push_back(points[i]);
    sampled.ring.push_back(ring);
  }
  return sampled;
}

/// Sines of elevation about a pose, with their derivatives, less their ring's weighted mean.
struct Residuals {
  Eigen::VectorXf value;
  Eigen::Matrix<float, Eigen::Dynamic, 5> by_pose;
};

void fill(const RingPoints& points, const SensorPose& pose, Residuals& r) {
  const float sr = std::sin(pose[3]), cr = std::cos(pose[3]);
  const float sp = std::sin(pose[4]), cp = std::cos(pose[4]);
  const Eigen::Vector3f axis = sensor_axis(pose);
  const Eigen::Vector3f by_roll(-sp * sr, -cr, -cp * sr), by_pitch(cp * cr, 0, -sp * cr);
  const auto count = static_cast<Eigen::Index>(points.ring.size());
  r.value.resize(count), r.by_pose.resize(count, 5);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3f q = points.position[i] - pose.head<3>();
    const float range = std::max(q.norm(), 0.1F);
    const Eigen::Vector3f ray = q / range;
    const float sine = axis.dot(ray);
    r.value[i] = sine;
    r.by_pose.row(i).head<3>() = ((sine * ray - axis) / range).transpose();
    r.by_pose(i, 3) = by_roll.dot(ray);
    r.by_pose(i, 4) = by_pitch.dot(ray);
  }
}

void subtract_means(const RingPoints& points, const Eigen::VectorXf& weight, Residuals& r) {
  Eigen::VectorXf total = Eigen::VectorXf::Constant(points.rings, 1e-9F);
  Eigen::VectorXf mean = Eigen::VectorXf::Zero(points.rings);
  Eigen::Matrix<float, Eigen::Dynamic, 5> slope =
      Eigen::Matrix<float, Eigen::Dynamic, 5>::Zero(points.rings, 5);
  for (Eigen::Index i = 0; i < r.value.size(); ++i) {
    const int k = points.ring[i];
    total[k] += weight[i];
    mean[k] += weight[i] * r.value[i];
    slope.row(k) += weight[i] * r.by_pose.row(i);
  }
  for (Eigen::Index i = 0; i < r.value.size(); ++i) {
    const int k = points.ring[i];
    r.value[i] -= mean[k] / total[k];
    r.by_pose.row(i) -= slope.row(k) / total[k];
  }
}

float median_size(const Eigen::VectorXf& values) {
  std::vector<float> sizes(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) sizes[i] = std::abs(values[i]);
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

struct Fit {
  SensorPose pose = SensorPose::Zero();
  float spread = 0;  ///< median distance of points from their ring's mean
};

Fit fit(const RingPoints& points, SensorPose pose, int iterations) {
  Residuals r;
  Eigen::VectorXf weight = Eigen::VectorXf::Ones(static_cast<Eigen::Index>(points.ring.size()));
  for (int k = 0;; ++k) {
    fill(points, pose, r);
    subtract_means(points, weight, r);
    const float spread = median_size(r.value);
    if (k == iterations) return {pose, spread};
    const float scale = 2 * spread + 1e-5F;
    weight = (1 + (r.value / scale).array().square()).inverse();
    const Eigen::Matrix<float, 5, 5> H = r.by_pose.transpose() * weight.asDiagonal() * r.by_pose;
    const SensorPose g = r.by_pose.transpose() * weight.cwiseProduct(r.value);
    SensorPose step = -H.ldlt().solve(g);
    if (!step.allFinite()) return {pose, spread};
    step *= std::min(1.0F, 0.5F / std::max(step.head<3>().norm(), 1e-6F));
    pose += step;
  }
}

bool inside(const SensorPose& pose) {
  return std::abs(pose[0]) < 2.5F && std::abs(pose[1]) < 1.5F && std::abs(pose[2]) < 3.5F &&
         std::abs(pose[3]) < 0.1F && std::abs(pose[4]) < 0.1F;
}

}  // namespace

std::optional<RingCones> fit_ring_cones(const std::vector<Eigen::Vector3f>& points,
                                        const std::vector<std::uint16_t>& rings) {
  const RingPoints sampled = sample(points, rings);
  if (sampled.ring.size() < kFewest || sampled.rings < kMinRings || sampled.rings > kMaxRings)
    return std::nullopt;
  const float own = fit(sampled, SensorPose::Zero(), 0).spread;
  Fit best{SensorPose::Zero(), own};
  // From afar every ring is thin, so that a single start may run away.
  for (const float x : {-1.0F, 0.0F, 1.0F}) {
    for (float z = -2.5F; z < 3.1F; z += 0.5F) {
      SensorPose start = SensorPose::Zero();
      start[0] = x, start[2] = z;
      const Fit found = fit(sampled, start, kIterations);
      if (inside(found.pose) && found.spread < best.spread) best = found;
    }
  }
  if (best.spread > kThinCone || best.spread > kLeastShrink * own) return std::nullopt;
  return RingCones{best.pose, best.spread};
}

}  // namespace saker::lidar
