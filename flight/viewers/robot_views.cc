#include "flight/viewers/robot_views.h"

namespace saker::flight::viewers {
namespace {

template <class Message>
std::optional<Message> decoded(RobotViews::Bytes bytes) {
  Message message{};
  if (message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) return std::nullopt;
  return message;
}

}  // namespace

RobotViews::RobotViews(std::shared_ptr<const Site> site, double lost_s)
    : site_(std::move(site)), lost_s_(lost_s) {}

RobotView* RobotViews::of(const std::string& robot) { return add(robot, site_); }

RobotView* RobotViews::find(const std::string& robot) {
  const auto at = views_.find(robot);
  return at == views_.end() ? nullptr : &at->second;
}

RobotView* RobotViews::add(const std::string& robot, std::shared_ptr<const Site> site) {
  const auto at = views_.find(robot);
  if (at != views_.end()) return &at->second;
  if (views_.size() == kMostRobots) return nullptr;
  const core::Colour colour = colour_of_robot(views_.size());
  return &views_.try_emplace(robot, robot, colour, std::move(site), lost_s_).first->second;
}

template <class Message>
bool RobotViews::hear_as(RobotView& view, Bytes bytes, double t) {
  const auto message = decoded<Message>(bytes);
  return message && view.hear(*message, t);
}

template <class Message, class Joiner>
bool RobotViews::hear_joined(RobotView& view, Joiner& joiner, Bytes bytes, double t) {
  auto message = decoded<Message>(bytes);
  if (!message) return false;
  if (auto whole = joiner.add(std::move(*message))) view.hear(std::move(*whole), t);
  return joiner.accepted();
}

bool RobotViews::hear_scan(RobotView& view, Bytes bytes, double t) {
  return hear_joined<scan_t>(view, scan_joiners_[view.state().robot], bytes, t);
}

bool RobotViews::hear_occupancy(RobotView& view, Bytes bytes, double t) {
  return hear_joined<occupancy_t>(view, occupancy_joiners_[view.state().robot], bytes, t);
}

bool RobotViews::hear(const std::string& channel, Bytes bytes, double t) {
  using Hear = bool (RobotViews::*)(RobotView&, Bytes, double);
  static const std::map<std::string, Hear> kHear = {
      {kChannel<vehicle_state_t>.suffix, &RobotViews::hear_as<vehicle_state_t>},
      {kChannel<odometry_t>.suffix, &RobotViews::hear_as<odometry_t>},
      {kChannel<trajectory_t>.suffix, &RobotViews::hear_as<trajectory_t>},
      {kChannel<plan_t>.suffix, &RobotViews::hear_as<plan_t>},
      {kChannel<mission_t>.suffix, &RobotViews::hear_as<mission_t>},
      {kChannel<verdict_t>.suffix, &RobotViews::hear_as<verdict_t>},
      {kChannel<detections_t>.suffix, &RobotViews::hear_as<detections_t>},
      {kChannel<object_map_t>.suffix, &RobotViews::hear_as<object_map_t>},
      {kChannel<health_t>.suffix, &RobotViews::hear_as<health_t>},
      {kChannel<scan_t>.suffix, &RobotViews::hear_scan},
      {kChannel<occupancy_t>.suffix, &RobotViews::hear_occupancy}};
  const std::string robot = robot_of(channel);
  const auto at = kHear.find(channel.substr(robot.size()));
  if (at == kHear.end()) return false;
  if (at->second == &RobotViews::hear_scan && !scans_) return true;
  if (at->second == &RobotViews::hear_occupancy && !occupancy_) return true;
  RobotView* const view = of(robot);
  if (view == nullptr) return false;
  const bool fine = (this->*at->second)(*view, bytes, t);
  if (!fine) view->count_malformed();
  return fine;
}

void RobotViews::want_bulk(bool scans, bool occupancy) {
  scans_ = scans;
  occupancy_ = occupancy;
}

void RobotViews::clear() {
  views_.clear();
  scan_joiners_.clear();
  occupancy_joiners_.clear();
}

}  // namespace saker::flight::viewers
