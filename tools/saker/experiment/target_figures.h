#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "saker/objects/class_table.h"
#include "saker/objects/object_map.h"

namespace saker::tools {

using Json = nlohmann::ordered_json;

/// A figure of too few objects is null.
[[nodiscard]] Json number(double value);

/// Errors of length and width of those true objects of `targets` (ids) that were found:
/// {"targets", "found", "bias_m", "sd_m", "mae_m", "size_nees", "place_nees", "errors": [{"id",
/// "length_m", "width_m", "distance_m", "size_nees", "place_nees"}]}; error = mapped − true; NEES a
/// degree of freedom as in objects/consistency.h; null where there are too few.
[[nodiscard]] Json target_figures(const objects::ObjectMap& mapped, const objects::ObjectMap& truth,
                                  const std::vector<int>& targets,
                                  const objects::ClassTable& table);

/// How honest the covariances of a whole map are, by class of cuboids or cylinders of which any
/// object was found: {"vehicle": {"objects", "size_nees", "place_nees"}}, objects counted
/// where there is a covariance.
[[nodiscard]] Json consistency_figures(const objects::ObjectMap& mapped,
                                       const objects::ObjectMap& truth,
                                       const objects::ClassTable& table);

/// How many objects of each class the whole map has: {"vehicle": {"mapped", "invented",
/// "duplicates"}}, counted as in objects/comparison.h.
[[nodiscard]] Json class_counts(const objects::ObjectMap& mapped, const objects::ObjectMap& truth,
                                const objects::ClassTable& table);

}  // namespace saker::tools
