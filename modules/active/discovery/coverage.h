#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "saker/active/discovery/discovery_config.h"
#include "saker/active/views/viewpoint.h"
#include "saker/motion/geofence.h"
#include "saker/objects/object_map.h"

namespace saker::active {

/// What was seen of the geofence, and where to fly in order to see the rest.
///
/// Reads poses, occupancy and the map's ground, makes stops: those on the lines of a sweep
/// (sweep_lines.h), and one for each square that no line comes near. A square belongs to its
/// nearest stop; a stop is due while too few of its squares were seen and it is not closed. There
/// are finitely many and none opens again: a sweep ends. Frames: geofence, stops and squares are in
/// `world`, x-y. Cost: three look-ups in the block for each square in range that was not seen.
class Coverage {
 public:
  /// \param view whose range, in x-y, is that from which a square is seen.
  /// The sweep begins at that end of it that is nearer to the place of take-off. Throws Error where
  /// the geofence has too many squares.
  Coverage(const SweepConfig& config, const FieldOfViewConfig& view, const motion::Geofence& fence);

  /// The lidar was at `eye` for `seconds`. It saw the squares in range of which it is known what
  /// stands there; one that is tilted those between its beams, for a level one has them there on
  /// the way.
  void observe(const Eigen::Vector3d& eye, double yaw, double seconds, const OccupancyView& block,
               const objects::ObjectMap* map);

  /// The stop to fly to: the first that is due, from the last one on and around; none: covered.
  [[nodiscard]] std::optional<std::size_t> next();

  void close(std::size_t stop) { closed_[stop] = true; }

  [[nodiscard]] bool due(std::size_t stop) const;
  [[nodiscard]] const std::vector<Eigen::Vector2d>& stops() const { return stops_; }
  [[nodiscard]] double seen_share() const;  ///< of the geofence

 private:
  struct Square {
    Eigen::Vector2d middle;
    std::size_t stop;
    double seen_s = 0;
  };

  [[nodiscard]] std::vector<Eigen::Vector2d> middles(const motion::Geofence& fence) const;
  void assign(const std::vector<Eigen::Vector2d>& middles);
  [[nodiscard]] bool in_view(const Eigen::Vector3d& eye, double yaw, const Eigen::Vector2d& middle,
                             const objects::ObjectMap* map) const;

  SweepConfig config_;
  FieldOfViewConfig view_;
  std::vector<Eigen::Vector2d> stops_;
  std::vector<Square> squares_;
  std::vector<int> squares_of_, seen_of_;  ///< numbers, one a stop
  std::vector<bool> closed_;
  std::size_t current_ = 0;
};

}  // namespace saker::active
