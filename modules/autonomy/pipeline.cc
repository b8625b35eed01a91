#include "saker/autonomy/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "saker/autonomy/incomplete_targets.h"
#include "saker/autonomy/label_counts.h"
#include "saker/core/error.h"
#include "saker/occupancy/open_beam.h"

namespace saker::autonomy {
namespace {

constexpr std::size_t kMostMotions = 3000;       // five minutes of scans without a cycle
constexpr std::size_t kMostLabelledScans = 100;  // 10 s at a sensor's full rate

/// From a frame to the one with the same z axis, origin and heading of `T_frame_body`.
SE3 to_start_frame(const SE3& T_frame_body) {
  SE3 T_frame_start = SE3::Identity();
  T_frame_start.linear() =
      Eigen::AngleAxisd(core::yaw(T_frame_body.linear()), Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  T_frame_start.translation() = T_frame_body.translation();
  return T_frame_start.inverse();
}

}  // namespace

Ingestion::Ingestion(const odometry::OdometryConfig& config, const StandstillConfig& standstill,
                     const lidar::SensorInfo& info, const SE3& T_body_lidar)
    : stream_(info, false, lidar::OusterStream::Stamps::go_on),
      standstill_(standstill),
      open_beams_(info),
      odometry_(config),
      T_body_lidar_(T_body_lidar) {
  if (config.max_range_m < occupancy::kOpenBeam_m) return;
  throw Error(fmt::format("odometry.max_range_m: {:g}, expected less than {:g} in flight",
                          config.max_range_m, occupancy::kOpenBeam_m));
}

std::optional<lidar::Frame> Ingestion::take_newest() {
  std::optional<lidar::Frame> newest;
  while (auto item = stream_.take()) {
    if (newest) {
      ++dropped_;
      item->frame.imu.insert(item->frame.imu.begin(), newest->imu.begin(), newest->imu.end());
    }
    newest = std::move(item->frame);
  }
  if (!newest) return std::nullopt;
  newest_stamp_ = newest->scan.stamp;
  if (stood_) return newest;
  standstill_.add(newest->imu);
  stood_ = standstill_.reached();
  if (!stood_) return std::nullopt;
  newest->imu = standstill_.samples();
  return newest;
}

IngestedScan Ingestion::register_scan(lidar::Frame frame) {
  IngestedScan result;
  result.name = std::move(frame.name);
  lidar::Scan opened = frame.scan;
  opened.points = open_beams_.added_to(frame.scan);
  result.scan = std::make_shared<const lidar::Scan>(std::move(frame.scan));
  odometry::OdometryEstimate estimate = odometry_.register_scan(opened, frame.imu);
  if (!T_start_odometry_) {
    T_start_odometry_ = to_start_frame(estimate.T_odom_lidar * T_body_lidar_.inverse());
  }
  const SE3 T_odom_lidar = *T_start_odometry_ * estimate.T_odom_lidar;
  OpenBeams::drop_steep(estimate.points, T_odom_lidar);
  result.registered = {
      estimate.stamp,
      T_odom_lidar,
      std::make_shared<const std::vector<Eigen::Vector3f>>(std::move(estimate.points)),
      {result.scan, &result.scan->reflectivity}};
  result.covariance = estimate.covariance;
  result.status = estimate.status;
  result.reason = estimate.reason;
  return result;
}

void MotionLog::add(Time stamp, const SE3& T_odom_lidar, const Matrix6d& covariance) {
  steps_.push_back({stamp, T_odom_lidar, covariance});
  if (steps_.size() > kMostMotions) steps_.pop_front();
}

Matrix6d MotionLog::take(Time until) {
  Matrix6d sum = Matrix6d::Zero();
  while (!steps_.empty() && steps_.front().stamp <= until) {
    const Step& step = steps_.front();
    const SE3 T_last_now = T_odom_last_.inverse() * step.T_odom_lidar;
    const Matrix6d carry = core::se3_adjoint(T_last_now.inverse());
    sum = carry * sum * carry.transpose() + step.covariance;
    T_odom_last_ = step.T_odom_lidar;
    steps_.pop_front();
  }
  return sum;
}

void LabelledWindow::add(detection::LabelledScan scan) {
  const Time oldest = scan.stamp - length_;
  scans_.push_back(std::move(scan));
  while (scans_.front().stamp < oldest || scans_.size() > kMostLabelledScans) scans_.pop_front();
}

Mapping::Mapping(const detection::DetectionConfig& detection, const slam::SlamConfig& slam,
                 const objects::ClassTable& table, std::shared_ptr<const uncertainty::Model> model)
    : iterations_(slam.graph.iterations),
      detection_(detection, table),
      noise_(slam, std::move(model)),
      slam_(slam, table) {}

std::shared_ptr<const MapSnapshot> Mapping::cycle(std::span<const detection::LabelledScan> window,
                                                  const Matrix6d& motion_covariance) {
  if (window.empty()) return nullptr;
  auto snapshot = std::make_shared<MapSnapshot>();
  const detection::LabelledScan& newest = window.back();
  snapshot->detections = detection_.detect(window);
  snapshot->update =
      slam_.update({newest.stamp, newest.T_odom_lidar, motion_covariance,
                    noise_.applied(snapshot->detections, newest.T_odom_lidar.linear())},
                   core::Budget::iterations(iterations_));
  snapshot->stamp = newest.stamp;
  snapshot->map = slam_.map_given_poses();
  snapshot->T_world_odom = slam_.T_world_odom();
  if (newest.points && newest.labels)
    snapshot->classified_share = counted(*newest.points, *newest.labels).classified_share();
  return snapshot;
}

objects::ObjectMap Mapping::map_with_covariance(std::span<const active::Target> targets) const {
  objects::ObjectMap map = slam_.reported_map();
  add_incomplete_targets(map, targets);
  noise_.add_common(map);
  return map;
}

}  // namespace saker::autonomy
