#pragma once

#include <Eigen/Core>

#include "saker/core/time.h"

/// What is predicted of a viewpoint before it is flown to, and compared once it was: its
/// calibration can be measured.
namespace saker::active {

/// What was predicted of a viewpoint before it was flown to.
struct Expectation {
  int viewpoint_id = -1;
  int target_id = -1;
  int object_id = -1;          ///< of the mapped object
  Time seen_until = 0;         ///< its target from there, once it was flown to
  double gain = NAN;           ///< nat, off the entropies of all targets that are seen from there
  Eigen::MatrixXd covariance;  ///< after it, as uncertainty::Prediction's and with the common part
};

}  // namespace saker::active
