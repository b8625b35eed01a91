#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/saker/evaluate/box_figures.h"

/// A scan from above, with what of its vehicles was missed and what was taken for one.
namespace saker::tools {

enum class PointVerdict { right, missed, wrong, other };  ///< other: no vehicle, and not called one

struct EvaluatedScan {
  std::string name;
  std::array<std::vector<Eigen::Vector2f>, 4> points;  ///< by their verdict, lidar frame, m
  std::vector<LabelledBox> boxes;
  std::vector<BoxJudgement::Of> box_verdicts;  ///< one a box

  [[nodiscard]] std::size_t missed() const { return points[1].size(); }
  [[nodiscard]] std::size_t wrong() const { return points[2].size(); }
  [[nodiscard]] std::size_t faults() const { return missed() + wrong(); }
};

/// The scans with the most missed and wrong points, the worst first; of equal ones the earlier.
class WorstScans {
 public:
  explicit WorstScans(std::size_t most) : most_(most) {}
  void add(EvaluatedScan scan);  ///< one without a fault is passed over
  [[nodiscard]] const std::vector<EvaluatedScan>& scans() const { return scans_; }

 private:
  std::size_t most_;
  std::vector<EvaluatedScan> scans_;
};

/// PNG and SVG; throws Error where it cannot be written.
void write_evaluation_picture(const std::filesystem::path& file, const EvaluatedScan& scan);

}  // namespace saker::tools
