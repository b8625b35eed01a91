#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "flight/bus/channels.h"
#include "flight/viewers/site.h"
#include "saker/autonomy/plant.h"
#include "saker/occupancy/grid.h"

/// What is known of one robot now: what its messages said last, and what follows from several of
/// them. Times `t` are seconds of the viewers' clock: when it was heard live, the recording's else.
namespace saker::flight::viewers {

/// The newest message of a kind.
template <class Message>
struct Heard {
  Message message{};
  double t = NAN;
};

/// An object of the map as it is drawn.
struct ShownObject {
  objects::MapObject object;
  Eigen::Vector2d position_sd = Eigen::Vector2d::Constant(NAN);  ///< m, x and y of its own frame
  Eigen::Vector2d size_sd = Eigen::Vector2d::Constant(NAN);  ///< m, length and width, or diameter
  double t = NAN;                                            ///< when it was last said

  /// xx, xy, yy of its place in the frame of the map, m²; NaN where not known.
  [[nodiscard]] Eigen::Vector3d place_covariance() const;
};

/// Nothing where it is no object.
[[nodiscard]] std::optional<ShownObject> shown(const map_object_t& message, int classes, double t);
/// With the covariance of a file.
[[nodiscard]] ShownObject shown(const objects::MapObject& object, double t);

/// What became of a target.
struct TargetNote {
  std::string state = "waiting";  ///< next, planned, waiting, left, done, visited, unreachable
  std::string reason;
  int tour = -1;  ///< place in the tour
};

/// Where it flew: a point every so far, the whole way in at most kMost points.
class FlownPath {
 public:
  static constexpr std::size_t kMost = 4000;

  void add(const Eigen::Vector3d& p, double t);
  void clear() { *this = FlownPath(); }

  [[nodiscard]] const std::vector<Eigen::Vector3d>& points() const { return points_; }
  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] double length_m() const { return length_m_; }

 private:
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> times_;
  Eigen::Vector3d last_ = Eigen::Vector3d::Constant(NAN);  // that was added, thinned since or not
  double spacing_m_ = 0.25;
  double length_m_ = 0;
};

struct RobotState {
  static constexpr std::size_t kMostObjects = 20000;

  std::string robot;
  core::Colour colour;

  std::optional<Heard<vehicle_state_t>> vehicle;
  std::optional<Heard<odometry_t>> odometry;
  std::optional<Heard<trajectory_t>> trajectory;
  std::optional<Heard<plan_t>> plan;
  std::optional<Heard<mission_t>> mission;
  std::optional<Heard<verdict_t>> verdict;
  std::optional<Heard<detections_t>> detections;
  std::optional<Heard<autonomy::RegisteredScan>> scan;
  std::optional<Heard<occupancy::OccupancyGrid>> occupancy;

  std::map<int, ShownObject> objects;  ///< by id
  std::int64_t objects_utime = 0;
  int objects_total = 0;
  std::vector<objects::GroundPlane> ground;
  std::map<int, TargetNote> targets;  ///< by the id of the target
  FlownPath path;
  double gain_nat = 0;  ///< promised by viewpoints that were chosen

  std::map<std::string, double> heard;  ///< t of the newest message, by channel ("ODOMETRY")
  long malformed = 0;
  std::deque<double> arrivals;  ///< of the last two seconds
};

/// Why a viewpoint was refused, as PLAN says it; empty where it was not.
[[nodiscard]] std::string refusal_words(const candidate_t& candidate);

[[nodiscard]] inline std::string frame_of(const RobotState& state, const char* frame) {
  return state.robot + "/" + frame;
}

/// Targets of the prior map that objects of the map are: {id of the object: id of the target}, each
/// to the nearest of its class within 3 m in x-y.
[[nodiscard]] std::map<int, int> targets_by_object(const RobotState& state, const Site& site);

}  // namespace saker::flight::viewers
