#include "flight/viewers/recording.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "flight/viewers/ros_cloud.h"
#include "saker/core/error.h"

namespace saker::flight::viewers {
namespace {

constexpr double kStep_s = 0.05;  // faster than any topic
constexpr double kLongest_s = 30.0 * 24 * 3600;

Time time_of(double t) { return static_cast<Time>(std::llround(t * 1e6)) * 1000; }

}  // namespace

void Recording::add(const std::string& robot, const Said& said) {
  const std::string topic = topic_name(robot, said.topic);
  auto at = channels_.find(topic);
  if (at == channels_.end()) {
    const std::uint16_t id = writer_.add({.topic = topic,
                                          .encoding = "json",
                                          .schema_name = info(said.topic).schema,
                                          .schema_encoding = "jsonschema",
                                          .schema = schema_of(said.topic)});
    at = channels_.emplace(topic, id).first;
  }
  writer_.write(at->second, time_of(said.t), said.json);
}

void Recording::add_scan(const RobotState& state) {
  if (!state.scan) return;
  auto [last, is_new] = scans_.try_emplace(state.robot, -std::numeric_limits<double>::infinity());
  if (state.scan->t == last->second) return;
  last->second = state.scan->t;
  writer_.write(scan_channel(state.robot), time_of(state.scan->t),
                ros_cloud(state.scan->message, frame_of(state, "lidar")));
}

void Recording::add_scan(const std::string& robot, const lidar::Scan& scan) {
  sensed_.insert(robot);
  writer_.write(scan_channel(robot), scan.stamp, ros_cloud(scan, robot + "/lidar"));
}

std::uint16_t Recording::scan_channel(const std::string& robot) {
  const std::string topic = fmt::format("/{}/scan", robot);
  auto at = channels_.find(topic);
  if (at == channels_.end()) {
    const std::uint16_t id = writer_.add({.topic = topic,
                                          .encoding = "cdr",
                                          .schema_name = kRosCloudType,
                                          .schema_encoding = "ros2msg",
                                          .schema = kRosCloudDefinition});
    at = channels_.emplace(topic, id).first;
  }
  return at->second;
}

void Recording::add_due(RobotViews& views, double t) {
  for (auto& [robot, view] : views.all()) {
    for (const Said& said : view.take_due(t, [](Topic) { return true; })) add(robot, said);
    if (!sensed_.contains(robot)) add_scan(view.state());
  }
}

std::uint64_t record_run(Run& run, const Site& site, Recording& recording, const AddToViews& more) {
  if (!(run.end_s() - run.begin_s() <= kLongest_s))
    throw Error(
        fmt::format("the times of this run go from {:.0f} s to {:.0f} s, over 30 days: its "
                    "clock was set meanwhile",
                    run.begin_s(), run.end_s()));
  RobotViews views(std::make_shared<const Site>(site), std::numeric_limits<double>::infinity());
  views.want_bulk(true, true);
  const auto steps = static_cast<long>(std::ceil((run.end_s() - run.begin_s()) / kStep_s));
  for (long i = 0; i <= steps; ++i) {
    const double t = std::min(run.begin_s() + static_cast<double>(i) * kStep_s, run.end_s());
    run.advance(t, views);
    if (more) more(t, views);
    recording.add_due(views, t);
  }
  // What came since its topic was last said is not lost.
  for (auto& [robot, view] : views.all()) view.say_again();
  recording.add_due(views, run.end_s());
  recording.finish();
  return recording.messages();
}

std::uint64_t record_run(Run& run, const Site& site, const std::filesystem::path& file) {
  Recording recording(file);
  return record_run(run, site, recording);
}

}  // namespace saker::flight::viewers
