#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>

#include "flight/ground/hub.h"
#include "flight/viewers/recording.h"
#include "flight/viewers/robot_views.h"

namespace saker::flight::ground {

/// Robots' views → channels of the hub and, where there is one, a recording. A recording that
/// cannot be written (a full disk) ends with a line in the log; clients are served on.
class Publisher {
 public:
  /// \param recording  may be null; it and the hub outlive this
  Publisher(Hub& hub, viewers::Recording* recording, bool live)
      : hub_(hub), recording_(recording), live_(live) {}

  /// What is due of every robot; those that are new are made known first.
  void publish_due(viewers::RobotViews& views, double t);

  /// Whether a client, or the recording, wants a topic of any robot.
  [[nodiscard]] bool wanted(viewers::Topic topic) const;

 private:
  using Channels = std::array<std::uint64_t, viewers::kTopics>;  // 0: none

  [[nodiscard]] bool is_offered(viewers::Topic topic) const;
  const Channels& channels_of(const std::string& robot);
  void record(const std::function<void(viewers::Recording&)>& add);

  Hub& hub_;
  viewers::Recording* recording_;
  bool live_;
  std::map<std::string, Channels> robots_;
};

/// ns of the viewers' clock.
[[nodiscard]] Time viewers_time(double t);

}  // namespace saker::flight::ground
