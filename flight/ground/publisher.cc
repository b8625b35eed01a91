#include "flight/ground/publisher.h"

#include <spdlog/spdlog.h>

#include <cmath>

#include "saker/core/error.h"

namespace saker::flight::ground {

using viewers::Topic;

Time viewers_time(double t) { return static_cast<Time>(std::llround(t * 1e6)) * 1000; }

bool Publisher::is_offered(Topic topic) const {
  const bool of_live = topic == Topic::link || topic == Topic::orders;
  return live_ ? topic != Topic::figures : !of_live;
}

const Publisher::Channels& Publisher::channels_of(const std::string& robot) {
  const auto [at, is_new] = robots_.try_emplace(robot, Channels{});
  if (!is_new) return at->second;
  for (int i = 0; i < viewers::kTopics; ++i) {
    const auto topic = static_cast<Topic>(i);
    if (!is_offered(topic)) continue;
    const viewers::TopicInfo& about = viewers::info(topic);
    at->second[static_cast<std::size_t>(i)] =
        hub_.add_channel(viewers::topic_name(robot, topic), about.schema, viewers::schema_of(topic),
                         about.kept, about.at_once);
  }
  return at->second;
}

void Publisher::record(const std::function<void(viewers::Recording&)>& add) {
  if (recording_ == nullptr) return;
  try {
    add(*recording_);
  } catch (const Error& error) {
    spdlog::error("the recording ends: {}", error.what());
    recording_ = nullptr;
  }
}

void Publisher::publish_due(viewers::RobotViews& views, double t) {
  for (auto& [robot, view] : views.all()) {
    const Channels& channels = channels_of(robot);
    const auto wanted_of = [&](Topic topic) {
      const std::uint64_t channel = channels[static_cast<std::size_t>(topic)];
      return recording_ != nullptr || (channel != 0 && hub_.wanted(channel));
    };
    for (viewers::Said& said : view.take_due(t, wanted_of)) {
      record([&](viewers::Recording& recording) { recording.add(robot, said); });
      const std::uint64_t channel = channels[static_cast<std::size_t>(said.topic)];
      if (channel != 0) hub_.publish(channel, viewers_time(said.t), std::move(said.json));
    }
    record([&](viewers::Recording& recording) { recording.add_scan(view.state()); });
  }
}

bool Publisher::wanted(Topic topic) const {
  if (recording_ != nullptr) return true;
  for (const auto& [robot, channels] : robots_) {
    const std::uint64_t channel = channels[static_cast<std::size_t>(topic)];
    if (channel != 0 && hub_.wanted(channel)) return true;
  }
  return false;
}

}  // namespace saker::flight::ground
