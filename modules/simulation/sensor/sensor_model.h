#pragma once

#include <string>
#include <vector>

#include "saker/simulation/sensor/scanner.h"

/// The turning LiDARs that training scans are made with.
///
/// Makes: beams and receiver of one unit of a sensor, as its data sheet or calibration file says,
/// with the errors of calibration of a unit of its own. Units: degrees and metres as named. Frames:
/// lidar, x forward at azimuth 0, z up; azimuth offsets are clockwise from above, as sensors turn.
/// Sources: sensor_tables.cc names the sheet of each.
namespace saker::simulation {

/// Which sensor a scenario wants; `mixed` draws one for each scan. VLP-32Cx2: two in one cloud.
enum class SensorChoice {
  mixed,
  os0_32,
  os0_64,
  os0_128,
  os1_16,
  os1_32,
  os1_64,
  os1_128,
  os2_64,
  os2_128,
  hdl_32e,
  hdl_64e,
  vlp_16,
  vlp_32c,
  vls_128,
  pandar40,
  pandar40p,
  pandar64,
  pandar128,
  xt32,
  qt64,
  vlp_32c_pair
};

[[nodiscard]] inline std::vector<std::string> enum_names(SensorChoice) {
  return {"mixed",     "OS0-32",  "OS0-64",  "OS0-128",  "OS1-16",    "OS1-32",
          "OS1-64",    "OS1-128", "OS2-64",  "OS2-128",  "HDL-32E",   "HDL-64E",
          "VLP-16",    "VLP-32C", "VLS-128", "Pandar40", "Pandar40P", "Pandar64",
          "Pandar128", "XT32",    "QT64",    "VLP-32Cx2"};
}

struct BeamAngle {
  double elevation_deg = 0;
  double azimuth_deg = 0;  ///< by which the beam is ahead, clockwise from above
};

/// What all units of a sensor have in common.
struct SensorModel {
  std::string name;
  std::vector<BeamAngle> beams;  ///< the highest first
  std::vector<int> columns;      ///< of a revolution: one of these
  double rate_hz = 10;           ///< revolutions
  ReceiverConfig receiver;
  double range_step_m = 0.004;     ///< of the ranges that it sends
  double elevation_sd_deg = 0.03;  ///< of a beam, from unit to unit
  double azimuth_sd_deg = 0.03;    ///< the same
  double ouster_origin_m = 0;  ///< of the beams' origin from the axis; > 0: the vendor's formula
  int parts = 1;               ///< sensors of this kind, one above the other, in one cloud
  double weight = 1;           ///< of `mixed`
};

/// The table's entry. `choice` is not `mixed`.
[[nodiscard]] const SensorModel& sensor_model(SensorChoice choice);
[[nodiscard]] const std::vector<SensorModel>& sensor_models();

/// `mixed` drawn by the weights; anything else is returned as it is.
[[nodiscard]] SensorChoice any_sensor(SensorChoice choice, core::Rng& rng);

/// One unit, as it left the factory.
struct SensorUnit {
  std::string name;
  BeamTable beams;
  std::vector<int> part_of_row;  ///< which of the stacked sensors a row belongs to
  ReceiverConfig receiver;
  double range_step_m = 0;
  double period_s = 0.1;  ///< of a revolution
};

[[nodiscard]] SensorUnit make_unit(SensorChoice choice, core::Rng& rng);

}  // namespace saker::simulation
