#include "tools/saker/replay/run_recorder.h"

#include <fmt/format.h>

#include "saker/core/files.h"
#include "saker/objects/map_document.h"
#include "saker/objects/map_io.h"

namespace saker::tools {
namespace {

constexpr std::size_t kPointsPerScan = 400;  // enough to see walls after a few scans
constexpr std::size_t kMostPoints =
    1'000'000;  // 12 MB; after it the picture's background stops growing

/// The map's JSON, with a list of its own for what is tentative: readers of maps pass it over.
std::string json_with_tentative(const autonomy::LockstepResult& result,
                                const objects::ClassTable& table) {
  if (result.tentative.empty()) return objects::to_json(result.map, table);
  objects::Document document = objects::to_document(result.map, table);
  const objects::ObjectMap tentative{.objects = result.tentative, .ground = {}};
  document["tentative"] = objects::to_document(tentative, table)["objects"];
  return document.dump(1) + "\n";
}

}  // namespace

std::string tum_row(Time stamp, const SE3& T) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d& t = T.translation();
  return fmt::format("{:.6f} {:.6f} {:.6f} {:.6f} {:.9f} {:.9f} {:.9f} {:.9f}\n", to_seconds(stamp),
                     t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
}

RunRecorder::RunRecorder(const std::filesystem::path& out, const objects::ClassTable& table)
    : out_(out), table_(table), detections_(out, table) {}

void RunRecorder::on_scan(const autonomy::ScanRecord&, const odometry::OdometryEstimate& estimate) {
  const std::size_t stride = std::max<std::size_t>(estimate.points.size() / kPointsPerScan, 1);
  for (std::size_t i = 0; i < estimate.points.size() && cloud_.size() < kMostPoints; i += stride) {
    if (estimate.points[i].allFinite()) cloud_.push_back({scans_, estimate.points[i]});
  }
  ++scans_;
}

void RunRecorder::on_detections(const objects::Detections& detections) {
  detections_.add(detections);
  count_ += static_cast<int>(detections.measurements.size());
}

void RunRecorder::write(const autonomy::LockstepResult& result) {
  detections_.finish();
  std::string trajectory, odometry;
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    trajectory += tum_row(result.scans[i].stamp, result.T_world_lidar[i]);
    odometry += tum_row(result.scans[i].stamp, result.scans[i].T_odom_lidar);
  }
  core::write_file(out_ / "trajectory.txt", trajectory);
  core::write_file(out_ / "odometry.txt", odometry);
  core::write_file(out_ / "map.json", json_with_tentative(result, table_));
  objects::write_map(out_ / "map.smap", result.map, table_);
}

std::vector<Eigen::Vector3d> RunRecorder::cloud(const autonomy::LockstepResult& result) const {
  std::vector<Eigen::Vector3d> points;
  points.reserve(cloud_.size());
  for (const SparsePoint& p : cloud_) {
    points.emplace_back(result.T_world_lidar[p.scan] * p.in_lidar.cast<double>());
  }
  return points;
}

}  // namespace saker::tools
