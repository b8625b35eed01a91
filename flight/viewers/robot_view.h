#pragma once

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "flight/viewers/foxglove_messages.h"
#include "flight/viewers/robot_state.h"
#include "flight/viewers/topic.h"

namespace saker::flight::viewers {

/// A message for viewers.
struct Said {
  Topic topic;
  double t = 0;      ///< s, the viewers' clock
  std::string json;  ///< as topics.md has it
};

/// One robot for viewers: hears its messages, says what is due under each topic, no faster than the
/// topic's rate. What nobody wants is not made. Reads no clock; one thread.
class RobotView {
 public:
  /// \param lost_s  s of silence after which the link is lost; infinity: a run, which has no link
  RobotView(std::string robot, core::Colour colour, std::shared_ptr<const Site> site,
            double lost_s);

  // What was heard at `t`; false where it is not what it should be.
  bool hear(const vehicle_state_t& message, double t);
  bool hear(const odometry_t& message, double t);
  bool hear(const trajectory_t& message, double t);
  bool hear(const plan_t& message, double t);
  bool hear(const mission_t& message, double t);
  bool hear(const verdict_t& message, double t);
  bool hear(const detections_t& message, double t);
  bool hear(const object_map_t& message, double t);
  bool hear(const health_t& message, double t);
  void hear(autonomy::RegisteredScan scan, double t);
  void hear(occupancy::OccupancyGrid grid, double t);
  void count_malformed() { ++state_.malformed; }

  /// A map from a file, whole.
  void set_map(const objects::ObjectMap& map, std::int64_t utime, double t);
  void set_targets(std::map<int, TargetNote> targets);
  void set_figures(Json figures);

  void log(LogLevel level, const std::string& text, double t);
  /// What became of an order (topics.md, `orders`).
  void say_order(const Json& order, double t);

  /// What is due at `t`, of the topics that are wanted or kept.
  [[nodiscard]] std::vector<Said> take_due(double t, const std::function<bool(Topic)>& wanted);

  /// What a topic says now, whatever was said; of topics of events nothing.
  [[nodiscard]] std::optional<Json> message(Topic topic, double t);

  /// All that is known is due, whatever was said: after a jump in time.
  void say_again();

  [[nodiscard]] const RobotState& state() const { return state_; }

 private:
  void heard(const char* channel, double t);
  void note(Topic topic, double t, Json json);
  void changed(std::initializer_list<Topic> topics);
  void take_tour(const plan_t& plan);
  void leave_tour();
  void forget_flight();
  void watch_link(double t);
  [[nodiscard]] bool due(Topic topic, double t) const;

  RobotState state_;
  std::shared_ptr<const Site> site_;
  double lost_s_;
  bool lost_ = false;
  std::array<bool, kTopics> changed_{};
  std::array<double, kTopics> said_{};  // when
  struct Event {
    Topic topic;
    double t;
    Json json;
  };
  std::deque<Event> events_;
  std::set<int> shown_ids_;
  Json figures_;
  std::int64_t chosen_trajectory_ = 0;
};

}  // namespace saker::flight::viewers
