#pragma once

#include <span>
#include <string>

/// What viewers can subscribe to, one topic a robot and kind (topics.md): names, schemas, rates.
namespace saker::flight::viewers {

enum class Topic {
  objects,
  state,
  odometry,
  path,
  trajectory,
  plan,
  mission,
  health,
  verdict,
  detections,
  link,
  site,
  orders,
  figures,
  scene,
  transforms,
  location,
  log,
  points,
  occupancy,
};
inline constexpr int kTopics = static_cast<int>(Topic::occupancy) + 1;

struct TopicInfo {
  const char* name;    ///< after the robot: "objects"
  const char* schema;  ///< "saker.Objects", "foxglove.SceneUpdate"
  double period_s;     ///< messages are at least so far apart; 0: each one counts
  int kept;            ///< messages that a server keeps; 0: it is made for those who ask alone
  bool at_once;        ///< all that are kept come after a subscription, not the newest alone
};

[[nodiscard]] const TopicInfo& info(Topic topic);

/// "/R1/objects".
[[nodiscard]] std::string topic_name(const std::string& robot, Topic topic);

/// JSON Schema of a topic's messages, of plain types alone, in one line.
[[nodiscard]] const std::string& schema_of(Topic topic);

/// The same of what is said of playback (`/playback`), and of a service's request and response.
inline constexpr const char* kPlaybackTopic = "/playback";
inline constexpr const char* kPlaybackSchema = "saker.Playback";
[[nodiscard]] const std::string& playback_schema();

}  // namespace saker::flight::viewers
