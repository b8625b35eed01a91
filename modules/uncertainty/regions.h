#pragma once

#include <Eigen/Core>

#include "saker/core/config.h"
#include "saker/uncertainty/uncertainty.h"

namespace saker::uncertainty {

struct RegionConfig {
  double confidence = 0.95;
  double probability = 0.95;
  double place_error_m = 0.1;
  double size_error_m = 0.2;
  double best_share = 0.25;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("confidence", confidence, {0, 1}, "",
            "of the class, from which on a view is of high confidence: the paper's");
    v.field("probability", probability, {0, 1}, "",
            "of small errors, from which on a view is of low geometric uncertainty: the paper's");
    v.field("place_error_m", place_error_m, {0.001, 10}, "m",
            "what a small error of place is: the paper's");
    v.field("size_error_m", size_error_m, {0.001, 10}, "m",
            "what a small error of length and of width is: the paper's");
    v.field("best_share", best_share, {0.01, 1}, "",
            "of all views that were flown: the region, where no view reaches the paper's value");
  }
};

/// The paper's regions around one object of a class: views of high confidence, and views of low
/// geometric uncertainty (small errors of place and size with high probability, the bias taken
/// off). Where no view that was flown reaches the threshold, the best share of the views instead.
///
/// The probability is Gaussian, over 512 fixed draws: the same for the same view, to about 0.01.
/// The model must outlive this. Cost: one prediction and a sum over fixed draws a view.
class Regions {
 public:
  /// Throws Error on a class that the model does not know.
  Regions(const RegionConfig& config, const Model& model, objects::ClassId id);

  [[nodiscard]] bool confident(const View& view) const;  ///< of high confidence
  [[nodiscard]] bool precise(const View& view) const;    ///< of low geometric uncertainty
  /// Of both, and flown.
  [[nodiscard]] bool contains(const View& view) const;

  /// That this view alone shows the object from end to end, with place errors < place_error_m and
  /// size errors < size_error_m.
  [[nodiscard]] double small_error_probability(const View& view) const;

  /// The thresholds in force, and whether they are the paper's or the best share's.
  [[nodiscard]] double least_confidence() const { return least_confidence_; }
  [[nodiscard]] double least_probability() const { return least_probability_; }
  [[nodiscard]] bool relative_confidence() const { return least_confidence_ < config_.confidence; }
  [[nodiscard]] bool relative_probability() const {
    return least_probability_ < config_.probability;
  }

 private:
  [[nodiscard]] double small_error_probability(const Prediction& prediction) const;

  RegionConfig config_;
  const Model* model_;
  objects::ClassId id_;
  Eigen::MatrixXd draws_;  ///< of a standard normal distribution, one a column
  double least_confidence_ = NAN;
  double least_probability_ = NAN;
};

}  // namespace saker::uncertainty
