#pragma once

#include <set>
#include <vector>

#include "flight/viewers/json_value.h"
#include "flight/viewers/robot_state.h"

/// A robot's state in Foxglove's schemas (docs.foxglove.dev, "schemas"), as JSON. `t`: s, the time
/// that they are stamped with.
namespace saker::flight::viewers {

/// Objects with the 95 % ellipse of their place, path, committed trajectory, viewpoints, geofence.
/// \param shown_ids  of objects that were said before; those that are gone are deleted
[[nodiscard]] Json scene_update(const RobotState& state, const Site& site, double t,
                                std::set<int>& shown_ids);

/// map → R1/world → R1/odom → R1/body → R1/lidar.
[[nodiscard]] std::optional<Json> frame_transforms(const RobotState& state, const Site& site,
                                                   double t);

/// Nothing without an origin.
[[nodiscard]] std::optional<Json> location_fix(const RobotState& state, const Site& site, double t);

enum class LogLevel { info = 2, warning = 3, error = 4 };
[[nodiscard]] Json log_message(const std::string& name, LogLevel level, const std::string& text,
                               double t);

/// At most `most` points of the newest scan, in `odom`, evenly chosen.
[[nodiscard]] std::optional<Json> point_cloud(const RobotState& state, double t, std::size_t most);

/// Centres of occupied cells within `radius_m` of the body, the nearest `most` of them.
[[nodiscard]] std::optional<Json> occupied_cells(const RobotState& state, double t, double radius_m,
                                                 std::size_t most);

}  // namespace saker::flight::viewers
