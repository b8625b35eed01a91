#include "tools/saker/evaluate/segmentation_figures.h"

#include <algorithm>
#include <cmath>

namespace saker::tools {
namespace {

constexpr std::array<std::uint32_t, 5> kUncounted = {0, 1, 52, 81, 99};
constexpr std::uint32_t kIds = 1U << 16;

double ratio(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : NAN;
}

std::size_t bin_of(double probability) {
  constexpr double kBins = SegmentationFigures::kBins;
  return static_cast<std::size_t>(std::clamp(probability * kBins, 0.0, kBins - 1));
}

}  // namespace

double ClassPoints::iou() const {
  return labelled > 0 ? ratio(both, labelled + predicted - both) : NAN;
}
double ClassPoints::precision() const { return ratio(both, predicted); }
double ClassPoints::recall() const { return ratio(both, labelled); }

SegmentationFigures::SegmentationFigures(const objects::ClassTable& table)
    : table_(table), class_of_(kIds), counts_(kIds, true), classes_(table.classes.size()) {
  for (std::uint32_t id = 0; id < kIds; ++id) class_of_[id] = table.of_label(id);
  for (const std::uint32_t id : kUncounted) counts_[id] = class_of_[id] != 0;
}

bool SegmentationFigures::counts(std::uint32_t id) const { return counts_[id & 0xFFFF]; }

objects::ClassId SegmentationFigures::class_of(std::uint32_t id) const {
  return class_of_[id & 0xFFFF];
}

void SegmentationFigures::add(const lidar::Labels& predicted, std::span<const std::uint32_t> ids) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::uint32_t id = ids[i] & 0xFFFF;
    if (!counts_[id]) continue;
    const objects::ClassId expected = class_of_[id], found = predicted.classes[i];
    const bool right = expected == found;
    ++classes_[expected].labelled;
    ++classes_[found].predicted;
    classes_[found].both += right;
    ProbabilityBin& bin = bins_[bin_of(predicted.probability[i])];
    ++bin.points;
    bin.right += right;
    bin.sum += predicted.probability[i];
    if (table_[expected].shape == objects::Shape::none) continue;
    LabelPoints& label = labels_[id];
    label.class_id = expected;
    ++label.points;
    label.right += right;
  }
}

double SegmentationFigures::expected_calibration_error() const {
  double distance = 0;
  std::int64_t points = 0;
  for (const ProbabilityBin& bin : bins_) {
    distance += std::abs(static_cast<double>(bin.right) - bin.sum);
    points += bin.points;
  }
  return points > 0 ? distance / static_cast<double>(points) : NAN;
}

}  // namespace saker::tools
