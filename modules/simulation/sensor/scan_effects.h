#pragma once

#include <vector>

#include "saker/simulation/sensor/mount.h"
#include "saker/simulation/sensor/scan_points.h"

/// What happens to a revolution between the surfaces and the file.
///
/// Reads and changes a cast scan. Frames: lidar at each column's time; puffs are in the world.
/// Effects that are zero or empty draw no number: without any, the scan is left as it was cast.
namespace saker::simulation {

/// A cloud of drops or dust.
struct Puff {
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  float radius_m = 1;
  float density_per_m = 0.1F;  ///< chance of a return for each metre within
};

/// A window of azimuth that something hides; `first_row` and below.
struct BlockedSector {
  double azimuth = 0;  ///< of its middle
  double half_width = 0;
  double first_row = 0;  ///< as a share of the rows
};

struct ScanEffects {
  // Weather.
  double near_share = 0;    ///< of the beams that a drop, a flake or fog near the sensor answers
  double near_range_m = 3;  ///< mean range of those
  double extinction_per_m = 0;  ///< of the light, one way
  std::vector<Puff> puffs;
  // The sensor and where it is.
  double crosstalk_share = 0;  ///< of the beams that answer from anywhere
  double ghost_share = 0;      ///< of the mirrored beams that answer from behind the mirror
  double echo_share = 0;  ///< of the beams at an edge or in leaves with a second return in the file
  double range_step_m = 0;
  double range_cut_m = 0;  ///< what is farther is not in the file
  int lost_packets = 0;
  int packet_columns = 12;
  std::vector<BlockedSector> blocked;
  double own_return_share = 0;  ///< of the carrier's returns that are in the file
};

/// Weather of a world's scan: a function of the world's stream, the same for each sensor.
[[nodiscard]] ScanEffects any_weather(const Mount& mount, core::Rng& rng);
/// What the unit and its driver add to it.
void add_sensor_effects(const SensorUnit& unit, ScanEffects& effects, core::Rng& rng);

/// Ground that is wet: darker, glossy. `world` was dry.
void wet_ground(World& world, double wetness);

/// What the effects need to know of the scan.
struct ScanSetting {
  const RayCaster* caster = nullptr;
  const World* world = nullptr;
  const SensorUnit* unit = nullptr;
  const Mount* mount = nullptr;
  PoseOfColumn T_world_lidar;
};

void apply_effects(const ScanEffects& effects, const ScanSetting& setting, core::Rng& rng,
                   CastScan& scan);

}  // namespace saker::simulation
