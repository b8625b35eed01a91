#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "saker/objects/class_table.h"
#include "saker/uncertainty/class_model.h"
#include "saker/uncertainty/view.h"

/// What a measurement of an object is worth, by where it is seen from — reads a model file that
/// `saker characterise fit` made from flights; makes the confidence of its class, the bias and the
/// covariance of its model, for SLAM (noise of what was measured) and for active mapping (what a
/// viewpoint will tell).
///
/// Method: the paper, "Uncertainty modeling": f^s and f^g. Cost: a prediction
/// evaluates a dozen splines.
namespace saker::uncertainty {

/// What to expect of a measurement of one object from one view.
struct Prediction {
  double confidence = NAN;     ///< f^s: mean probability of its class over the points in the model
  Eigen::VectorXd bias;        ///< measured − true, as Sample::error: 4 or 2; of whole ones
  Eigen::MatrixXd covariance;  ///< f^g: about the bias, same order: 4×4 or 2×2; positive definite
  double whole = 1;            ///< share of measurements that show the object from end to end
  bool extrapolated = false;   ///< outside of what was flown: the nearest interval's values
  int cell = -1;               ///< the interval of range and angle. What is measured of one object
                               ///< from one cell shares its error: together it counts once
};

/// Where a model comes from.
struct Provenance {
  std::string data;        ///< what was flown: kinds, worlds, seeds
  std::string sensor;      ///< and its mode
  std::string commit;      ///< of the program that flew
  std::uint64_t seed = 0;  ///< of the fit
};

/// The fitted models of all classes, for one sensor. A value.
class Model {
 public:
  Model() = default;  ///< knows no class
  explicit Model(const std::vector<ClassModel>& classes, Provenance provenance = {});

  /// Throws Error on a file that is missing, cut, of another version, or whose classes or numbers
  /// are not valid.
  [[nodiscard]] static Model load(const std::filesystem::path& file,
                                  const objects::ClassTable& table);
  /// Throws Error where the file cannot be written.
  void save(const std::filesystem::path& file, const objects::ClassTable& table) const;

  [[nodiscard]] bool knows(objects::ClassId id) const { return classes_.contains(id); }

  /// Requires knows(id) and a finite range and angle; unknown elevation and reflectivity are
  /// averaged over.
  [[nodiscard]] Prediction predict(objects::ClassId id, const View& view) const;

  /// The same model where nobody takes the bias off a measurement: errors are about the truth, not
  /// about the bias, which is part of the covariance.
  [[nodiscard]] Model about_truth() const;

  /// What all views of one object have in common (its shape is no box), in the order of
  /// Prediction::covariance: no number of cells takes it away. After views from cells C the error's
  /// covariance is (Σ_C covariance⁻¹)⁻¹ + common.
  [[nodiscard]] const Eigen::MatrixXd& common_covariance(objects::ClassId id) const;

  /// What was fitted: its intervals, counts and trials. Requires knows(id).
  [[nodiscard]] const ClassModel& of(objects::ClassId id) const { return classes_.at(id); }
  [[nodiscard]] const std::map<objects::ClassId, ClassModel>& classes() const { return classes_; }
  [[nodiscard]] const Provenance& provenance() const { return provenance_; }

 private:
  std::map<objects::ClassId, ClassModel> classes_;
  Provenance provenance_;
  bool bias_stays_ = false;
};

}  // namespace saker::uncertainty
