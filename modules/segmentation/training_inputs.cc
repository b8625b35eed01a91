/// The projection and the features for the training in Python (tools/training/inputs.py, by
/// ctypes): one definition for both. Arrays are the caller's, of the sizes said here.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "saker/segmentation/features.h"
#include "saker/segmentation/range_image.h"

using saker::segmentation::Features;
using saker::segmentation::RangeImage;

namespace {

/// Points x y z; an image of rows × columns where rows > 0.
saker::lidar::Scan scan_of(const float* points, int count, int rows, int columns) {
  saker::lidar::Scan scan;
  scan.rows = rows;
  scan.columns = columns;
  scan.points.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    scan.points[i] = {points[3 * i], points[3 * i + 1], points[3 * i + 2]};
  return scan;
}

}  // namespace

extern "C" {

/// An unorganised scan's image: `size` gets rows and columns, `point` (at least 80 × 1024) the
/// index of the point in each pixel or −1, `pixel` (count) the pixel of each point or −1. `ring`:
/// ring number of each point, or null.
void saker_project(const float* points, const std::uint16_t* ring, int count, int* size, int* point,
                   int* pixel) {
  RangeImage image;
  saker::lidar::Scan scan = scan_of(points, count, 0, 0);
  if (ring != nullptr) scan.ring.assign(ring, ring + count);
  saker::segmentation::project(scan, image);
  size[0] = image.rows;
  size[1] = image.columns;
  std::copy(image.point.begin(), image.point.end(), point);
  std::copy(image.pixel.begin(), image.pixel.end(), pixel);
}

/// Features of an image of points (NaN: no return), at most 80 × 1024: channels × rows × columns.
void saker_features(const float* points, int rows, int columns, float* features) {
  thread_local RangeImage image;
  thread_local Features computed;
  saker::segmentation::project(scan_of(points, rows * columns, rows, columns), image);
  const std::vector<float>& values = computed.compute(image);
  std::copy(values.begin(), values.end(), features);
}

int saker_channels() { return saker::segmentation::kChannelCount; }

const char* saker_channel_name(int channel) { return saker::segmentation::kChannels[channel]; }
}
