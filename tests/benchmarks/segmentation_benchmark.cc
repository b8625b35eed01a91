#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "saker/segmentation/segmentation.h"

namespace saker::segmentation {
namespace {

/// 64 beams in a yard of 15 m: ground and a wall, every pixel a return.
lidar::Scan yard(int columns) {
  constexpr double kPi = std::numbers::pi;
  lidar::Scan scan;
  scan.rows = 64;
  scan.columns = columns;
  for (int row = 0; row < scan.rows; ++row) {
    const double elevation = (22.5 - 45.0 * row / (scan.rows - 1)) * kPi / 180;
    for (int column = 0; column < columns; ++column) {
      const double azimuth = kPi - 2 * kPi * (column + 0.5) / columns;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const double wall = 15 / std::cos(elevation), ground = ray.z() < 0 ? -2 / ray.z() : 1e9;
      scan.points.push_back((std::min(wall, ground) * ray).cast<float>());
    }
  }
  return scan;
}

/// Unorganised points, so that their beams are sought too.
lidar::Scan unorganised(lidar::Scan scan) {
  scan.rows = scan.columns = 0;
  return scan;
}

void segment(benchmark::State& state, const lidar::Scan& scan) {
  Segmentation segmentation({}, {});
  for (auto _ : state) benchmark::DoNotOptimize(segmentation.segment(scan));
}

BENCHMARK_CAPTURE(segment, organised_64x1024, yard(1024))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(segment, organised_64x512, yard(512))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(segment, file_of_131072_points, unorganised(yard(2048)))
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace saker::segmentation
