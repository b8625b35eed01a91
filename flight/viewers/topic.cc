#include "flight/viewers/topic.h"

#include <array>
#include <functional>
#include <iterator>

#include "flight/viewers/schema_parts.h"

namespace saker::flight::viewers {
namespace {

using namespace schema;

// Kept: minutes of what is small. Rates: what an eye follows, and a plot needs.
constexpr TopicInfo kInfos[] = {
    {"objects", "saker.Objects", 0.5, 240, false},
    {"state", "saker.State", 0.2, 240, false},
    {"odometry", "saker.Odometry", 0.1, 240, false},
    {"path", "saker.Path", 1, 1, false},
    {"trajectory", "saker.Trajectory", 0.2, 1, false},
    {"plan", "saker.Plan", 0.5, 240, false},
    {"mission", "saker.Mission", 0, 240, false},
    {"health", "saker.Health", 0, 240, true},
    {"verdict", "saker.Verdict", 0.5, 240, false},
    {"detections", "saker.Detections", 0.5, 1, false},
    {"link", "saker.Link", 0.5, 1, false},
    {"site", "saker.Site", 0.5, 1, false},
    {"orders", "saker.Order", 0, 100, true},
    {"figures", "saker.Figures", 0.5, 1, false},
    {"scene", "foxglove.SceneUpdate", 1, 0, false},
    {"tf", "foxglove.FrameTransforms", 0.1, 0, false},
    {"location", "foxglove.LocationFix", 0.5, 0, false},
    {"log", "foxglove.Log", 0, 200, true},
    {"points", "foxglove.PointCloud", 0.5, 0, false},
    {"occupancy", "foxglove.PointCloud", 1, 0, false},
};
static_assert(std::size(kInfos) == kTopics);

Json utime() { return integer("us, the sensor's clock"); }

Json shown_object() {
  return object({{"id", integer()},
                 {"class", text()},
                 {"shape", text("cuboid or cylinder")},
                 {"probability?", number("of the class")},
                 {"observations", integer()},
                 {"position?", numbers("m, a cuboid's centre")},
                 {"rotation?", numbers("x, y, z, w")},
                 {"size?", numbers("m, length, width, height")},
                 {"heading_rad?", number("from x to y of the map")},
                 {"root?", numbers("m, of a cylinder, on the ground")},
                 {"axis?", numbers("unit, up")},
                 {"radius?", number("m")},
                 {"height?", number("m")},
                 {"sd?", object({{"position?", numbers("m, in the object's own frame")},
                                 {"size?", numbers("m, of length and width")},
                                 {"radius?", number("m")}})},
                 {"place_covariance?", numbers("m^2, xx, xy, yy in the frame of the map")},
                 {"colour", numbers("red, green, blue, 0 … 1")},
                 {"target?", object({{"id?", integer("of the target")},
                                     {"state", text()},
                                     {"tour?", integer("place in the tour, from 0")},
                                     {"reason", text()}})},
                 {"heard_s", number("s since it was last said")}});
}

Json ground_plane() {
  return object({{"normal", numbers()}, {"point", numbers("m")}, {"radius", number("m")}});
}

Json objects_schema() {
  return object({{"utime", utime()},
                 {"frame", text()},
                 {"total", integer("objects of the robot's whole map")},
                 {"objects", list(shown_object())},
                 {"ground", list(ground_plane())}});
}

Json state_schema() {
  return object({{"utime", utime()},
                 {"armed", flag()},
                 {"mode", text()},
                 {"attitude", numbers("x, y, z, w, level <- body")},
                 {"height_m?", number("above where it was armed, by the barometer")},
                 {"battery_share?", number("0 … 1")},
                 {"faults", list(text())}});
}

Json odometry_schema() {
  return object({{"utime", utime()},
                 {"frame", text()},
                 {"position", numbers("m")},
                 {"orientation", numbers("x, y, z, w")},
                 {"velocity?", numbers("m/s")},
                 {"speed_mps?", number("m/s")},
                 {"angular_velocity?", numbers("rad/s, body")},
                 {"sd_m?", numbers("m, body")},
                 {"sd_rad?", numbers("rad, body")},
                 {"status", text("ok, predicted or lost")},
                 {"reset_counter", integer()}});
}

Json path_schema() {
  return object({{"frame", text()},
                 {"t_s", numbers("s, time of each point")},
                 {"points", list(numbers("m"))},
                 {"length_m", number("m")}});
}

Json trajectory_schema() {
  return object({{"utime", utime()},
                 {"frame", text()},
                 {"id", integer()},
                 {"start_utime", integer("us, of the first point")},
                 {"step_s", number("s between two points")},
                 {"points", list(numbers("m"))},
                 {"yaw_rad", numbers("rad")},
                 {"end_s", number("s from the start to the end")}});
}

Json plan_schema() {
  const Json candidate = object({{"target_id", integer()},
                                 {"position", numbers("m")},
                                 {"yaw_rad", number("rad")},
                                 {"gain_nat?", number("nat")},
                                 {"path_m?", number("m to get there")},
                                 {"chosen", flag()}});
  return object({{"utime", utime()},
                 {"frame", text()},
                 {"trajectory_id", integer()},
                 {"tour", list(integer())},
                 {"choice", integer("place in candidates, -1: none")},
                 {"reason", text("why something was refused")},
                 {"candidates", list(candidate)},
                 {"refused", list(object({{"position", numbers("m")}, {"reason", text()}}))}});
}

Json mission_schema() {
  return object({{"utime", utime()},
                 {"phase", text()},
                 {"target", integer("k of …")},
                 {"targets", integer("… n")},
                 {"elapsed_s?", number("s since take-off")},
                 {"cause", text()},
                 {"cause_code", integer()},
                 {"text", text()},
                 {"ladder", text("rung of the safety ladder")},
                 {"waits_for", text()},
                 {"if_it_goes_on", text()},
                 {"gain_nat", number("nat, promised by viewpoints flown to")}});
}

Json health_schema() {
  const Json loop = object({{"name", text()},
                            {"rate_hz?", number("Hz")},
                            {"misses", integer()},
                            {"worst_lateness_ms?", number("ms")},
                            {"age_ms?", number("ms")},
                            {"median_ms?", number("ms")},
                            {"p95_ms?", number("ms")},
                            {"cpu?", number("s/s")},
                            {"drops", integer()}});
  return object(
      {{"utime", utime()}, {"process", text()}, {"loops", list(loop)}, {"counters", object({})}});
}

Json verdict_schema() {
  return object({{"utime", utime()},
                 {"trajectory_id", integer()},
                 {"clear", flag()},
                 {"reason", text()},
                 {"clear_for_s", number("s from the verdict on")},
                 {"first_hit?", numbers("m")},
                 {"clearance_m?", number("m")}});
}

Json detections_schema() {
  const Json detection = object({{"class", text()},
                                 {"shape", text()},
                                 {"probability?", number()},
                                 {"points", integer()},
                                 {"moving", flag()},
                                 {"position?", numbers("m")},
                                 {"rotation?", numbers("x, y, z, w")},
                                 {"size?", numbers("m")},
                                 {"root?", numbers("m")},
                                 {"axis?", numbers("unit, up")},
                                 {"radius?", number("m")},
                                 {"height?", number("m")}});
  return object({{"utime", utime()},
                 {"frame", text()},
                 {"total", integer()},
                 {"detections", list(detection)}});
}

Json link_schema() {
  return object({{"age_s?", number("s, of the newest message")},
                 {"lost", flag()},
                 {"channels", object({})},
                 {"malformed", integer()},
                 {"message_rate_hz", number("Hz")}});
}

Json site_schema() {
  const Json fence = object(
      {{"polygon", list(numbers("m"))}, {"lowest_m", number("m")}, {"highest_m", number("m")}});
  const Json origin = object({{"latitude_deg", number("degrees")},
                              {"longitude_deg", number("degrees")},
                              {"heading_deg", number("degrees, of x, clockwise from north")}});
  const Json shown_class = object({{"name", text()},
                                   {"shape", text()},
                                   {"target", flag()},
                                   {"colour", numbers("red, green, blue, 0 … 1")}});
  return object({{"robot", text()},
                 {"colour", numbers("red, green, blue, 0 … 1")},
                 {"geofence", fence},
                 {"origin?", origin},
                 {"prior", object({{"objects", list(shown_object())}})},
                 {"classes", list(shown_class)},
                 {"limits", object({{"battery_return_share", number()},
                                    {"battery_land_share", number()},
                                    {"land_after_s", number("s")}})}});
}

Json order_schema() {
  return object({{"id", integer()},
                 {"t_s", number("s")},
                 {"robot", text()},
                 {"kind", text()},
                 {"by", text("address of who asked")},
                 {"state", text("sent, acknowledged, refused or silent")},
                 {"text", text()},
                 {"took_s?", number("s")}});
}

Json schema_json(Topic topic) {
  constexpr Json (*kSchemas[])() = {objects_schema,    state_schema,
                                    odometry_schema,   path_schema,
                                    trajectory_schema, plan_schema,
                                    mission_schema,    health_schema,
                                    verdict_schema,    detections_schema,
                                    link_schema,       site_schema,
                                    order_schema,      [] { return object({}); },
                                    scene_update,      frame_transforms,
                                    location_fix,      schema::log,
                                    point_cloud,       point_cloud};
  static_assert(std::size(kSchemas) == kTopics);
  Json schema = kSchemas[static_cast<int>(topic)]();
  schema["title"] = info(topic).schema;
  return schema;
}

}  // namespace

const TopicInfo& info(Topic topic) { return kInfos[static_cast<int>(topic)]; }

std::string topic_name(const std::string& robot, Topic topic) {
  return "/" + robot + "/" + info(topic).name;
}

const std::string& schema_of(Topic topic) {
  static const std::array<std::string, kTopics> schemas = [] {
    std::array<std::string, kTopics> made;
    for (int i = 0; i < kTopics; ++i) made[i] = schema_json(static_cast<Topic>(i)).dump();
    return made;
  }();
  return schemas[static_cast<int>(topic)];
}

const std::string& playback_schema() {
  static const std::string schema = object({{"playing", flag()},
                                            {"speed", number("s of the recording a second")},
                                            {"t_s", number("s, the recording's clock")},
                                            {"begin_s", number("s")},
                                            {"end_s", number("s")}},
                                           kPlaybackSchema)
                                        .dump();
  return schema;
}

}  // namespace saker::flight::viewers
