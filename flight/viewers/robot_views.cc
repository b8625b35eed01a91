#include "flight/viewers/robot_views.h"

namespace saker::flight::viewers {
namespace {

template <class Message>
std::optional<Message> decoded(RobotViews::Bytes bytes) {
  Message message{};
  if (message.decode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) return std::nullopt;
  return message;
}

template <class Message>
bool is(const std::string& suffix) {
  return suffix == kChannel<Message>.suffix;
}

}  // namespace

RobotViews::RobotViews(std::shared_ptr<const Site> site, double lost_s)
    : site_(std::move(site)), lost_s_(lost_s) {}

RobotView* RobotViews::of(const std::string& robot) { return add(robot, site_); }

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
  const bool fine = message && view.hear(*message, t);
  if (!fine) view.count_malformed();
  return fine;
}

bool RobotViews::hear(const std::string& channel, Bytes bytes, double t) {
  const std::string robot = robot_of(channel);
  const std::string suffix = channel.substr(robot.size());
  if (is<scan_t>(suffix) ? !scans_ : is<occupancy_t>(suffix) && !occupancy_) return true;
  RobotView* const view = of(robot);
  if (view == nullptr) return false;
  if (is<vehicle_state_t>(suffix)) return hear_as<vehicle_state_t>(*view, bytes, t);
  if (is<odometry_t>(suffix)) return hear_as<odometry_t>(*view, bytes, t);
  if (is<trajectory_t>(suffix)) return hear_as<trajectory_t>(*view, bytes, t);
  if (is<plan_t>(suffix)) return hear_as<plan_t>(*view, bytes, t);
  if (is<mission_t>(suffix)) return hear_as<mission_t>(*view, bytes, t);
  if (is<verdict_t>(suffix)) return hear_as<verdict_t>(*view, bytes, t);
  if (is<detections_t>(suffix)) return hear_as<detections_t>(*view, bytes, t);
  if (is<object_map_t>(suffix)) return hear_as<object_map_t>(*view, bytes, t);
  if (is<health_t>(suffix)) return hear_as<health_t>(*view, bytes, t);
  if (is<scan_t>(suffix)) {
    auto message = decoded<scan_t>(bytes);
    ScanJoiner& joiner = scan_joiners_[robot];
    auto scan = message ? joiner.add(std::move(*message)) : std::nullopt;
    if (scan) view->hear(std::move(*scan), t);
    return message && joiner.accepted();
  }
  if (is<occupancy_t>(suffix)) {
    auto message = decoded<occupancy_t>(bytes);
    OccupancyJoiner& joiner = occupancy_joiners_[robot];
    auto grid = message ? joiner.add(std::move(*message)) : std::nullopt;
    if (grid) view->hear(std::move(*grid), t);
    return message && joiner.accepted();
  }
  return false;
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
