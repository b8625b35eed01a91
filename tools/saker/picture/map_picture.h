#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "saker/core/se3.h"
#include "saker/objects/object_map.h"

namespace saker::tools {

/// Where one of several robots flew.
struct RobotPath {
  std::string robot;
  std::vector<Eigen::Vector3d> positions;
};

/// A map from above. Truth is optional; everything in the frame of the map.
struct MapView {
  const objects::ObjectMap& map;
  const objects::ObjectMap* truth = nullptr;
  std::vector<Eigen::Vector3d> trajectory{};
  std::vector<Eigen::Vector3d> viewpoints{};    ///< that were flown to
  std::vector<RobotPath> robots{};              ///< of a team, instead of `trajectory`
  std::vector<Eigen::Vector3d> cloud{};         ///< drawn thinly
  std::vector<objects::MapObject> tentative{};  ///< beside the map: drawn dashed
};

/// Writes a PNG and an SVG: points, trajectory, objects with their class, the outlines of the true
/// ones. Throws Error.
void write_map_picture(const std::filesystem::path& file, const MapView& view,
                       const objects::ClassTable& table);

}  // namespace saker::tools
