#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "flight/run_files/trajectory_file.h"
#include "flight/viewers/run.h"

namespace saker::flight::viewers {

/// One robot's part of a run, from its files; what is missing is empty.
struct RobotRun {
  struct Reveal {
    double t;  ///< s, of the first measurement of the object
    int id;
  };
  struct Event {
    double t;  ///< s
    mission_t message;
  };

  std::string robot;
  std::shared_ptr<const Site> site;     ///< with the prior map of this run
  std::vector<StampedPose> poses;       ///< T_world_lidar, after SLAM
  std::vector<StampedPose> viewpoints;  ///< that were flown to
  objects::ObjectMap map;               ///< as it was at the end
  std::vector<detections_t> detections;
  std::vector<Reveal> reveals;  ///< by time; what no measurement is of is there from the beginning
  std::vector<Event> events;
  std::map<int, TargetNote> targets;  ///< as they were at the end
  Json figures;
};

/// Reads a robot's folder. Throws Error, with the file, on what is malformed.
[[nodiscard]] RobotRun read_robot_run(const std::filesystem::path& folder, const std::string& robot,
                                      const Site& site);

/// A folder of `saker replay`, `experiment` (one run), `mission` (a folder a robot, and their map
/// as robot TEAM) or `saker-flight`. Objects are those of the end, each from its first measurement
/// on; measured how often, they are by then.
class FolderRun : public Run {
 public:
  /// Throws Error when there is neither a map nor a trajectory in it.
  FolderRun(const std::filesystem::path& folder, const Site& site);

  [[nodiscard]] double begin_s() const override { return begin_s_; }
  [[nodiscard]] double end_s() const override { return end_s_; }
  void advance(double t, RobotViews& views) override;
  void rewind(RobotViews& views) override;

 private:
  void advance(const RobotRun& run, double t, RobotView& view) const;
  void show_map(const RobotRun& run, double t, RobotView& view) const;

  std::vector<RobotRun> robots_;
  double begin_s_ = 0, end_s_ = 0;
  double at_s_ = 0;  // advanced to
};

}  // namespace saker::flight::viewers
