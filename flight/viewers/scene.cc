#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "flight/bus/fields.h"
#include "flight/viewers/foxglove_messages.h"
#include "flight/viewers/foxglove_parts.h"

/// The scene: what is drawn of a robot's state.
namespace saker::flight::viewers {
namespace {

constexpr double kSolid = 0.6, kFaint = 0.35;  // opacities

Json entity(const std::string& id, const std::string& frame, double t) {
  Json json = {{"timestamp", time_json(t)},
               {"frame_id", frame},
               {"id", id},
               {"lifetime", {{"sec", 0}, {"nsec", 0}}},
               {"frame_locked", true}};
  for (const char* part : {"metadata", "arrows", "cubes", "spheres", "cylinders", "lines",
                           "triangles", "texts", "models"})
    json[part] = Json::array();
  return json;
}

Json line(const std::vector<Eigen::Vector3d>& points, const core::Colour& colour, bool loop) {
  Json list = Json::array();
  for (const Eigen::Vector3d& p : points) list.push_back(vector_json(p));
  return {{"type", loop ? 1 : 0},
          {"pose", pose_json(SE3::Identity())},
          {"thickness", 2},
          {"scale_invariant", true},
          {"points", std::move(list)},
          {"color", colour_json(colour, 1)},
          {"colors", Json::array()},
          {"indices", Json::array()}};
}

/// 95 % of a place in x-y: the eigenvectors of its covariance, scaled by chi-squared's quantile.
std::vector<Eigen::Vector3d> ellipse(const ShownObject& shown) {
  constexpr double kQuantile = 5.991;  // chi-squared, 2 degrees of freedom, 0.95
  constexpr int kCorners = 24;
  const Eigen::Vector3d c = shown.place_covariance();
  std::vector<Eigen::Vector3d> corners;
  if (!c.allFinite()) return corners;
  const Eigen::Matrix2d covariance{{c(0), c(1)}, {c(1), c(2)}};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
  const Eigen::Vector2d axes = (kQuantile * solver.eigenvalues().cwiseMax(0)).cwiseSqrt();
  const Eigen::Vector3d centre = objects::place(shown.object.model);
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    const Eigen::Vector2d on_circle(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d p = solver.eigenvectors() * axes.cwiseProduct(on_circle);
    corners.push_back(centre + Eigen::Vector3d(p.x(), p.y(), 0));
  }
  return corners;
}

void add_solid(const objects::Model& model, const core::Colour& colour, Json& into) {
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&model)) {
    into["cubes"].push_back({{"pose", pose_json(cuboid->pose)},
                             {"size", vector_json(cuboid->size)},
                             {"color", colour_json(colour, kSolid)}});
    const Eigen::Vector3d nose = cuboid->pose * Eigen::Vector3d(cuboid->size.x() / 2, 0, 0);
    SE3 front = cuboid->pose;
    front.translation() = nose;
    into["arrows"].push_back({{"pose", pose_json(front)},
                              {"shaft_length", 0.4},
                              {"shaft_diameter", 0.1},
                              {"head_length", 0.3},
                              {"head_diameter", 0.3},
                              {"color", colour_json(colour, 1)}});
    return;
  }
  const auto& cylinder = std::get<objects::Cylinder>(model);
  SE3 middle = SE3::Identity();
  middle.linear() =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), cylinder.axis).matrix();
  middle.translation() = cylinder.root + cylinder.axis * cylinder.height / 2;
  const double diameter = 2 * cylinder.radius;
  into["cylinders"].push_back(
      {{"pose", pose_json(middle)},
       {"size", vector_json(Eigen::Vector3d(diameter, diameter, cylinder.height))},
       {"bottom_scale", 1},
       {"top_scale", 1},
       {"color", colour_json(colour, kSolid)}});
}

bool drawable(const objects::Model& model) {
  if (const auto* cuboid = std::get_if<objects::Cuboid>(&model)) return cuboid->size.allFinite();
  const auto& cylinder = std::get<objects::Cylinder>(model);
  return cylinder.root.allFinite() && std::isfinite(cylinder.radius) &&
         std::isfinite(cylinder.height);
}

