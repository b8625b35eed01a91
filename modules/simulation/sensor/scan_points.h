#pragma once

#include <string>
#include <vector>

#include "saker/simulation/sensor/sensor_model.h"

/// A scan as files list it: only the returns, in the order in which a driver wrote them.
///
/// Reads a cast scan. Frames: that of the scan's points until `move_points`.
namespace saker::simulation {

/// SemanticKITTI's id of returns from no surface: rain, dust, ghosts. It counts as no class.
inline constexpr std::uint16_t kOutlier = 1;

struct ScanPoint {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  float reflectivity = 0;
  std::uint16_t label = 0;
  ObjectId object = 0;
  std::uint16_t ring = 0;  ///< the row; 0: the highest beam
  int column = 0;          ///< in the order of time
  int part = 0;            ///< which of the stacked sensors
};

enum class PointOrder {
  rings,    ///< ring by ring, each by azimuth
  firings,  ///< column by column, the rows as they fire
  packets   ///< some columns at a time, row by row as they fire
};

[[nodiscard]] const char* name_of(PointOrder order);

/// The returns; a share of the beams with a farther neighbour has a second one, from what is behind
/// the edge or between the leaves, as recordings of two returns a beam list it.
[[nodiscard]] std::vector<ScanPoint> points_of(const CastScan& scan, const SensorUnit& unit,
                                               double echo_share, core::Rng& rng);

/// Stacked sensors stay one after the other.
void put_in_order(PointOrder order, int rows, int packet_columns, core::Rng& rng,
                  std::vector<ScanPoint>& points);

/// Each point by the motion of its column.
void move_points(const PoseOfColumn& T_target_lidar, int columns, std::vector<ScanPoint>& points);

}  // namespace saker::simulation
