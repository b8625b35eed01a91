#include <algorithm>
#include <cmath>

#include "flight/viewers/own_messages.h"

/// What is said of processes, of the link and of the site.
namespace saker::flight::viewers {
namespace {

Json loop_json(const loop_health_t& loop) {
  Json json = {{"name", loop.name}};
  put(json, "rate_hz", static_cast<double>(loop.rate_hz));
  json["misses"] = loop.misses;
  put(json, "worst_lateness_ms", static_cast<double>(loop.worst_lateness_ms));
  put(json, "age_ms", static_cast<double>(loop.age_ms));
  put(json, "median_ms", static_cast<double>(loop.median_ms));
  put(json, "p95_ms", static_cast<double>(loop.p95_ms));
  put(json, "cpu", static_cast<double>(loop.cpu));
  json["drops"] = loop.drops;
  return json;
}

Json classes_json(const objects::ClassTable& table) {
  Json list = Json::array();
  const std::vector<std::string> shapes = enum_names(objects::Shape::none);
  for (const objects::ObjectClass& c : table.classes) {
    if (c.shape != objects::Shape::cuboid && c.shape != objects::Shape::cylinder) continue;
    list.push_back({{"name", c.name},
                    {"shape", shapes[static_cast<std::size_t>(c.shape)]},
                    {"target", c.target},
                    {"colour", array(colour_of(c))}});
  }
  return list;
}

Json fence_json(const motion::GeofenceConfig& fence) {
  Json polygon = Json::array();
  for (std::size_t i = 0; i + 1 < fence.polygon_m.size(); i += 2)
    polygon.push_back({fence.polygon_m[i], fence.polygon_m[i + 1]});
  return {{"polygon", polygon}, {"lowest_m", fence.lowest_m}, {"highest_m", fence.highest_m}};
}

}  // namespace

Json health_message(const health_t& message) {
  Json loops = Json::array(), counters = Json::object();
  for (const loop_health_t& loop : message.loops) loops.push_back(loop_json(loop));
  for (const counter_t& counter : message.counters) counters[counter.name] = counter.value;
  return {{"utime", message.utime},
          {"process", message.process},
          {"loops", std::move(loops)},
          {"counters", std::move(counters)}};
}

Json link_message(const RobotState& state, double t, double lost_s) {
  Json json = Json::object(), channels = Json::object();
  double newest = NAN;
  for (const auto& [channel, heard] : state.heard) {
    channels[channel] = rounded(std::max(0.0, t - heard));
    newest = std::isnan(newest) ? heard : std::max(newest, heard);
  }
  if (std::isfinite(newest)) put(json, "age_s", std::max(0.0, t - newest));
  json["lost"] = !(t - newest <= lost_s);
  json["channels"] = std::move(channels);
  json["malformed"] = state.malformed;
  const auto recent = std::count_if(state.arrivals.begin(), state.arrivals.end(),
                                    [&](double heard) { return t - heard <= 1; });
  json["message_rate_hz"] = recent;
  return json;
}

Json site_message(const RobotState& state, const Site& site) {
  Json json = {{"robot", state.robot},
               {"colour", array(state.colour)},
               {"geofence", fence_json(site.geofence)}};
  if (site.origin)
    json["origin"] = {{"latitude_deg", site.origin->latitude_deg},
                      {"longitude_deg", site.origin->longitude_deg},
                      {"heading_deg", site.origin->heading_deg}};
  RobotState prior;
  for (const objects::MapObject& object : site.prior.objects)
    prior.objects.emplace(object.id, shown(object, 0));
  prior.objects_utime = 1;
  Site plain = site;
  plain.prior.objects.clear();
  Json objects = Json::array();
  Json message = objects_message(prior, plain, 0).value();
  for (Json& object : message["objects"]) {
    object.erase("target");
    objects.push_back(std::move(object));
  }
  json["prior"] = {{"objects", std::move(objects)}};
  json["classes"] = classes_json(site.classes);
  json["limits"] = {{"battery_return_share", site.battery_return_share},
                    {"battery_land_share", site.battery_land_share},
                    {"land_after_s", site.land_after_s}};
  return json;
}

}  // namespace saker::flight::viewers
