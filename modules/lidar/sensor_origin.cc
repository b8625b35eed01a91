#include "saker/lidar/sensor_origin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>
#include <string>

#include "saker/lidar/beam_sharpness.h"
#include "saker/lidar/nelder_mead.h"
#include "saker/lidar/ring_cones.h"

namespace saker::lidar {
namespace {

// Less than that is the sensor's own frame. A scan that was compensated for the car's motion draws
// its cones about the middle of the path, some decimetres behind or ahead of the sensor.
constexpr float kLeastUp = 0.3F, kLeastAlong = 0.6F;  // m
constexpr float kAgreeUp = 0.1F, kAgreeAlong = 0.7F;  // m, between scans
constexpr float kLeastGain = 0.4F;    // of sharpness, over the recording's own origin
constexpr float kFineBin = 0.00105F;  // 0.06° at the horizon
constexpr float kCoarseBin = 0.0021F;
constexpr float kDegree = std::numbers::pi_v<float> / 180;

struct Candidate {
  SensorPose pose = SensorPose::Zero();
  float sharpness = 0;
  float between = 0;  ///< share of the points that lie between the beams
};

bool sharper(const Candidate& a, const Candidate& b) { return a.sharpness > b.sharpness; }
bool duller(const Candidate& a, const Candidate& b) { return a.sharpness < b.sharpness; }

float apart(const SensorPose& a, const SensorPose& b) { return (a.head<3>() - b.head<3>()).norm(); }

/// The sharpest origins on a grid, no two of them near each other.
std::vector<Candidate> search_grid(const BeamSharpness& beams) {
  constexpr std::size_t kBest = 2;
  constexpr float kStep = 0.5F, kStepUp = 0.25F, kApart = 0.6F;
  std::vector<Candidate> all;
  for (float x = -2; x <= 2.01F; x += kStep) {
    for (float y = -1; y <= 1.01F; y += kStep) {
      for (float z = -2.5F; z <= 3.01F; z += kStepUp) {
        SensorPose pose;
        pose << x, y, z, 0, 0;
        all.push_back({.pose = pose, .sharpness = beams.by_sector(pose, kFineBin)});
      }
    }
  }
  std::sort(all.begin(), all.end(), sharper);
  std::vector<Candidate> best;
  for (const Candidate& c : all) {
    const auto near = [&](const Candidate& other) { return apart(c.pose, other.pose) < kApart; };
    if (std::none_of(best.begin(), best.end(), near)) best.push_back(c);
    if (best.size() == kBest) break;
  }
  return best;
}

/// The best tilt on a grid, the origin being roughly right.
SensorPose search_tilt(const BeamSharpness& beams, SensorPose pose) {
  Candidate best{pose, -1};
  for (float pitch = -3; pitch <= 3.01F; pitch += 0.25F) {
    for (float roll = -2; roll <= 2.01F; roll += 0.25F) {
      pose.tail<2>() << roll * kDegree, pitch * kDegree;
      const float sharpness = beams.whole(pose, kCoarseBin);
      if (sharpness > best.sharpness) best = {pose, sharpness};
    }
  }
  return best.pose;
}

/// Origin and tilt in turn, while the origin's neighbourhood is still searched in sectors.
SensorPose approach(const BeamSharpness& beams, SensorPose pose) {
  constexpr int kTries = 40;
  SensorPose steps;
  steps << 0.2F, 0.2F, 0.1F, 0, 0;
  for (int turn = 0; turn < 2; ++turn) {
    const auto in_sectors = [&](const SensorPose& p) { return beams.by_sector(p, kFineBin); };
    pose = maximise(in_sectors, pose, steps, kTries);
    pose = search_tilt(beams, pose);
  }
  return pose;
}

/// All five unknowns together, from starts around `pose`. Sectors leave x and y open by some 0.3 m.
Candidate refine(const BeamSharpness& beams, const SensorPose& pose) {
  constexpr int kFirstTries = 60, kTries = 120;
  constexpr float kAround = 0.25F;
  SensorPose steps;
  steps << 0.15F, 0.15F, 0.05F, 0.2F * kDegree, 0.2F * kDegree;
  const auto sharpness = [&](const SensorPose& p) { return beams.whole(p, kFineBin); };
  Candidate best{pose, sharpness(pose)};
  for (const float x : {-kAround, 0.0F, kAround}) {
    for (const float y : {-kAround, 0.0F, kAround}) {
      SensorPose start = pose;
      start.head<2>() += Eigen::Vector2f(x, y);
      start = maximise(sharpness, start, steps, kFirstTries);
      best = std::max(best, {start, sharpness(start)}, duller);
    }
  }
  for (int round = 0; round < 3; ++round) {
    best.pose = maximise(sharpness, best.pose, steps, kTries);
    steps *= -0.6F;  // the other way round, so that the simplex is a new one
  }
  return {.pose = best.pose, .sharpness = sharpness(best.pose)};
}

/// False where the sharpness has a second peak above or below, as of two sensors one over another,
/// or does not fall, as in a round place.
bool alone(const BeamSharpness& beams, const Candidate& best, float own) {
  constexpr float kStep = 0.03F, kFarthest = 1.5F, kFallen = 1, kShare = 0.4F;
  const float gain = best.sharpness - own;
  for (const float side : {-1.0F, 1.0F}) {
    float lowest = best.sharpness;
    for (float away = kStep; away < kFarthest; away += kStep) {
      SensorPose pose = best.pose;
      pose[2] += side * away;
      const float here = beams.whole(pose, kFineBin);
      lowest = std::min(lowest, here);
      const float base = away > kFallen ? own : lowest;
      if (here - base > kShare * gain) return false;
    }
  }
  return true;
}

bool moved(const SensorPose& pose) {
  return std::abs(pose[2]) >= kLeastUp || pose.head<2>().norm() >= kLeastAlong;
}

bool agree(const SensorPose& a, const SensorPose& b) {
  return std::abs(a[2] - b[2]) <= kAgreeUp && (a - b).head<2>().norm() <= kAgreeAlong;
}

/// Searched everywhere, or only about `guess`.
std::optional<Candidate> from_sharpness(const std::vector<Eigen::Vector3f>& points,
                                        const std::optional<Candidate>& guess) {
  const BeamSharpness beams(points);
  if (beams.empty()) return std::nullopt;
  const float own = beams.whole(SensorPose::Zero(), kFineBin);
  Candidate best;
  if (guess) {
    best = refine(beams, guess->pose);
  } else {
    for (const Candidate& c : search_grid(beams))
      best = std::max(best, refine(beams, approach(beams, c.pose)), duller);
  }
  if (best.sharpness - own < kLeastGain || !alone(beams, best, own)) return std::nullopt;
  best.between = beams.share_between_beams(best.pose, kFineBin);
  return best;
}

std::optional<Candidate> from_rings(const std::vector<Eigen::Vector3f>& points,
                                    const std::vector<std::uint16_t>& rings) {
  const std::optional<RingCones> cones = fit_ring_cones(points, rings);
  if (!cones) return std::nullopt;
  return Candidate{.pose = cones->pose, .sharpness = -std::log(cones->spread + 1e-6F)};
}

/// What one scan tells.
std::optional<Candidate> search(const std::vector<Eigen::Vector3f>& points,
                                const std::vector<std::uint16_t>& rings,
                                const std::optional<Candidate>& guess) {
  const bool numbered = !rings.empty() && rings.size() == points.size();
  const std::optional<Candidate> found =
      numbered ? from_rings(points, rings) : from_sharpness(points, guess);
  if (!found || !moved(found->pose)) return std::nullopt;
  return found;
}

/// Of two sensors, one's points lie between the other's beams: a quarter of all and more. A single
/// sensor leaves a twentieth there, a blurred one up to a quarter.
bool explained(const Candidate& found) { return found.between < 0.23F; }

Eigen::Isometry3f transform_of(const SensorPose& pose) {
  Eigen::Isometry3f T_lidar_sensor = Eigen::Isometry3f::Identity();
  T_lidar_sensor.translation() = pose.head<3>();
  T_lidar_sensor.linear() = (Eigen::AngleAxisf(pose[4], Eigen::Vector3f::UnitY()) *
                             Eigen::AngleAxisf(pose[3], Eigen::Vector3f::UnitX()))
                                .toRotationMatrix();
  return T_lidar_sensor;
}

}  // namespace

std::optional<Eigen::Isometry3f> find_sensor_origin(const std::vector<Eigen::Vector3f>& points,
                                                    const std::vector<std::uint16_t>& rings) {
  const std::optional<Candidate> found = search(points, rings, std::nullopt);
  if (!found || !explained(*found)) return std::nullopt;
  return transform_of(found->pose);
}

std::optional<Eigen::Isometry3f> find_sensor_origin(std::span<const Scan> scans) {
  constexpr std::size_t kFewest = 2, kSilent = 2;
  std::optional<Candidate> best;
  std::size_t telling = 0, silent = 0;
  for (const Scan& scan : scans) {
    const std::optional<Candidate> found = search(scan.points, scan.ring, best);
    if (!found) {
      if (++silent == kSilent) return std::nullopt;
      continue;
    }
    if (best && !agree(found->pose, best->pose)) return std::nullopt;
    ++telling;
    if (!best || found->sharpness > best->sharpness) best = found;
  }
  if (!best || telling < std::min(kFewest, scans.size())) return std::nullopt;
  if (!explained(*best)) return std::nullopt;
  return transform_of(best->pose);
}

std::optional<Eigen::Isometry3f> find_sensor_origin(
    std::size_t count, const std::function<std::string(std::size_t, Scan&)>& read) {
  if (count == 0) return std::nullopt;
  std::vector<Scan> scans;
  for (const std::size_t i : std::set<std::size_t>{0, (count - 1) / 2, count - 1}) {
    Scan scan;
    if (read(i, scan).empty()) scans.push_back(std::move(scan));
  }
  return find_sensor_origin(std::span<const Scan>(scans));
}

std::string describe_sensor_origin(const Eigen::Isometry3f& T_lidar_sensor) {
  const Eigen::Vector3f axis = T_lidar_sensor.linear().col(2);
  // Adding zero makes a rounded −0 a 0.
  const Eigen::Vector3f at = (T_lidar_sensor.translation() * 100).array().round() / 100 + 0.0F;
  const float pitch = std::round(std::atan2(axis.x(), axis.z()) / kDegree * 10) / 10 + 0.0F;
  const float roll = std::round(std::atan2(-axis.y(), axis.z()) / kDegree * 10) / 10 + 0.0F;
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(),
                "the recording's frame is not the sensor's: beams start at x %.2f y %.2f z %.2f m, "
                "pitched by %.1f°, rolled by %.1f°",
                at.x(), at.y(), at.z(), pitch, roll);
  return text.data();
}

}  // namespace saker::lidar
