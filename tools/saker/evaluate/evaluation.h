#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/saker/evaluate/box_figures.h"
#include "tools/saker/evaluate/segmentation_figures.h"
#include "tools/saker/picture/evaluation_picture.h"

/// What `saker evaluate` says of a folder: the figures of all its scans, as JSON and as text.
namespace saker::tools {

class Evaluation {
 public:
  static constexpr std::size_t kPictures = 8;

  explicit Evaluation(const objects::ClassTable& table) : table_(table), points_(table) {}

  /// One scan, as segmented in `ms`. \param ids  one a point, or null. \param boxes  or null.
  void add(const std::string& name, const lidar::Scan& scan, const lidar::Labels& labels,
           const std::vector<std::uint32_t>* ids, const std::vector<LabelledBox>* boxes,
           std::optional<float> half_angle_deg, double ms);

  [[nodiscard]] std::size_t scans() const { return ms_.size(); }
  [[nodiscard]] const std::vector<EvaluatedScan>& worst() const { return worst_.scans(); }
  [[nodiscard]] nlohmann::ordered_json json() const;

 private:
  [[nodiscard]] bool is_vehicle(objects::ClassId id) const;
  [[nodiscard]] std::vector<bool> called(const lidar::Labels& labels) const;

  const objects::ClassTable& table_;
  SegmentationFigures points_;
  BoxFigures boxes_;
  WorstScans worst_{kPictures};
  std::vector<double> ms_;
  bool has_labels_ = false, has_boxes_ = false;
};

/// Tables for people of what `Evaluation::json` gives.
[[nodiscard]] std::string evaluation_text(const nlohmann::ordered_json& figures);

/// The same of `window_json` (window_figures.h).
[[nodiscard]] std::string window_text(const nlohmann::ordered_json& windows);

}  // namespace saker::tools
