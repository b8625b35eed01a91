#include "saker/lidar/bags/topic_choice.h"

#include <algorithm>
#include <set>

#include "saker/core/error.h"

namespace saker::lidar {
namespace {

using Names = std::vector<std::string>;

bool readable(const Topic& topic) { return topic.encoding != Encoding::kOther; }

bool has_type(const Topic& topic, std::initializer_list<const char*> types) {
  return readable(topic) &&
         std::any_of(types.begin(), types.end(), [&](const char* t) { return topic.type == t; });
}

bool is_cloud(const Topic& topic) { return has_type(topic, {"sensor_msgs/PointCloud2"}); }

bool is_livox(const Topic& topic) {
  return has_type(topic, {"livox_ros_driver/CustomMsg", "livox_ros_driver2/CustomMsg",
                          "livox_interfaces/CustomMsg"});
}

bool is_packet(const Topic& topic) {
  return has_type(topic, {"ouster_ros/PacketMsg", "ouster_sensor_msgs/PacketMsg"});
}

bool is_spinning(const Topic& topic) {
  return has_type(topic, {"velodyne_msgs/VelodyneScan", "pandar_msgs/PandarScan",
                          "hesai_lidar/PandarScan", "hesai_ros_driver/UdpFrame"});
}

std::string space_of(const std::string& name) { return name.substr(0, name.rfind('/')); }

/// One topic with scans, or the packets of one sensor.
struct Candidate {
  ScanMessage kind;
  std::vector<std::size_t> topics;
  std::string name;
  long messages = 0;
};

std::vector<Candidate> candidates_in(const std::vector<Topic>& topics) {
  std::vector<Candidate> found;
  for (std::size_t i = 0; i < topics.size(); ++i) {
    const Topic& topic = topics[i];
    if (is_cloud(topic) || is_livox(topic)) {
      const auto kind = is_cloud(topic) ? ScanMessage::kPointCloud2 : ScanMessage::kLivox;
      found.push_back({kind, {i}, topic.name, topic.messages});
    }
    if (is_spinning(topic)) {
      found.push_back({ScanMessage::kSpinningPackets, {i}, topic.name, topic.messages});
    }
    if (!is_packet(topic)) continue;
    const auto same = std::find_if(found.begin(), found.end(), [&](const Candidate& c) {
      return c.kind == ScanMessage::kOusterPackets && space_of(c.name) == space_of(topic.name);
    });
    if (same == found.end()) {
      found.push_back({ScanMessage::kOusterPackets, {i}, topic.name, topic.messages});
      continue;
    }
    same->topics.push_back(i);
    if (topic.name.find("imu") == std::string::npos) {
      same->name = topic.name;
      same->messages = topic.messages;
    }
  }
  // Of topics without a message only where there is nothing else.
  const auto heard = [](const Candidate& c) { return c.messages > 0; };
  if (std::any_of(found.begin(), found.end(), heard)) {
    std::erase_if(found, [&](const Candidate& c) { return !heard(c); });
  }
  return found;
}

template <class List, class Name>
std::string list_of(const List& list, Name&& name) {
  std::string text;
  for (const auto& entry : list) text += (text.empty() ? "" : ", ") + name(entry);
  return text.empty() ? "none" : text;
}

std::string describe(const Topic& topic) {
  return topic.name + " (" + topic.type + ", " + std::to_string(topic.messages) + ")";
}

/// Letters that two names begin with.
std::size_t alike(const std::string& a, const std::string& b) {
  return static_cast<std::size_t>(
      std::mismatch(a.begin(),
                    a.begin() + static_cast<std::ptrdiff_t>(std::min(a.size(), b.size())),
                    b.begin())
          .first -
      a.begin());
}

int choose_imu(const std::vector<Topic>& topics, const Names& wanted, const std::string& scans) {
  int best = -1;
  for (std::size_t i = 0; i < topics.size(); ++i) {
    if (!has_type(topics[i], {"sensor_msgs/Imu"})) continue;
    if (std::find(wanted.begin(), wanted.end(), topics[i].name) != wanted.end()) {
      return static_cast<int>(i);
    }
    if (topics[i].messages == 0) continue;
    if (best < 0 || alike(topics[i].name, scans) > alike(topics[best].name, scans)) {
      best = static_cast<int>(i);
    }
  }
  return best;
}

const Candidate& choose(const std::vector<Candidate>& candidates, const std::vector<Topic>& topics,
                        const Names& wanted, const std::string& where) {
  if (candidates.empty()) {
    throw Error(where +
                ": no topic with scans (sensor_msgs/PointCloud2, packets of Ouster, Velodyne " +
                "and Hesai, Livox's CustomMsg), found " + list_of(topics, describe));
  }
  for (const Candidate& candidate : candidates) {
    for (const std::size_t topic : candidate.topics) {
      const std::string& name = topics[topic].name;
      if (std::find(wanted.begin(), wanted.end(), name) != wanted.end()) return candidate;
    }
  }
  if (candidates.size() == 1) return candidates.front();
  // A driver's cloud beside the packets that it was made of counts alone.
  const auto cloud = [](const Candidate& c) { return c.kind != ScanMessage::kSpinningPackets; };
  if (std::count_if(candidates.begin(), candidates.end(), cloud) == 1) {
    return *std::find_if(candidates.begin(), candidates.end(), cloud);
  }
  throw Error(where + ": " + std::to_string(candidates.size()) + " topics with scans, " +
              list_of(candidates,
                      [&](const Candidate& c) {
                        return c.name + " (" + topics[c.topics.front()].type + ", " +
                               std::to_string(c.messages) + ")";
                      }) +
              ": choose one with --topic");
}

}  // namespace

TopicChoice choose_topics(const std::vector<Topic>& topics, const Names& wanted,
                          const std::string& where) {
  for (const std::string& name : wanted) {
    const auto named = [&](const Topic& topic) { return topic.name == name; };
    if (std::none_of(topics.begin(), topics.end(), named)) {
      throw Error(where + ": --topic " + name + ": not in it, found " + list_of(topics, describe));
    }
  }
  const std::vector<Candidate> candidates = candidates_in(topics);
  const Candidate& chosen = choose(candidates, topics, wanted, where);
  TopicChoice choice;
  choice.kind = chosen.kind;
  choice.scans = chosen.topics;
  choice.name = chosen.name;
  if (chosen.kind == ScanMessage::kOusterPackets) return choice;
  choice.imu = choose_imu(topics, wanted, chosen.name);
  if (choice.imu >= 0) choice.imu_name = topics[static_cast<std::size_t>(choice.imu)].name;
  return choice;
}

bool is_metadata(const Topic& topic) { return has_type(topic, {"std_msgs/String"}); }

bool is_static_transform(const Topic& topic) {
  return has_type(topic, {"tf2_msgs/TFMessage", "tf/tfMessage"}) &&
         topic.name.find("tf_static") != std::string::npos;
}

}  // namespace saker::lidar
