// Registers a recording, scan by scan, and prints its trajectory as TUM rows: t x y z qx qy qz qw.
//   register_scans RECORDING > trajectory.txt
#include <saker/lidar/recording.h>
#include <saker/odometry/odometry.h>

#include <cstdio>
#include <exception>

namespace {

void print_row(const saker::odometry::OdometryEstimate& estimate) {
  const Eigen::Vector3d t = estimate.T_odom_lidar.translation();
  const Eigen::Quaterniond q(estimate.T_odom_lidar.linear());
  std::printf("%.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f\n", 1e-9 * double(estimate.stamp), t.x(),
              t.y(), t.z(), q.x(), q.y(), q.z(), q.w());
}

int run(const char* recording) {
  const auto source = saker::lidar::open_recording(recording);
  saker::odometry::Odometry odometry({});
  int predicted = 0;
  while (const auto frame = source->next()) {
    if (!frame->fault.empty()) {
      std::fprintf(stderr, "%s: %s\n", frame->name.c_str(), frame->fault.c_str());
      continue;
    }
    const auto estimate = odometry.register_scan(frame->scan, frame->imu);
    if (estimate.status == saker::odometry::OdometryStatus::refused) continue;
    if (estimate.status == saker::odometry::OdometryStatus::predicted) ++predicted;
    print_row(estimate);
  }
  if (predicted > 0) std::fprintf(stderr, "%d scans did not fit: predicted\n", predicted);
  return predicted > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc == 2) return run(argv[1]);
  std::fprintf(stderr, "usage: register_scans RECORDING\n");
  return 2;
} catch (const std::exception& error) {
  std::fprintf(stderr, "register_scans: %s\n", error.what());
  return 2;
}
