#pragma once

#include "saker/core/se3.h"
#include "saker/objects/models.h"

namespace saker::slam {

struct HiddenEndConfig {
  bool enabled = true;
  double sds = 1;
  double most_m = 1.5;

  template <class Visitor>
  void visit(Visitor& v) {
    v.field("enabled", enabled, "", "whether ends may be hidden; else equation 1 is as it is");
    v.field("sds", sds, {0.1, 1e9}, "",
            "standard deviations by which an end may lie farther out than it was measured before "
            "it counts as hidden: windows that lose an end lose half a metre and more");
    v.field("most_m", most_m, {0, 20}, "m",
            "that a hidden end may take from a vehicle; what lies farther out is weighed in full: "
            "a third of a car, less than to the far end of the next one in a row");
  }
};

/// The error of a cuboid, estimated − measured, [rotation, translation, size] in the measured
/// cuboid's own frame (equation 1), as it is weighed. What was seen of a vehicle is there; what
/// hides an end, or loses its points, only takes away. So an end that lies farther in than it was
/// measured has the Gaussian's error, and one that lies farther out a heavy tail's: Cauchy's, from
/// `sds` standard deviations of that end on. Beyond `most_m` the error grows in full again: what is
/// missing there is another vehicle. Ends are those of the longer side: sides stand so near
/// to neighbours' that a box as wide as two would fit both. One-sided errors are those of a
/// frontier (Aigner, Lovell and Schmidt, "Formulation and Estimation of Stochastic Frontier
/// Production Function Models", Journal of Econometrics 1977).
class HiddenEnds {
 public:
  /// \param covariance of the measurement, in its own frame
  HiddenEnds(const objects::Cuboid& measured, const Matrix9d& covariance,
             const HiddenEndConfig& config);

  struct Softened {
    Vector9d error;
    Matrix9d slope;   ///< of `error`, by the error that came in
    Matrix9d secant;  ///< times the error that came in is `error`
  };
  [[nodiscard]] Softened operator()(const Vector9d& error) const;

 private:
  int longer_;  ///< 0: x, 1: y
  double most_m_;
  Eigen::Vector2d scale_;  ///< m, low and high end: where its tail begins
};

}  // namespace saker::slam
