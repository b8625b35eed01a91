#include "flight/viewers/robot_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flight/bus/messages.h"
#include "flight/bus/object_messages.h"
#include "flight/viewers/own_messages.h"
#include "flight/viewers/words.h"

namespace saker::flight::viewers {
namespace {

constexpr std::int64_t kRestartBack_us = 1000000;  // the sensor's clock began anew
constexpr long kMostEvents = 1000;                 // that wait to be said, of a topic
constexpr std::size_t kMostArrivals = 4096;
constexpr std::size_t kMostTargets = 4096;
constexpr std::size_t kMostPoints = 6000;  // of a cloud: 80 kB, 0.1 MB as text
constexpr std::size_t kMostCells = 8000;
constexpr double kNear_m = 12;  // of occupancy

}  // namespace

RobotView::RobotView(std::string robot, core::Colour colour, std::shared_ptr<const Site> site,
                     double lost_s)
    : site_(std::move(site)), lost_s_(lost_s) {
  state_.robot = std::move(robot);
  state_.colour = colour;
  said_.fill(-std::numeric_limits<double>::infinity());
  changed({Topic::site});
}

/// Where the clock was set back, what was heard before counts as heard now: it must not hide that
/// nothing comes any more.
void RobotView::heard(const char* channel, double t) {
  if (!state_.arrivals.empty() && state_.arrivals.back() > t) {
    for (auto& [other, at] : state_.heard) at = std::min(at, t);
    std::erase_if(state_.arrivals, [&](double at) { return at > t; });
  }
  state_.heard[channel] = t;
  state_.arrivals.push_back(t);
  while (state_.arrivals.size() > kMostArrivals || state_.arrivals.front() < t - 2)
    state_.arrivals.pop_front();
}

void RobotView::changed(std::initializer_list<Topic> topics) {
  for (const Topic topic : topics) changed_[static_cast<int>(topic)] = true;
}

bool RobotView::hear(const vehicle_state_t& message, double t) {
  if (!from_lcm(message)) return false;
  heard("STATE", t);
  state_.vehicle = {message, t};
  changed({Topic::state});
  return true;
}

bool RobotView::hear(const odometry_t& message, double t) {
  if (!from_lcm(message)) return false;
  heard("ODOMETRY", t);
  if (state_.odometry && message.utime < state_.odometry->message.utime - kRestartBack_us)
    forget_flight();
  state_.odometry = {message, t};
  const Eigen::Vector3d p(message.position[0], message.position[1], message.position[2]);
  state_.path.add(p, t);
  changed({Topic::odometry, Topic::path, Topic::transforms, Topic::location, Topic::scene});
  return true;
}

bool RobotView::hear(const trajectory_t& message, double t) {
  if (!from_lcm(message)) return false;
  heard("TRAJECTORY", t);
  const bool same = state_.trajectory && state_.trajectory->message.id == message.id &&
                    state_.trajectory->message.states.size() == message.states.size();
  state_.trajectory = {message, t};
  if (!same) changed({Topic::trajectory, Topic::scene});
  return true;
}

bool RobotView::hear(const plan_t& message, double t) {
  heard("PLAN", t);
  state_.plan = {message, t};
  take_tour(message);
  changed({Topic::plan, Topic::scene, Topic::objects});
  return true;
}

bool RobotView::hear(const mission_t& message, double t) {
  heard("MISSION", t);
  const bool first = !state_.mission;
  const bool moved = first || state_.mission->message.phase != message.phase ||
                     state_.mission->message.cause_code != message.cause_code;
  if (moved) {
    const auto level = is_trouble(message.cause_code) ? LogLevel::warning : LogLevel::info;
    log(level, message.phase + ": " + message.cause, t);
  }
  state_.mission = {message, t};
  if (message.phase == "return" || message.phase == "landing" || message.phase == "done")
    leave_tour();
  if (const auto json = mission_message(state_, *site_)) note(Topic::mission, t, *json);
  return true;
}

bool RobotView::hear(const verdict_t& message, double t) {
  if (!from_lcm(message)) return false;
  heard("VERDICT", t);
  state_.verdict = {message, t};
  changed({Topic::verdict});
  return true;
}

bool RobotView::hear(const detections_t& message, double t) {
  if (!from_lcm(message, site_->classes.size())) return false;
  heard("DETECTIONS", t);
  state_.detections = {message, t};
  changed({Topic::detections});
  return true;
}

bool RobotView::hear(const object_map_t& message, double t) {
  heard("OBJECTS", t);
  bool all = true;
  for (const map_object_t& entry : message.objects) {
    if (entry.observations <= 0) {
      state_.objects.erase(entry.id);
      continue;
    }
    const auto object = shown(entry, site_->classes.size(), t);
    const bool room = state_.objects.size() < RobotState::kMostObjects;
    if (!object || (!room && !state_.objects.contains(entry.id))) {
      all = false;
    } else {
      state_.objects.insert_or_assign(entry.id, *object);
    }
  }
  state_.objects_utime = message.utime;
  state_.objects_total = message.total;
  changed({Topic::objects, Topic::scene});
  return all;
}

bool RobotView::hear(const health_t& message, double t) {
  heard("HEALTH", t);
  note(Topic::health, t, health_message(message));
  return true;
}

void RobotView::hear(autonomy::RegisteredScan scan, double t) {
  heard("SCAN", t);
  state_.scan = {std::move(scan), t};
  changed({Topic::points});
}

void RobotView::hear(occupancy::OccupancyGrid grid, double t) {
  heard("OCCUPANCY", t);
  state_.occupancy = {std::move(grid), t};
  changed({Topic::occupancy});
}

void RobotView::set_map(const objects::ObjectMap& map, std::int64_t utime, double t) {
  state_.objects.clear();
  for (const objects::MapObject& object : map.objects)
    state_.objects.emplace(object.id, shown(object, t));
  state_.ground = map.ground;
  state_.objects_utime = utime;
  state_.objects_total = static_cast<int>(map.objects.size());
  changed({Topic::objects, Topic::scene});
}

void RobotView::set_targets(std::map<int, TargetNote> targets) {
  state_.targets = std::move(targets);
  changed({Topic::objects});
}

void RobotView::set_figures(Json figures) {
  figures_ = std::move(figures);
  changed({Topic::figures});
}

/// What is in the tour is planned, what the chosen viewpoint looks at is next. A tour that is empty
/// says nothing: while it holds, nothing is planned.
void RobotView::take_tour(const plan_t& plan) {
  const bool chosen = plan.choice >= 0 && plan.choice < static_cast<int>(plan.candidates.size());
  if (chosen && plan.trajectory_id != chosen_trajectory_) {
    const float gain = plan.candidates[static_cast<std::size_t>(plan.choice)].gain;
    if (std::isfinite(gain)) state_.gain_nat += gain;
    chosen_trajectory_ = plan.trajectory_id;
  }
  if (plan.tour.empty()) return;
  leave_tour();
  int place = 0;
  for (const std::int32_t id : plan.tour) {
    if (state_.targets.size() >= kMostTargets && !state_.targets.contains(id)) continue;
    state_.targets[id] = {.state = "planned", .reason = "", .tour = place++};
  }
  if (!chosen) return;
  const auto next =
      state_.targets.find(plan.candidates[static_cast<std::size_t>(plan.choice)].target_id);
  if (next != state_.targets.end()) next->second.state = "next";
}

void RobotView::leave_tour() {
  for (auto& [id, note] : state_.targets) {
    if (note.state == "planned" || note.state == "next") note = {.state = "left", .reason = ""};
  }
}

void RobotView::forget_flight() {
  RobotState fresh;
  fresh.robot = state_.robot;
  fresh.colour = state_.colour;
  fresh.heard = std::move(state_.heard);
  fresh.arrivals = std::move(state_.arrivals);
  fresh.malformed = state_.malformed;
  state_ = std::move(fresh);
  chosen_trajectory_ = 0;
}

/// Of too many of a topic the oldest go; those of other topics stay.
void RobotView::note(Topic topic, double t, Json json) {
  const auto of_topic = [&](const Event& event) { return event.topic == topic; };
  if (std::ranges::count_if(events_, of_topic) >= kMostEvents)
    events_.erase(std::ranges::find_if(events_, of_topic));
  events_.push_back({topic, t, std::move(json)});
}

void RobotView::log(LogLevel level, const std::string& text, double t) {
  note(Topic::log, t, log_message(state_.robot, level, text, t));
}

void RobotView::say_order(const Json& order, double t) { note(Topic::orders, t, order); }

void RobotView::watch_link(double t) {
  if (!std::isfinite(lost_s_) || state_.heard.empty()) return;
  changed({Topic::link});
  double newest = 0;
  for (const auto& [channel, heard_t] : state_.heard) newest = std::max(newest, heard_t);
  const bool lost = t - newest > lost_s_;
  if (lost == lost_) return;
  lost_ = lost;
  said_[static_cast<int>(Topic::link)] = -std::numeric_limits<double>::infinity();
  log(lost ? LogLevel::error : LogLevel::info,
      lost ? "the link is lost: nothing was heard for a while" : "the link is back", t);
}

bool RobotView::due(Topic topic, double t) const {
  const auto i = static_cast<std::size_t>(topic);
  // A tick may come a little early; what went back in time is a jump.
  constexpr double kEarly = 0.9;
  return changed_[i] && (t - said_[i] >= kEarly * info(topic).period_s || t < said_[i]);
}

std::vector<Said> RobotView::take_due(double t, const std::function<bool(Topic)>& wanted) {
  watch_link(t);
  std::vector<Said> said;
  for (int i = 0; i < kTopics; ++i) {
    const auto topic = static_cast<Topic>(i);
    if (!due(topic, t) || (info(topic).kept == 0 && !wanted(topic))) continue;
    const auto json = message(topic, t);
    if (!json) continue;
    said.push_back({topic, t, json->dump(-1, ' ', false, Json::error_handler_t::replace)});
    changed_[static_cast<std::size_t>(i)] = false;
    said_[static_cast<std::size_t>(i)] = t;
  }
  for (const Event& event : events_)
    said.push_back(
        {event.topic, event.t, event.json.dump(-1, ' ', false, Json::error_handler_t::replace)});
  events_.clear();
  return said;
}

std::optional<Json> RobotView::message(Topic topic, double t) {
  switch (topic) {
    case Topic::objects:
      return objects_message(state_, *site_, t);
    case Topic::state:
      return vehicle_message(state_);
    case Topic::odometry:
      return odometry_message(state_);
    case Topic::path:
      return path_message(state_);
    case Topic::trajectory:
      return trajectory_message(state_);
    case Topic::plan:
      return plan_message(state_);
    case Topic::verdict:
      return verdict_message(state_);
    case Topic::detections:
      return detections_message(state_, *site_);
    case Topic::link:
      return link_message(state_, t, lost_s_);
    case Topic::site:
      return site_message(state_, *site_);
    case Topic::figures:
      return figures_.is_null() ? std::nullopt : std::optional(figures_);
    case Topic::scene:
      return scene_update(state_, *site_, t, shown_ids_);
    case Topic::transforms:
      return frame_transforms(state_, *site_, t);
    case Topic::location:
      return location_fix(state_, *site_, t);
    case Topic::points:
      return point_cloud(state_, t, kMostPoints);
    case Topic::occupancy:
      return occupied_cells(state_, t, kNear_m, kMostCells);
    case Topic::mission:
      return mission_message(state_, *site_);
    case Topic::health:
    case Topic::orders:
    case Topic::log:
      return std::nullopt;
  }
  return std::nullopt;
}

void RobotView::say_again() {
  changed_.fill(true);
  said_.fill(-std::numeric_limits<double>::infinity());
}

}  // namespace saker::flight::viewers
