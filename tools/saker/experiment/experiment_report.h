#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace saker::tools {

struct FlownRun {
  std::filesystem::path folder;
  nlohmann::ordered_json results;  ///< its results.json
};

/// Leaves in `out` what all runs together say: table.txt and, of each policy that predicts what a
/// viewpoint will tell, calibration-POLICY.png; of several runs also results.json, errors.png and
/// trajectories.png (each scenario's first seed, its policies side by side).
/// \return table.txt, to be printed. Throws Error on a file that cannot be read or written.
std::string write_report(const std::vector<FlownRun>& runs, const std::filesystem::path& out);

}  // namespace saker::tools
