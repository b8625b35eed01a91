#include "flight/viewers/own_messages.h"

#include <algorithm>
#include <cmath>

#include "flight/bus/fields.h"
#include "flight/bus/object_messages.h"
#include "flight/viewers/words.h"
#include "saker/objects/class_table.h"

namespace saker::flight::viewers {
namespace {

const char* shape_word(const objects::Model& model) {
  return std::holds_alternative<objects::Cuboid>(model) ? "cuboid" : "cylinder";
}

void put_deviations(Json& json, const ShownObject& shown) {
  Json sd = Json::object();
  put(sd, "position", shown.position_sd);
  if (std::holds_alternative<objects::Cuboid>(shown.object.model)) {
    put(sd, "size", shown.size_sd);
  } else {
    put(sd, "radius", shown.size_sd.x() / 2);
  }
  if (!sd.empty()) json["sd"] = std::move(sd);
  put(json, "place_covariance", shown.place_covariance());
}

Json target_json(const RobotState& state, std::optional<int> target) {
  if (!target) return {{"state", "waiting"}, {"reason", ""}};
  const auto at = state.targets.find(*target);
  const TargetNote note = at == state.targets.end() ? TargetNote{} : at->second;
  Json json = {{"id", *target}, {"state", note.state}};
  if (note.tour >= 0) json["tour"] = note.tour;
  json["reason"] = note.reason;
  return json;
}

Json object_json(const ShownObject& shown, const objects::ClassTable& table) {
  const objects::MapObject& object = shown.object;
  Json json = {{"id", object.id}};
  json.update(model_json(object.model, object.class_id, table));
  if (object.class_id < object.class_probability.size())
    put(json, "probability", object.class_probability[object.class_id]);
  json["observations"] = object.observations;
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&object.model))
    put(json, "heading_rad", std::atan2(cuboid->pose(1, 0), cuboid->pose(0, 0)));
  put_deviations(json, shown);
  json["colour"] = array(colour_of(table[object.class_id]));
  return json;
}

template <class Scalar>
Eigen::Vector3d vector3(const Scalar (&field)[3]) {
  return vector_of(field);
}

}  // namespace

Json model_json(const objects::Model& model, objects::ClassId id,
                const objects::ClassTable& table) {
  Json json = {{"class", table[id].name}, {"shape", shape_word(model)}};
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&model)) {
    put(json, "position", cuboid->pose.translation());
    json["rotation"] = array(Eigen::Quaterniond(cuboid->pose.rotation()));
    put(json, "size", cuboid->size);
    return json;
  }
  const auto& cylinder = std::get<objects::Cylinder>(model);
  put(json, "root", cylinder.root);
  put(json, "axis", cylinder.axis);
  put(json, "radius", cylinder.radius);
  put(json, "height", cylinder.height);
  return json;
}

std::optional<Json> objects_message(const RobotState& state, const Site& site, double t) {
  if (state.objects_utime == 0 && state.objects.empty()) return std::nullopt;
  const std::map<int, int> targets = targets_by_object(state, site);
  Json objects = Json::array();
  for (const auto& [id, shown] : state.objects) {
    Json json = object_json(shown, site.classes);
    if (const auto at = targets.find(id); at != targets.end()) {
      json["target"] = target_json(state, at->second);
    } else if (site.prior.objects.empty() && site.classes[shown.object.class_id].target) {
      json["target"] = target_json(state, std::nullopt);
    }
    json["heard_s"] = rounded(std::max(0.0, t - shown.t));
    objects.push_back(std::move(json));
  }
  Json ground = Json::array();
  for (const objects::GroundPlane& plane : state.ground) {
    ground.push_back({{"normal", array(plane.normal)},
                      {"point", array(plane.point)},
                      {"radius", rounded(plane.radius)}});
  }
  return Json{{"utime", state.objects_utime},
              {"frame", frame_of(state, "world")},
              {"total", state.objects_total},
              {"objects", std::move(objects)},
              {"ground", std::move(ground)}};
}

std::optional<Json> vehicle_message(const RobotState& state) {
  if (!state.vehicle) return std::nullopt;
  const vehicle_state_t& message = state.vehicle->message;
  Json json = {{"utime", message.utime},
               {"armed", message.armed != 0},
               {"mode", mode_word(message.mode)},
               {"attitude", array(Eigen::Map<const Eigen::Vector4d>(message.attitude))}};
  put(json, "height_m", static_cast<double>(message.height_m));
  put(json, "battery_share", static_cast<double>(message.battery_share));
  json["faults"] = fault_words(message.faults);
  return json;
}

std::optional<Json> odometry_message(const RobotState& state) {
  if (!state.odometry) return std::nullopt;
  const odometry_t& message = state.odometry->message;
  Json json = {{"utime", message.utime},
               {"frame", frame_of(state, "odom")},
               {"position", array(vector3(message.position))},
               {"orientation", array(Eigen::Map<const Eigen::Vector4d>(message.orientation))}};
  put(json, "velocity", vector3(message.velocity));
  put(json, "speed_mps", vector3(message.velocity).norm());
  put(json, "angular_velocity", vector3(message.angular_velocity));
  Eigen::Matrix<double, 6, 1> sd;
  for (int i = 0; i < 6; ++i) sd(i) = std::sqrt(static_cast<double>(message.covariance[7 * i]));
  put(json, "sd_m", sd.tail<3>());
  put(json, "sd_rad", sd.head<3>());
  json["status"] = odometry_word(message.status);
  json["reset_counter"] = message.reset_counter;
  return json;
}

