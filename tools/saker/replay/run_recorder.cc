#include "tools/saker/replay/run_recorder.h"

#include <fmt/format.h>

#include "saker/core/files.h"
#include "saker/objects/map_document.h"
#include "saker/objects/map_io.h"

namespace saker::tools {
namespace {

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
  cloud_.add(estimate.points);
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

}  // namespace saker::tools
