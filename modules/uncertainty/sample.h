#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "objects/class_table.h"
#include "objects/measurement.h"
#include "uncertainty/view.h"

namespace saker::uncertainty {

/// A measurement beside the truth: what the models are fitted to.
struct Sample {
  std::string recording;  ///< flight or recording that it comes from
  int object_id = -1;     ///< of the truth in it
  std::string kind;       ///< of the true object, where known: "sedan", "van", "trunk"
  objects::ClassId class_id = 0;
  double time_s = NAN;      ///< since the recording's first scan
  View view;                ///< of the true object
  int points = 0;           ///< that the model was fitted to
  double confidence = NAN;  ///< mean probability of its class over the points in the model
  /// Measured − true. Cuboid: [x, y, length, width] in the true object's frame, m. Cylinder: [x,
  /// y], x along the line of sight away from the lidar, y to its left, m.
  Eigen::VectorXd error;
};

/// The sample of a measurement of a true object; both models in one frame with z up.
/// A cuboid that is measured the wrong way round is turned to the nearer of its two headings first.
[[nodiscard]] Sample sample_of(const objects::Measurement& measurement,
                               const objects::Model& measured, const objects::Model& truth,
                               const Eigen::Vector3d& eye);

/// CSV with a header line; one line a sample. Errors name file, line and what was expected.
[[nodiscard]] std::vector<Sample> read_samples(const std::filesystem::path& file,
                                               const objects::ClassTable& table);
[[nodiscard]] std::string samples_text(const std::vector<Sample>& samples,
                                       const objects::ClassTable& table);

}  // namespace saker::uncertainty
