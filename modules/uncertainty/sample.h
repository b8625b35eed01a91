#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "saker/objects/class_table.h"
#include "saker/objects/measurement.h"
#include "saker/uncertainty/view.h"

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
  double length_sd = NAN;  ///< m, that a cuboid's measurement states of its longer edge
  double width_sd = NAN;   ///< m, of its shorter one
};

/// The sample of a measurement of a true object; both models of one shape, in one frame with z up.
/// Each edge of a cuboid is compared with the true edge to which it is the more parallel, whichever
/// way round it was measured. Recording, object, kind, time and reflectivity are the caller's.
[[nodiscard]] Sample sample_of(const objects::Measurement& measurement,
                               const objects::Model& measured, const objects::Model& truth,
                               const Eigen::Vector3d& eye);

/// Whether the measurement showed the object from end to end: not of a cuboid that states more than
/// `most_length_sd_m` of its length. Unknown counts as shown.
[[nodiscard]] bool is_whole(const Sample& sample, double most_length_sd_m);

/// CSV with a header line; one line a sample, angles in radians, unknown numbers as nan. Throws
/// Error that names file, line and what was expected.
[[nodiscard]] std::vector<Sample> read_samples(const std::filesystem::path& file,
                                               const objects::ClassTable& table);
/// The same as text; throws Error on a name that a CSV cannot hold.
[[nodiscard]] std::string samples_text(const std::vector<Sample>& samples,
                                       const objects::ClassTable& table);

}  // namespace saker::uncertainty