std::optional<Json> path_message(const RobotState& state) {
  if (state.path.points().empty()) return std::nullopt;
  Json times = Json::array(), points = Json::array();
  for (const double t : state.path.times()) times.push_back(rounded(t));
  for (const Eigen::Vector3d& p : state.path.points()) points.push_back(array(p));
  return Json{{"frame", frame_of(state, "odom")},
              {"t_s", std::move(times)},
              {"points", std::move(points)},
              {"length_m", rounded(state.path.length_m())}};
}

std::optional<Json> trajectory_message(const RobotState& state) {
  constexpr std::size_t kMost = 400;
  if (!state.trajectory) return std::nullopt;
  const trajectory_t& message = state.trajectory->message;
  const std::size_t count = message.states.size();
  const std::size_t stride = std::max<std::size_t>(1, (count + kMost - 2) / (kMost - 1));
  Json points = Json::array(), yaw = Json::array();
  const auto add = [&](const motion_state_t& s) {
    const Eigen::Vector3d p = vector3(s.position);
    if (!p.allFinite() || !std::isfinite(s.yaw)) return;
    points.push_back(array(p));
    yaw.push_back(rounded(s.yaw));
  };
  for (std::size_t i = 0; i < count; i += stride) add(message.states[i]);
  if (count > 0 && (count - 1) % stride != 0) add(message.states.back());
  const double whole_s = count > 0 ? message.step_s * static_cast<double>(count - 1) : 0;
  return Json{{"utime", message.utime},
              {"frame", frame_of(state, "odom")},
              {"id", message.id},
              {"start_utime", message.start_utime},
              {"step_s", rounded(message.step_s * static_cast<double>(stride))},
              {"points", std::move(points)},
              {"yaw_rad", std::move(yaw)},
              {"end_s", rounded(whole_s)}};
}

std::optional<Json> plan_message(const RobotState& state) {
  if (!state.plan) return std::nullopt;
  const plan_t& message = state.plan->message;
  Json candidates = Json::array(), refused = Json::array();
  for (std::size_t i = 0; i < message.candidates.size(); ++i) {
    const candidate_t& candidate = message.candidates[i];
    const Eigen::Vector3d p = vector3(candidate.position);
    if (!p.allFinite() || !std::isfinite(candidate.yaw)) continue;
    if (const std::string reason = refusal_words(candidate); !reason.empty()) {
      refused.push_back({{"position", array(p)}, {"reason", reason}});
      continue;
    }
    Json json = {{"target_id", candidate.target_id},
                 {"position", array(p)},
                 {"yaw_rad", rounded(candidate.yaw)}};
    put(json, "gain_nat", static_cast<double>(candidate.gain));
    put(json, "path_m", static_cast<double>(candidate.path_m));
    json["chosen"] = static_cast<int>(i) == message.choice;
    candidates.push_back(std::move(json));
  }
  return Json{{"utime", message.utime},
              {"frame", frame_of(state, "world")},
              {"trajectory_id", message.trajectory_id},
              {"tour", message.tour},
              {"choice", message.choice},
              {"reason", message.reason},
              {"candidates", std::move(candidates)},
              {"refused", std::move(refused)}};
}

std::optional<Json> mission_message(const RobotState& state, const Site& site) {
  if (!state.mission) return std::nullopt;
  const mission_t& message = state.mission->message;
  const MissionWords words = words_of(state, site);
  Json json = {{"utime", message.utime},
               {"phase", message.phase},
               {"target", message.target},
               {"targets", message.targets}};
  put(json, "elapsed_s", static_cast<double>(message.elapsed_s));
  json["cause"] = cause_word(message.cause_code);
  json["cause_code"] = message.cause_code;
  json["text"] = message.cause;
  json["ladder"] = words.ladder;
  json["waits_for"] = words.waits_for;
  json["if_it_goes_on"] = words.if_it_goes_on;
  json["gain_nat"] = rounded(state.gain_nat);
  return json;
}

std::optional<Json> verdict_message(const RobotState& state) {
  if (!state.verdict) return std::nullopt;
  const verdict_t& message = state.verdict->message;
  const double clear_us =
      static_cast<double>(message.clear_until_utime) - static_cast<double>(message.utime);
  Json json = {{"utime", message.utime},
               {"trajectory_id", message.trajectory_id},
               {"clear", message.clear != 0},
               {"reason", verdict_word(message.reason)},
               {"clear_for_s", rounded(clear_us * 1e-6)}};
  put(json, "first_hit", vector3(message.first_hit));
  put(json, "clearance_m", static_cast<double>(message.clearance_m));
  return json;
}

std::optional<Json> detections_message(const RobotState& state, const Site& site) {
  if (!state.detections) return std::nullopt;
  const detections_t& message = state.detections->message;
  const auto read = from_lcm(message, site.classes.size());
  Json list = Json::array();
  for (const objects::Measurement& m :
       read ? read->measurements : std::vector<objects::Measurement>{}) {
    Json json = model_json(m.model, m.class_id, site.classes);
    if (m.class_id < m.class_probability.size())
      put(json, "probability", m.class_probability[m.class_id]);
    json["points"] = m.points;
    json["moving"] = m.moving;
    list.push_back(std::move(json));
  }
  return Json{{"utime", message.utime},
              {"frame", frame_of(state, "lidar")},
              {"total", message.total},
              {"detections", std::move(list)}};
}

}  // namespace saker::flight::viewers
