#include "saker/occupancy/occupancy.h"

#include <algorithm>
#include <string>

#include "saker/core/error.h"
#include "saker/occupancy/open_beam.h"

namespace saker::occupancy {
namespace {

OccupancyConfig checked_config(const OccupancyConfig& given) {
  const OccupancyConfig config = core::checked(given, "occupancy");
  if (config.keep_radius_m < config.range_m)
    throw Error("occupancy.keep_radius_m: " + std::to_string(config.keep_radius_m) +
                ", expected at least occupancy.range_m, " + std::to_string(config.range_m));
  return config;
}

octomap::point3d to_octomap(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

}  // namespace

const char* to_string(InsertStatus status) {
  constexpr const char* kNames[] = {"ok", "not_newer", "bad_pose"};
  return kNames[static_cast<int>(status)];
}

OccupancyMap::OccupancyMap(const OccupancyConfig& config)
    : config_(checked_config(config)),
      tree_(config_.resolution_m),
      box_(config_.resolution_m, config_.range_m) {
  tree_.setProbHit(config_.hit_probability);
  tree_.setProbMiss(config_.miss_probability);
  tree_.setClampingThresMin(config_.lowest_probability);
  tree_.setClampingThresMax(config_.highest_probability);
}

InsertReport OccupancyMap::insert(std::span<const Eigen::Vector3f> points, const SE3& T_odom_lidar,
                                  Time stamp) {
  InsertReport report;
  report.nodes = tree_.size();
  const octomap::point3d origin = to_octomap(T_odom_lidar.translation().cast<float>());
  if (stamp_ != 0 && stamp <= stamp_) {
    report.status = InsertStatus::not_newer;
    return report;
  }
  if (!T_odom_lidar.matrix().allFinite() || !box_.fits(tree_, origin)) {
    report.status = InsertStatus::bad_pose;
    return report;
  }
  take(points, T_odom_lidar, report);
  box_.collect(tree_, origin, beams_);
  tree_.update(box_);
  stamp_ = stamp;
  report.dropped = drop_far(T_odom_lidar.translation());
  report.nodes = tree_.size();
  return report;
}

void OccupancyMap::take(std::span<const Eigen::Vector3f> points, const SE3& T_odom_lidar,
                        InsertReport& report) {
  const auto own2 = static_cast<float>(config_.body_radius_m * config_.body_radius_m);
  const Eigen::Isometry3f T = T_odom_lidar.cast<float>();
  beams_.clear();
  for (const Eigen::Vector3f& point : points) {
    if (!point.allFinite()) continue;
    if (point.squaredNorm() < own2)
      ++report.own_points;
    else
      beams_.push_back({to_octomap(T * point), clears_from_m(point)});
  }
  report.points = static_cast<int>(beams_.size());
}

std::size_t OccupancyMap::drop_far(const Eigen::Vector3d& centre) {
  const auto most = static_cast<std::size_t>(config_.max_nodes);
  const bool due = stamp_ - dropped_stamp_ >= from_seconds(config_.drop_every_s);
  if (!due && tree_.size() <= most) return 0;
  dropped_stamp_ = stamp_;
  constexpr double kShrink = 0.8;
  double radius_m = config_.keep_radius_m;
  std::size_t dropped = tree_.drop_beyond(centre, radius_m);
  while (tree_.size() > most && radius_m > config_.resolution_m) {
    radius_m *= kShrink;
    dropped += tree_.drop_beyond(centre, radius_m);
  }
  return dropped;
}

OccupancyGrid OccupancyMap::block(const Eigen::Vector3d& low, const Eigen::Vector3d& high) const {
  OccupancyGrid grid;
  grid.stamp = stamp_;
  grid.resolution_m = config_.resolution_m;
  constexpr int kKeys = 1 << 16;
  const auto key = [this](double p) {
    return static_cast<int>(std::clamp(std::floor(p / config_.resolution_m) + kKeys / 2, 0.0,
                                       static_cast<double>(kKeys - 1)));
  };
  octomap::OcTreeKey lowest;
  for (int i = 0; i < 3; ++i) {
    const int first = key(low[i]);
    lowest[static_cast<unsigned>(i)] = static_cast<octomap::key_type>(first);
    grid.size[i] = std::max(key(high[i]) - first + 1, 1);
    grid.origin[i] = (first - kKeys / 2) * config_.resolution_m;
  }
  grid.cells = tree_.cells(lowest, grid.size);
  return grid;
}

}  // namespace saker::occupancy