Json object_entity(const RobotState& state, const ShownObject& shown, const Site& site, double t) {
  const objects::ObjectClass& c = site.classes[shown.object.class_id];
  Json json = entity(fmt::format("objects/{}", shown.object.id), frame_of(state, "world"), t);
  json["metadata"] = {
      {{"key", "class"}, {"value", c.name}},
      {{"key", "observations"}, {"value", std::to_string(shown.object.observations)}}};
  add_solid(shown.object.model, colour_of(c), json);
  const std::vector<Eigen::Vector3d> corners = ellipse(shown);
  if (!corners.empty()) json["lines"].push_back(line(corners, core::colours::kInk, true));
  return json;
}

Json viewpoints(const RobotState& state, double t) {
  Json json = entity("viewpoints", frame_of(state, "world"), t);
  if (!state.plan) return json;
  const plan_t& plan = state.plan->message;
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const candidate_t& candidate = plan.candidates[i];
    if (!refusal_words(candidate).empty()) continue;
    SE3 pose = SE3::Identity();
    pose.translation() = vector_of(candidate.position);
    if (!pose.translation().allFinite() || !std::isfinite(candidate.yaw)) continue;
    pose.linear() = Eigen::AngleAxisd(candidate.yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const bool chosen = static_cast<int>(i) == plan.choice;
    json["arrows"].push_back({{"pose", pose_json(pose)},
                              {"shaft_length", 0.6},
                              {"shaft_diameter", 0.08},
                              {"head_length", 0.3},
                              {"head_diameter", 0.2},
                              {"color", colour_json(state.colour, chosen ? 1 : kFaint)}});
  }
  return json;
}

Json fence(const RobotState& state, const Site& site, double t) {
  Json json = entity("geofence", frame_of(state, "world"), t);
  for (const double z : {site.geofence.lowest_m, site.geofence.highest_m}) {
    std::vector<Eigen::Vector3d> corners;
    const std::vector<double>& xy = site.geofence.polygon_m;
    for (std::size_t i = 0; i + 1 < xy.size(); i += 2) corners.emplace_back(xy[i], xy[i + 1], z);
    json["lines"].push_back(line(corners, core::colours::kYellow, true));
  }
  return json;
}

Json way(const char* id, const RobotState& state, const std::vector<Eigen::Vector3d>& points,
         const core::Colour& colour, double t) {
  Json json = entity(id, frame_of(state, "odom"), t);
  if (points.size() > 1) json["lines"].push_back(line(points, colour, false));
  return json;
}

std::vector<Eigen::Vector3d> committed(const RobotState& state) {
  constexpr std::size_t kMost = 200;
  std::vector<Eigen::Vector3d> points;
  if (!state.trajectory) return points;
  const auto& states = state.trajectory->message.states;
  const std::size_t stride = std::max<std::size_t>(1, states.size() / kMost);
  for (std::size_t i = 0; i < states.size(); i += stride) {
    const Eigen::Vector3d p = vector_of(states[i].position);
    if (p.allFinite()) points.push_back(p);
  }
  return points;
}

}  // namespace

Json scene_update(const RobotState& state, const Site& site, double t, std::set<int>& shown_ids) {
  Json deletions = Json::array(), entities = Json::array();
  for (const int id : shown_ids) {
    if (state.objects.contains(id)) continue;
    deletions.push_back(
        {{"timestamp", time_json(t)}, {"type", 0}, {"id", fmt::format("objects/{}", id)}});
  }
  shown_ids.clear();
  for (const auto& [id, shown] : state.objects) {
    if (!drawable(shown.object.model)) continue;
    shown_ids.insert(id);
    entities.push_back(object_entity(state, shown, site, t));
  }
  entities.push_back(way("path", state, state.path.points(), state.colour, t));
  entities.push_back(way("trajectory", state, committed(state), core::colours::kInk, t));
  entities.push_back(viewpoints(state, t));
  entities.push_back(fence(state, site, t));
  return {{"deletions", std::move(deletions)}, {"entities", std::move(entities)}};
}

}  // namespace saker::flight::viewers
