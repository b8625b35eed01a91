#pragma once

#include <spdlog/logger.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "flight/run_files/detections_file.h"
#include "saker/autonomy/mission_lockstep.h"
#include "saker/core/progress.h"
#include "saker/simulation/vehicle/simulated_vehicle.h"
#include "tools/saker/experiment/viewpoint_log.h"
#include "tools/saker/record/run_recording.h"
#include "tools/saker/replay/sparse_cloud.h"
#include "tools/saker/replay/trajectory_truth.h"

namespace saker::tools {

/// Hears a mission: logs every transition, counts refusals by their cause, keeps what the picture
/// and the comparison with the truth need; streams detections to OUT/detections.jsonl.
class MissionRecorder : public autonomy::MissionObserver {
 public:
  /// \param most_scans  of the longest mission: room for what it keeps of them is taken at once
  /// \param progress    over the targets; none where several missions go side by side
  /// Throws Error where OUT cannot be written.
  MissionRecorder(simulation::SimulatedVehicle& vehicle, const std::filesystem::path& out,
                  const objects::ClassTable& table, std::shared_ptr<spdlog::logger> log,
                  core::Progress* progress, std::size_t most_scans);

  /// Scans go into it, too, from now on. \param recording  outlives this; null: none
  void record_into(RunRecording* recording) { recording_ = recording; }

  void on_scan(const autonomy::IngestedScan& scan) override;
  void on_map(const autonomy::MapSnapshot& map) override;
  void on_plan(const autonomy::PlanningReport& report, const active::ActivePlan& plan) override;
  void on_event(const autonomy::MissionEvent& event) override;

  /// What was predicted of viewpoints, and what came of it.
  [[nodiscard]] const ViewpointLog& viewpoints() const { return viewpoints_; }
  /// That were flown to, and since when, in their order.
  [[nodiscard]] const std::vector<std::pair<Time, active::Viewpoint>>& flown_to() const {
    return flown_to_;
  }
  /// T_world_lidar as it truly was, at the stamps of the scans.
  [[nodiscard]] const std::vector<StampedPose>& true_poses() const { return true_poses_; }
  /// Some points of each scan.
  [[nodiscard]] const SparseCloud& cloud() const { return cloud_; }
  void finish() { detections_.finish(); }  ///< throws Error when not all could be written
  /// {"refusals": {cause: number}, "events": [{"t_s", "from", "to", "cause", "text"}]}
  [[nodiscard]] nlohmann::ordered_json record() const;

 private:
  simulation::SimulatedVehicle& vehicle_;
  Time start_;
  objects::ObjectMap truth_;
  flight::DetectionsWriter detections_;
  ViewpointLog viewpoints_;
  std::shared_ptr<spdlog::logger> log_;
  core::Progress* progress_;
  RunRecording* recording_ = nullptr;
  SparseCloud cloud_{150};
  std::vector<StampedPose> true_poses_;
  std::vector<std::pair<Time, active::Viewpoint>> flown_to_;
  std::map<std::string, int> refusals_;
  nlohmann::ordered_json events_ = nlohmann::ordered_json::array();
  long events_left_out_ = 0;
};

}  // namespace saker::tools
