#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "flight/viewers/mcap_writer.h"
#include "flight/viewers/robot_views.h"
#include "flight/viewers/run.h"
#include "saker/lidar/scan.h"

/// What viewers are told, in an MCAP file: the same topics and schemas as on the WebSocket, and
/// scans as `/R1/scan` (sensor_msgs/PointCloud2 in CDR), which `saker replay` reads.
namespace saker::flight::viewers {

class Recording {
 public:
  explicit Recording(const std::filesystem::path& file) : writer_(file) {}

  void add(const std::string& robot, const Said& said);
  /// The newest scan, where it was not added before.
  void add_scan(const RobotState& state);
  /// A scan as the sensor said it, at its stamp. Of a robot with such ones `add_due` adds no other.
  void add_scan(const std::string& robot, const lidar::Scan& scan);
  /// What is due of all views, and their scans.
  void add_due(RobotViews& views, double t);
  void finish() { writer_.finish(); }

  [[nodiscard]] std::uint64_t messages() const { return writer_.messages(); }

 private:
  McapWriter writer_;
  [[nodiscard]] std::uint16_t scan_channel(const std::string& robot);

  std::map<std::string, std::uint16_t> channels_;  ///< by topic
  std::map<std::string, double> scans_;            ///< by robot: t of the one that was added last
  std::set<std::string> sensed_;                   ///< robots with scans as their sensor said them
};

/// What a run does not hold, up to the time `t` (s, the run's clock), into its views.
using AddToViews = std::function<void(double t, RobotViews& views)>;

/// A whole run, in steps of 50 ms, into a recording that may hold more; finishes it. \return
/// messages. Throws Error where it seems to last more than 30 days: the clock was set while it was
/// recorded, and steps would have no end.
std::uint64_t record_run(Run& run, const Site& site, Recording& recording,
                         const AddToViews& more = {});
/// The same into a file.
std::uint64_t record_run(Run& run, const Site& site, const std::filesystem::path& file);

}  // namespace saker::flight::viewers
