#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "objects/class_table.h"
#include "objects/measurement.h"

namespace saker::tools {

/// A line of detections.jsonl: time (s), class, class_probability, model in the lidar frame,
/// covariance, points, moving, reflectivity (where the sensor says it).
[[nodiscard]] nlohmann::json measurement_json(const objects::Measurement& measurement,
                                              const objects::ClassTable& table);

/// All of them, in the file's order, without covariances. Throws Error that names file and line,
/// what was found and what was expected.
[[nodiscard]] std::vector<objects::Measurement> read_detections(const std::filesystem::path& file,
                                                                const objects::ClassTable& table);

}  // namespace saker::tools
