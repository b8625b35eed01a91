#include "flight/run_files/trajectory_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "saker/core/error.h"

namespace saker::flight {
namespace {

constexpr double kSameStamp_s = 1e-3;

}  // namespace

const StampedPose* pose_at(const std::vector<StampedPose>& poses, double t) {
  const auto found = std::ranges::lower_bound(poses, t - kSameStamp_s, {}, &StampedPose::t);
  return found != poses.end() && found->t <= t + kSameStamp_s ? &*found : nullptr;
}

std::vector<StampedPose> read_trajectory(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<StampedPose> poses;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream row(line);
    StampedPose pose;
    Eigen::Vector3d p;
    Eigen::Vector4d q;
    if (!(row >> pose.t >> p.x() >> p.y() >> p.z() >> q[0] >> q[1] >> q[2] >> q[3])) {
      throw Error(
          fmt::format("{}:{}: expected eight numbers t x y z qx qy qz qw", file.string(), number));
    }
    pose.T_world_lidar.linear() = Eigen::Quaterniond(q).normalized().toRotationMatrix();
    pose.T_world_lidar.translation() = p;
    poses.push_back(pose);
  }
  std::ranges::sort(poses, {}, &StampedPose::t);
  return poses;
}

}  // namespace saker::flight
