#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "saker/objects/class_table.h"
#include "saker/objects/measurement.h"

namespace saker::flight {

/// A line of detections.jsonl: time (s), class, class_probability, model in the lidar frame,
/// covariance, points, moving, reflectivity (where the sensor says it), front_log_odds (where one
/// end looks more like the front).
[[nodiscard]] nlohmann::json measurement_json(const objects::Measurement& measurement,
                                              const objects::ClassTable& table);

/// Writes OUT/detections.jsonl as a run goes on; the file has its name once it is finished.
class DetectionsWriter {
 public:
  /// Throws Error where OUT cannot be written. \param table outlives the writer
  DetectionsWriter(const std::filesystem::path& out, const objects::ClassTable& table);

  void add(const objects::Detections& detections);
  void finish();  ///< throws Error when not all could be written

 private:
  std::filesystem::path file_;
  const objects::ClassTable& table_;
  std::ofstream part_;
};

/// All of them, in the file's order, without covariances. Throws Error that names file and line,
/// what was found and what was expected.
[[nodiscard]] std::vector<objects::Measurement> read_detections(const std::filesystem::path& file,
                                                                const objects::ClassTable& table);

}  // namespace saker::flight
