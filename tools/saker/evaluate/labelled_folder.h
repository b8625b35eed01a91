#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tools/saker/evaluate/box_figures.h"

/// What a person said of the scans of a folder. Reads FOLDER/labels/STEM.label (SemanticKITTI: one
/// uint32 a point, its id in the lower 16 bits), FOLDER/boxes.json ({STEM: [{"class", "position"
/// [x, y, z] of the centre, "size" [l, w, h], "yaw", optionally "id"}]}, lidar frame, m, rad) and
/// FOLDER/field_of_view.json (scans named in it, or all with "half_angle_deg", have boxes only so
/// far to either side of the x axis). Throws Error that names file and field, and where the folder
/// has neither labels nor boxes.
namespace saker::tools {

class LabelledFolder {
 public:
  explicit LabelledFolder(const std::filesystem::path& folder);

  /// Ids of a scan's points; nothing where it has no labels. Throws Error where their number is
  /// not that of the points.
  [[nodiscard]] std::optional<std::vector<std::uint32_t>> ids(const std::string& scan,
                                                              std::size_t points) const;
  /// The boxes of vehicles; null where the scan is not in boxes.json.
  [[nodiscard]] const std::vector<LabelledBox>* boxes(const std::string& scan) const;
  [[nodiscard]] std::optional<float> half_angle_deg(const std::string& scan) const;

 private:
  std::filesystem::path labels_;
  std::map<std::string, std::vector<LabelledBox>> boxes_;
  std::set<std::string> limited_;  ///< scans whose boxes are labelled in a field of view only
  bool all_limited_ = false;
  float half_angle_deg_ = 40;
};

}  // namespace saker::tools
