#pragma once

#include "flight/viewers/json_value.h"
#include "flight/viewers/robot_state.h"

/// Our own messages as JSON (topics.md): what a robot's state says under each topic. Nothing where
/// nothing of it was heard yet. `t`: s, now.
namespace saker::flight::viewers {

/// Class, shape and model: what objects and detections share.
[[nodiscard]] Json model_json(const objects::Model& model, objects::ClassId id,
                              const objects::ClassTable& table);

[[nodiscard]] std::optional<Json> objects_message(const RobotState& state, const Site& site,
                                                  double t);
[[nodiscard]] std::optional<Json> vehicle_message(const RobotState& state);
[[nodiscard]] std::optional<Json> odometry_message(const RobotState& state);
[[nodiscard]] std::optional<Json> path_message(const RobotState& state);
/// At most 400 points, evenly chosen, the last one among them.
[[nodiscard]] std::optional<Json> trajectory_message(const RobotState& state);
[[nodiscard]] std::optional<Json> plan_message(const RobotState& state);
[[nodiscard]] std::optional<Json> mission_message(const RobotState& state, const Site& site);
[[nodiscard]] std::optional<Json> verdict_message(const RobotState& state);
[[nodiscard]] std::optional<Json> detections_message(const RobotState& state, const Site& site);
[[nodiscard]] Json health_message(const health_t& message);
/// \param lost_s  silence after which the link is lost
[[nodiscard]] Json link_message(const RobotState& state, double t, double lost_s);
[[nodiscard]] Json site_message(const RobotState& state, const Site& site);

}  // namespace saker::flight::viewers
