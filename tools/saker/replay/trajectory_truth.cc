#include "tools/saker/replay/trajectory_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "saker/objects/map_io.h"

namespace saker::tools {
Truth read_truth(const std::filesystem::path& file, const objects::ClassTable& table) {
  Truth truth;
  truth.map = objects::read_map(file, table);
  const auto trajectory = file.parent_path() / "trajectory_truth.txt";
  if (std::filesystem::exists(trajectory)) truth.trajectory = read_trajectory(trajectory);
  return truth;
}

nlohmann::json trajectory_figures(std::span<const autonomy::ScanRecord> scans,
                                  std::span<const SE3> T_world_lidar,
                                  const std::vector<StampedPose>& truth) {
  double square = 0, greatest = 0, angle_square = 0;
  int compared = 0;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const StampedPose* pose = pose_at(truth, to_seconds(scans[i].stamp));
    if (pose == nullptr) continue;
    const SE3 error = pose->T_world_lidar.inverse() * T_world_lidar[i];
    square += error.translation().squaredNorm();
    greatest = std::max(greatest, error.translation().norm());
    angle_square += core::so3_log(error.linear()).squaredNorm();
    ++compared;
  }
  if (compared == 0) return nullptr;
  return {{"scans_compared", compared},
          {"position_rmse_m", std::sqrt(square / compared)},
          {"position_max_m", greatest},
          {"rotation_rmse_deg", std::sqrt(angle_square / compared) * 180 / std::numbers::pi}};
}

}  // namespace saker::tools
