#include "saker/segmentation/range_image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "saker/lidar/rings.h"

namespace saker::segmentation {
namespace {

constexpr float kWideStep = 0.009F;  // rad, half way between 1024 and 512 columns

void clear(RangeImage& image, int rows, int columns, std::size_t points) {
  const std::size_t pixels = static_cast<std::size_t>(rows) * columns;
  image.rows = rows;
  image.columns = columns;
  image.points.assign(pixels, Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  image.range.assign(pixels, 0.0F);
  image.point.assign(pixels, -1);
  image.pixel.assign(points, -1);
}

/// The nearest point of a pixel is shown: it hides the others from the sensor's next beam.
void place(RangeImage& image, const lidar::Scan& scan, std::size_t i, int row, int column) {
  const float range = scan.points[i].norm();
  if (!std::isfinite(range) || range < kMinRange) return;
  const std::size_t pixel = static_cast<std::size_t>(row) * image.columns + column;
  image.pixel[i] = static_cast<std::int32_t>(pixel);
  if (image.valid(pixel) && image.range[pixel] <= range) return;
  image.points[pixel] = scan.points[i];
  image.range[pixel] = range;
  image.point[pixel] = static_cast<std::int32_t>(i);
}

int halvings(int n, int most) {
  int times = 0;
  while ((n >> times) > most) ++times;
  return times;
}

void project_organised(const lidar::Scan& scan, RangeImage& image) {
  const int row_shift = halvings(scan.rows, kMaxRows);
  const int column_shift = halvings(scan.columns, kMaxColumns);
  const int rows = ((scan.rows - 1) >> row_shift) + 1;
  const int columns = ((scan.columns - 1) >> column_shift) + 1;
  clear(image, rows, columns, scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const int row = static_cast<int>(i) / scan.columns;
    const int column = static_cast<int>(i) % scan.columns;
    place(image, scan, i, row >> row_shift, column >> column_shift);
  }
}

int column_of(float azimuth, int columns) {
  const float turn = 0.5F - azimuth * static_cast<float>(0.5 / std::numbers::pi);
  return std::clamp(static_cast<int>(turn * static_cast<float>(columns)), 0, columns - 1);
}

void project_unorganised(const lidar::Scan& scan, RangeImage& image) {
  const lidar::Rings rings = lidar::recover_rings(scan.points, scan.ring);
  const int shift = halvings(rings.count, kMaxRows);
  const int columns = rings.azimuth_step > kWideStep ? kMaxColumns / 2 : kMaxColumns;
  clear(image, ((rings.count - 1) >> shift) + 1, columns, scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (rings.of_point[i] < 0) continue;
    place(image, scan, i, rings.of_point[i] >> shift, column_of(rings.azimuth[i], columns));
  }
}

bool well_organised(const lidar::Scan& scan) {
  return scan.organised() && scan.columns > 0 &&
         scan.size() ==
             static_cast<std::size_t>(scan.rows) * static_cast<std::size_t>(scan.columns);
}

}  // namespace

void project(const lidar::Scan& scan, RangeImage& image) {
  if (scan.points.empty()) {
    clear(image, 0, 0, 0);
  } else if (well_organised(scan)) {
    project_organised(scan, image);
  } else {
    project_unorganised(scan, image);
  }
}

}  // namespace saker::segmentation
