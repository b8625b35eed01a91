#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "flight/bus/messages.h"
#include "flight/bus/object_messages.h"
#include "flight/viewers/robot_view.h"
#include "saker/autonomy/cause.h"

/// Messages of a made robot, and what the ground knows of its site.
namespace saker::flight::viewers::testing {

inline constexpr double kForever = std::numeric_limits<double>::infinity();

/// A vehicle of 4 m × 2 m × 1.5 m at (x, y), turned by a quarter: its x axis is the map's y axis;
/// known to 0.3 m along x, 0.1 m along y.
inline objects::MapObject made_vehicle(int id, double x, double y) {
  objects::Cuboid cuboid;
  cuboid.pose.linear() = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  cuboid.pose.translation() << x, y, 0.75;
  cuboid.size << 4, 2, 1.5;
  objects::MapObject object;
  object.id = id;
  object.class_id = objects::ClassTable().find("vehicle");
  object.observations = 9;
  object.model = cuboid;
  object.class_probability.assign(static_cast<std::size_t>(objects::ClassTable().size()), 0.01);
  object.class_probability[object.class_id] = 0.96;
  Eigen::Matrix<double, 9, 1> sd;
  sd << 0.01, 0.01, 0.01, 0.3, 0.1, 0.05, 0.04, 0.02, 0.06;
  object.covariance = sd.cwiseAbs2().asDiagonal();
  return object;
}

inline objects::MapObject made_pole(int id, double x, double y) {
  objects::MapObject object = made_vehicle(id, x, y);
  object.class_id = objects::ClassTable().find("pole");
  std::swap(object.class_probability[object.class_id],
            object.class_probability[objects::ClassTable().find("vehicle")]);
  object.model = objects::Cylinder{
      .root = {x, y, 0}, .axis = Eigen::Vector3d::UnitZ(), .radius = 0.1, .height = 6};
  object.covariance = {};
  return object;
}

inline object_map_t made_objects(const std::vector<objects::MapObject>& objects) {
  object_map_t message{};
  message.utime = 5000000;
  message.total = static_cast<std::int32_t>(objects.size());
  for (const objects::MapObject& object : objects) message.objects.push_back(to_lcm(object));
  message.num_objects = message.total;
  return message;
}

inline odometry_t made_odometry(std::int64_t utime, double x, double y) {
  odometry_t message{};
  message.utime = utime;
  message.position[0] = x;
  message.position[1] = y;
  message.position[2] = 3;
  message.orientation[3] = 1;
  message.velocity[0] = 3;
  message.velocity[1] = 4;
  for (int i = 0; i < 6; ++i) message.covariance[7 * i] = 0.04f;
  return message;
}

inline vehicle_state_t made_state() {
  vehicle_state_t message{};
  message.utime = 1;
  message.armed = 1;
  message.mode = vehicle_state_t::GUIDED;
  message.attitude[3] = 1;
  message.height_m = 3;
  message.battery_share = 0.5f;
  message.faults = 8 | 1;  // BATTERY_LOW, NO_ODOMETRY
  return message;
}

inline mission_t made_mission(const std::string& phase, autonomy::Cause cause,
                              const std::string& text) {
  mission_t message{};
  message.utime = 2;
  message.phase = phase;
  message.target = 2;
  message.targets = 8;
  message.elapsed_s = 12;
  message.cause_code = static_cast<std::int32_t>(cause);
  message.cause = std::string(to_string(cause)) + ": " + text;
  return message;
}

/// A plan with one viewpoint of each target, of which the first is chosen.
inline plan_t made_plan(const std::vector<int>& tour, std::int64_t trajectory) {
  plan_t message{};
  message.utime = 3;
  message.trajectory_id = trajectory;
  for (const int id : tour) {
    message.tour.push_back(id);
    candidate_t candidate{};
    candidate.target_id = id;
    candidate.gain = 1.5f;
    candidate.path_m = 7;
    message.candidates.push_back(candidate);
  }
  message.num_tour = message.num_candidates = static_cast<std::int32_t>(tour.size());
  message.choice = tour.empty() ? -1 : 0;
  return message;
}

inline trajectory_t made_trajectory(std::int64_t id, int states) {
  trajectory_t message{};
  message.id = id;
  message.step_s = 0.1;
  message.num_states = states;
  message.states.resize(static_cast<std::size_t>(states));
  for (int i = 0; i < states; ++i)
    message.states[static_cast<std::size_t>(i)].position[0] = static_cast<float>(i);
  return message;
}

inline autonomy::RegisteredScan made_scan(int points) {
  auto cloud = std::make_shared<std::vector<Eigen::Vector3f>>();
  auto reflectivity = std::make_shared<std::vector<float>>();
  for (int i = 0; i < points; ++i) {
    cloud->emplace_back(1.0f + static_cast<float>(i) / 1000, 2, 3);
    reflectivity->push_back(1);
  }
  autonomy::RegisteredScan scan{
      .stamp = 7 * kNanosecondsPerSecond, .points = cloud, .reflectivity = reflectivity};
  scan.T_odom_lidar.translation() << 10, 0, 0;
  return scan;
}

inline std::shared_ptr<Site> made_site() {
  auto site = std::make_shared<Site>();
  site->geofence.polygon_m = {-5, -5, 5, -5, 5, 5, -5, 5};
  return site;
}

inline RobotView made_view(std::shared_ptr<const Site> site = made_site(),
                           double lost_s = kForever) {
  return {"R1", colour_of_robot(0), std::move(site), lost_s};
}

inline bool all(Topic) { return true; }
inline bool none(Topic) { return false; }

/// The messages of one topic.
inline std::vector<Json> of_topic(const std::vector<Said>& said, Topic topic) {
  std::vector<Json> found;
  for (const Said& s : said) {
    if (s.topic == topic) found.push_back(Json::parse(s.json));
  }
  return found;
}

}  // namespace saker::flight::viewers::testing
