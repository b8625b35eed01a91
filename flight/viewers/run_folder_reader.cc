#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "flight/bus/messages.h"
#include "flight/bus/object_messages.h"
#include "flight/run_files/detections_file.h"
#include "flight/viewers/run_folder.h"
#include "saker/autonomy/cause.h"
#include "saker/core/error.h"
#include "saker/core/files.h"
#include "saker/objects/map_io.h"

/// A robot's folder as a run.
namespace saker::flight::viewers {
namespace {

namespace fs = std::filesystem;

/// Objects by where they are, for many questions.
class Places {
 public:
  explicit Places(const objects::ObjectMap& map) {
    for (const objects::MapObject& object : map.objects)
      cells_[cell_of(objects::place(object.model))].push_back(&object);
  }

  /// Of the class, nearest in x-y within kGate_m; null where there is none.
  [[nodiscard]] const objects::MapObject* nearest(const Eigen::Vector3d& p,
                                                  objects::ClassId id) const {
    const objects::MapObject* found = nullptr;
    double least = kGate_m;
    const auto [x, y] = cell_of(p);
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        const auto at = cells_.find({x + dx, y + dy});
        if (at == cells_.end()) continue;
        for (const objects::MapObject* object : at->second) {
          const double distance = (objects::place(object->model) - p).head<2>().norm();
          if (object->class_id != id || distance >= least) continue;
          least = distance;
          found = object;
        }
      }
    }
    return found;
  }

 private:
  static constexpr double kGate_m = 2;  // of a measurement of it, before SLAM

  static std::pair<int, int> cell_of(const Eigen::Vector3d& p) {
    const Eigen::Vector2d scaled = p.head<2>() / kGate_m;
    return {static_cast<int>(std::floor(scaled.x())), static_cast<int>(std::floor(scaled.y()))};
  }

  std::map<std::pair<int, int>, std::vector<const objects::MapObject*>> cells_;
};

/// Windows of measurements as messages, and when each object was first measured.
void read_windows(const fs::path& file, RobotRun& run) {
  const objects::ClassTable& table = run.site->classes;
  const auto measured = read_detections(file, table);
  const Places places(run.map);
  std::set<int> seen;
  objects::Detections window;
  const auto close_window = [&] {
    if (!window.measurements.empty()) run.detections.push_back(to_lcm(window));
    window.measurements.clear();
  };
  for (const objects::Measurement& m : measured) {
    if (m.stamp != window.stamp) close_window();
    window.stamp = m.stamp;
    window.measurements.push_back(m);
    const StampedPose* pose = pose_at(run.poses, to_seconds(m.stamp));
    if (pose == nullptr) continue;
    const auto* object = places.nearest(pose->T_world_lidar * objects::place(m.model), m.class_id);
    if (object != nullptr && seen.insert(object->id).second)
      run.reveals.push_back({to_seconds(m.stamp), object->id});
  }
  close_window();
}

int code_of(const std::string& cause) {
  for (int code = 0; code <= static_cast<int>(autonomy::kLastCause); ++code) {
    if (cause == to_string(static_cast<autonomy::Cause>(code))) return code;
  }
  return 0;
}

/// Transitions of a mission: their times count from the beginning of the run.
void take_events(const Json& results, double begin_s, RobotRun& run) {
  double took_off = NAN;
  const int targets = results.value("targets", 0);
  for (const Json& event : results.value("events", Json::array())) {
    RobotRun::Event row{.t = begin_s + event.at("t_s").get<double>(), .message = {}};
    mission_t& message = row.message;
    message.utime = static_cast<std::int64_t>(row.t * 1e6);
    message.phase = event.at("to").get<std::string>();
    message.cause_code = code_of(event.at("cause").get<std::string>());
    message.cause = event.at("text").get<std::string>();
    message.targets = targets;
    if (event.at("cause") == "armed") took_off = row.t;
    message.elapsed_s = static_cast<float>(row.t - took_off);
    run.events.push_back(std::move(row));
  }
}

/// Copying and writing JSON takes a stack as deep as it is nested: a file must not end the program.
Json parsed(const fs::path& file) {
  constexpr int kDeepest = 64;
  return Json::parse(core::read_file(file), [&](int depth, Json::parse_event_t, const Json&) {
    if (depth > kDeepest) throw Error(fmt::format("{}: nested over 64 deep", file.string()));
    return true;
  });
}

void read_results(const fs::path& file, RobotRun& run) {
  try {
    run.figures = parsed(file);
    const double begin_s = run.poses.empty() ? 0 : run.poses.front().t;
    take_events(run.figures, begin_s, run);
    for (const Json& target : run.figures.value("target_list", Json::array()))
      run.targets[target.at("id").get<int>()] = {.state = target.at("status").get<std::string>(),
                                                 .reason = target.at("reason").get<std::string>()};
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace

RobotRun read_robot_run(const fs::path& folder, const std::string& robot, const Site& site) {
  RobotRun run;
  run.robot = robot;
  Site own = site;
  own.T_body_lidar = SE3::Identity();  // poses of a run are the lidar's
  if (fs::exists(folder / "prior.json"))
    own.prior = objects::read_map(folder / "prior.json", site.classes);
  run.site = std::make_shared<const Site>(std::move(own));
  for (const char* name : {"map.json", "map.smap"}) {
    if (!fs::exists(folder / name)) continue;
    run.map = objects::read_map(folder / name, site.classes);
    break;
  }
  run.poses = read_trajectory(folder / "trajectory.txt");
  run.viewpoints = read_trajectory(folder / "viewpoints.txt");
  if (fs::exists(folder / "detections.jsonl")) read_windows(folder / "detections.jsonl", run);
  if (fs::exists(folder / "results.json")) read_results(folder / "results.json", run);
  return run;
}

}  // namespace saker::flight::viewers
