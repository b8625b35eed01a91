#pragma once

#include <string>
#include <vector>

#include "saker/objects/class_table.h"
#include "saker/uncertainty/geometric.h"
#include "saker/uncertainty/semantic.h"

namespace saker::uncertainty {

/// Whether a further input helped on recordings that the fit had not seen.
struct Trial {
  std::string what;
  double gain = NAN;            ///< mean a recording: log-likelihood, or squared error less
  double standard_error = NAN;  ///< of the gain
  bool kept = false;
};

/// What was fitted to the samples of one class.
struct ClassModel {
  objects::ClassId id = 0;
  SemanticModel semantic;
  GeometricModel geometric;
  std::vector<Trial> trials;
  int recordings = 0;
  int objects = 0;
  int samples = 0;
};

}  // namespace saker::uncertainty
