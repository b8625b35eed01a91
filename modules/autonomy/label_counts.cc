#include "saker/autonomy/label_counts.h"

#include <algorithm>
#include <cmath>

#include "saker/objects/class_table.h"

namespace saker::autonomy {
namespace {

constexpr objects::ClassId kOther = 0;  // objects::ClassTable

}  // namespace

LabelCounts counted(std::span<const Eigen::Vector3f> points, const lidar::Labels& labels) {
  LabelCounts counts;
  const std::size_t count =
      std::min({points.size(), labels.classes.size(), labels.probability.size()});
  for (std::size_t i = 0; i < count; ++i) {
    if (!points[i].allFinite()) continue;
    ++counts.points;
    counts.classified += labels.classes[i] != kOther;
    counts.probability_millionths += std::lround(1e6 * labels.probability[i]);
  }
  return counts;
}

}  // namespace saker::autonomy
