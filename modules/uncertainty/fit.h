#pragma once

#include <span>
#include <vector>

#include "saker/uncertainty/class_model.h"
#include "saker/uncertainty/random_effects.h"
#include "saker/uncertainty/sample.h"

/// From measurements beside the truth to models: the paper, "Uncertainty modeling".
///
/// Errors are those of measurements that showed an object from end to end: of the others detection
/// says itself which end is hidden. How often that is so from where is fitted beside them.
///
/// Confidence: a perceptron where it predicts held-out recordings better than a constant.
/// Errors: what is measured of one object from one cell is averaged to one draw; bias, covariance
/// and what an object's draws share are estimated together (random_effects.h), those of cuboids
/// about the truth. Elevation and reflectivity are taken in where they raise the likelihood of
/// held-out recordings.
namespace saker::uncertainty {

struct FitConfig {
  std::vector<double> range_edges_m = {2, 4, 6, 8, 10, 12, 15, 18, 22, 28, 36, 48};
  int sectors = 6;
  bool every_window = false;
  bool cuboid_bias = false;
  double whole_length_sd_m = 0.25;
  int least_objects = 10;
  int least_draws = 5;
  int folds = 5;
  double standard_errors = 2;
  RandomEffectsConfig errors;
  PerceptronConfig confidence;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("range_edges_m", range_edges_m, {0, 1000}, "m", "of the intervals of range, ascending");
    v.field("sectors", sectors, {2, 36}, "",
            "of the viewing angle between front and back, for cuboids: 30 degrees each");
    v.field("every_window", every_window, "",
            "whether every window counts, as in the paper, whatever of an object it showed");
    v.field("cuboid_bias", cuboid_bias, "",
            "whether cuboids have a bias that is taken off: the paper's hull leans inward; "
            "detection.fitter: faces gives means, and what they lean by is the sizes that flew");
    v.field("whole_length_sd_m", whole_length_sd_m, {0, 100}, "m",
            "a cuboid whose measurement states a worse length did not show both its ends, which "
            "detection gives up to 0.25 m, or 0.35 m and more");
    v.field("least_objects", least_objects, {2, 100000}, "", "of a class, below it is not fitted");
    v.field("least_draws", least_draws, {1, 100000}, "",
            "of objects in an interval, below it counts as not flown");
    v.field("folds", folds, {2, 100}, "", "of the recordings, to test on what was not fitted");
    v.field("standard_errors", standard_errors, {0, 10}, "",
            "by which an input must help on held-out recordings: chance in one of forty");
    v.group("errors", errors, "biases and covariances");
    v.group("confidence", confidence, "the multilayer perceptron");
  }

  static constexpr double kAnySd = 100;  ///< m: no measurement states more
  [[nodiscard]] double most_length_sd_m() const {
    return every_window ? kAnySd : whole_length_sd_m;
  }
};

/// One model a class that has samples, by ascending class. Throws Error where a class has too few
/// objects or the range edges do not ascend.
[[nodiscard]] std::vector<ClassModel> fit(std::span<const Sample> samples,
                                          const objects::ClassTable& table, const FitConfig& config,
                                          std::uint64_t seed);

/// The parts of fit(), for samples of one class.
[[nodiscard]] SemanticModel fit_semantic(std::span<const Sample> samples, const FitConfig& config,
                                         std::uint64_t seed, std::vector<Trial>& trials);
[[nodiscard]] GeometricModel fit_geometric(std::span<const Sample> samples,
                                           const Intervals& intervals, const FitConfig& config,
                                           std::vector<Trial>& trials);

}  // namespace saker::uncertainty
