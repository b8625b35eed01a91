#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "saker/lidar/scan.h"
#include "saker/objects/class_table.h"

/// Predicted classes of points against labelled ones. Reads labels of scans (segmentation) and
/// SemanticKITTI ids (a person's); makes counts per class and per id, and how far stated
/// probabilities can be trusted. Method: intersection over union as SemanticKITTI counts it (Behley
/// et al., ICCV 2019); expected calibration error over equal bins (Guo et al., ICML 2017). Cost:
/// 1 ms for a scan of 120,000 points.
namespace saker::tools {

/// Points of one class over all scans.
struct ClassPoints {
  std::int64_t labelled = 0;   ///< of this class by their label
  std::int64_t predicted = 0;  ///< of this class by the segmentation
  std::int64_t both = 0;

  [[nodiscard]] double iou() const;        ///< NaN where nothing is labelled
  [[nodiscard]] double precision() const;  ///< NaN where nothing is predicted
  [[nodiscard]] double recall() const;     ///< NaN where nothing is labelled
};

/// Points whose stated probability lies in one bin.
struct ProbabilityBin {
  std::int64_t points = 0;
  std::int64_t right = 0;
  double sum = 0;  ///< of the stated probabilities
};

/// Points of one SemanticKITTI id whose class has a shape: how many are called that class.
struct LabelPoints {
  objects::ClassId class_id = 0;
  std::int64_t points = 0;
  std::int64_t right = 0;
};

class SegmentationFigures {
 public:
  static constexpr std::size_t kBins = 15;

  explicit SegmentationFigures(const objects::ClassTable& table);

  /// One id a point, in the order of the labels. Ids that count nowhere: see `counts`.
  void add(const lidar::Labels& predicted, std::span<const std::uint32_t> ids);

  /// Unlabelled (0), outlier (1), other structure (52), traffic sign (81) and other object (99) do
  /// not count, unless a class of the table other than the first merges the id.
  [[nodiscard]] bool counts(std::uint32_t id) const;
  [[nodiscard]] objects::ClassId class_of(std::uint32_t id) const;

  [[nodiscard]] const std::vector<ClassPoints>& classes() const { return classes_; }
  [[nodiscard]] const std::map<std::uint32_t, LabelPoints>& labels() const { return labels_; }
  [[nodiscard]] const std::array<ProbabilityBin, kBins>& bins() const { return bins_; }

  /// Mean distance of the share that is right from the stated probability, weighted by points; NaN
  /// of no points.
  [[nodiscard]] double expected_calibration_error() const;

 private:
  const objects::ClassTable& table_;
  std::vector<objects::ClassId> class_of_;  ///< of every id of 16 bits
  std::vector<bool> counts_;                ///< of every id of 16 bits
  std::vector<ClassPoints> classes_;        ///< in the order of the table
  std::map<std::uint32_t, LabelPoints> labels_;
  std::array<ProbabilityBin, kBins> bins_{};
};

}  // namespace saker::tools
