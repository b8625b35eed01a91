#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "saker/objects/class_table.h"
#include "tools/saker/experiment/calibration.h"
#include "tools/saker/experiment/experiment_table.h"

namespace saker::tools {

/// How the errors of length and width are spread, a curve for each row (a policy over all its
/// runs): the share of errors by 5 cm. Throws Error where it cannot be written.
void write_error_picture(const std::filesystem::path& file, const std::vector<TableRow>& rows);

/// A run's true trajectory, to be drawn beside others of the same world.
struct TrajectoryPanel {
  std::string title;
  std::filesystem::path folder;  ///< with truth.json, prior.json and trajectory_truth.txt
};

/// From above, true vehicles and the path flown over them: a column for each panel, a row for each
/// list of panels. Throws Error where a file cannot be read or written.
void write_trajectory_picture(const std::filesystem::path& file,
                              const std::vector<std::vector<TrajectoryPanel>>& rows,
                              const objects::ClassTable& table);

/// Realised against predicted error in each bin, between the lines of 0.8 and 1.25.
void write_calibration_picture(const std::filesystem::path& file, const std::string& policy,
                               const std::vector<CalibrationBin>& bins);

}  // namespace saker::tools
