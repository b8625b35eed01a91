#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "saker/core/time.h"
#include "saker/objects/object_map.h"
#include "tools/saker/experiment/calibration.h"

namespace saker::tools {

/// Viewpoints that were flown: what was predicted of their targets' length and width before, and
/// what the map said after.
class ViewpointLog {
 public:
  /// A viewpoint from which its target was seen until `stamp`.
  /// \param predicted_sd  m, of length and width after it
  void add(Time stamp, int target_id, int viewpoint_id, const Eigen::Vector2d& predicted_sd);

  /// The first map that is not older than a viewpoint says what came of it.
  void take(Time stamp, const objects::ObjectMap& map, const objects::ObjectMap& truth);

  /// CSV: t_s (of the plant's time), target, viewpoint, predicted_length_sd_m,
  /// predicted_width_sd_m, mapped_length_m, mapped_width_m, true_length_m, true_width_m; mapped is
  /// nan where the map did not hold the target.
  [[nodiscard]] std::string csv() const;

 private:
  struct Row {
    Time stamp = 0;
    int target_id = -1, viewpoint_id = -1;
    Eigen::Vector2d predicted_sd = Eigen::Vector2d::Constant(NAN);
    Eigen::Vector2d mapped = Eigen::Vector2d::Constant(NAN);
    Eigen::Vector2d real = Eigen::Vector2d::Constant(NAN);
  };

  std::vector<Row> rows_;
  std::size_t taken_ = 0;  ///< rows before have their outcome
};

/// Two outcomes a row, length and width. Throws Error on a file that is not as above.
[[nodiscard]] std::vector<Outcome> read_outcomes(const std::filesystem::path& file);

}  // namespace saker::tools
