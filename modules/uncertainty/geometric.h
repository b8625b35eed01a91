#pragma once

#include <Eigen/Core>
#include <vector>

#include "saker/uncertainty/covariate.h"
#include "saker/uncertainty/spline.h"

namespace saker::uncertainty {

/// f^g of the paper: bias and covariance of an object's measured model by where it is seen from,
/// splined over intervals of range and |angle|. Errors are those of Sample::error, as if seen from
/// the left, of measurements that showed the object from end to end.
class GeometricModel {
 public:
  /// What was fitted to the measurements of one interval.
  struct Interval {
    Eigen::VectorXd bias;
    Eigen::MatrixXd covariance;      ///< of the mean of one object's measurements, about the bias
    Eigen::VectorXd covariate_mean;  ///< one a covariate
    double whole = 1;  ///< share of an object's measurements that show it from end to end
    int objects = 0;   ///< draws: objects, each side its own; 0: the values are the nearest one's
  };

  /// How a further input moves bias and covariance, a standard deviation of it.
  struct Slope {
    Covariate covariate = Covariate::elevation;
    double spread = NAN;
    Eigen::VectorXd bias;
    double log_scale = NAN;  ///< of the covariance
  };

  struct Parts {
    Intervals intervals;
    std::vector<Interval> fitted;  ///< one an interval
    Eigen::MatrixXd common;        ///< what all views of one object share, in the object's frame
    std::vector<Slope> slopes;
    double whole_length_sd_m = 0;  ///< that a cuboid's measurement may state of its length
  };

  struct Expected {
    Eigen::VectorXd bias;
    Eigen::MatrixXd covariance;
    double whole = 1;
    bool extrapolated = false;
  };

  GeometricModel() = default;
  /// Requires one fitted interval an interval, all of one dimension, covariances positive definite.
  explicit GeometricModel(Parts parts);

  [[nodiscard]] Expected expected(const View& view) const;
  [[nodiscard]] const Parts& parts() const { return parts_; }

 private:
  Parts parts_;
  SplineSurface surface_;  ///< of bias, logarithmic Cholesky factor, share and covariates' means
};

/// Sign of each entry of an error under the mirror that takes right to left: −1 for y of cuboids.
[[nodiscard]] Eigen::VectorXd mirror(Eigen::Index dimension, int sectors);

/// How far a slope moves each entry of a bias from a view: where the mirror changes the sign it
/// vanishes in the plane of symmetry.
[[nodiscard]] Eigen::VectorXd reach_of_slope(const Eigen::VectorXd& parity, double angle);

}  // namespace saker::uncertainty
