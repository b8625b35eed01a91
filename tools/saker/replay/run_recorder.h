#pragma once

#include <filesystem>
#include <string>

#include "flight/run_files/detections_file.h"
#include "saker/autonomy/lockstep.h"
#include "tools/saker/replay/sparse_cloud.h"

/// What a run over a recording leaves behind, as in docs/contract.md.
namespace saker::tools {

/// Hears a lockstep run: streams detections to OUT/detections.jsonl, keeps what the trajectory
/// files and the picture need.
class RunRecorder : public autonomy::LockstepObserver {
 public:
  /// Throws Error where OUT cannot be written.
  RunRecorder(const std::filesystem::path& out, const objects::ClassTable& table);

  void on_scan(const autonomy::ScanRecord& record,
               const odometry::OdometryEstimate& estimate) override;
  void on_detections(const objects::Detections& detections) override;

  /// trajectory.txt, odometry.txt, map.json, map.smap; closes detections.jsonl.
  void write(const autonomy::LockstepResult& result);

  /// Measurements of objects, in all windows.
  [[nodiscard]] int detections() const { return count_; }

  /// Some points of each scan: what the picture shows behind the objects.
  [[nodiscard]] const SparseCloud& cloud() const { return cloud_; }

 private:
  std::filesystem::path out_;
  const objects::ClassTable& table_;
  flight::DetectionsWriter detections_;
  int count_ = 0;  // of detections
  SparseCloud cloud_{400};
};

/// A TUM row `t x y z qx qy qz qw`.
[[nodiscard]] std::string tum_row(Time stamp, const SE3& T);

}  // namespace saker::tools
