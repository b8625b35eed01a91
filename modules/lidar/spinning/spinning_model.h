#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// Spinning LiDARs of Velodyne and Hesai: where their beams look and when they fire.
///
/// Source: the makers' public user manuals (VLP-16, VLP-32C, HDL-32E, HDL-64E S2 and S3; Pandar64,
/// PandarXT-32, PandarQT). The numbers are facts of the hardware; a unit's own are in its
/// calibration file (calibration_file.h), which an HDL-64E cannot do without.
namespace saker::lidar {

enum class SpinningKind { kVlp16, kVlp16HiRes, kVlp32c, kHdl32e, kHdl64e, kPandar64, kXt32, kQt64 };

/// A return's place in a block: which beam, and when after the block's time.
struct SpinningBeam {
  double elevation_deg = 0;  ///< above the sensor's horizontal plane
  double azimuth_deg = 0;    ///< added to the rotor's, clockwise seen from above
  double firing_us = 0;      ///< after its block's time; the rotor turns on meanwhile
  std::uint16_t ring = 0;
  // What an HDL-64E's calibration adds, m.
  double distance_m = 0;    ///< added to the range
  double distance_x_m = 0;  ///< the same at 2.40 m aside, where `two_points`
  double distance_y_m = 0;  ///< the same at 1.93 m ahead
  bool two_points = false;
  double up_m = 0;     ///< of the beam's origin, across the beam
  double aside_m = 0;  ///< of the beam's origin, to the left
};

struct SpinningModel {
  SpinningKind kind = SpinningKind::kVlp16;
  std::string name;                 ///< "VLP-16"
  std::vector<SpinningBeam> beams;  ///< by place in a block, or in a pair of blocks (HDL-64E)
  bool needs_calibration = false;   ///< and has none yet
};

[[nodiscard]] SpinningModel spinning_model(SpinningKind kind);

/// From a block to the next of the same return, µs.
[[nodiscard]] double spinning_block_us(SpinningKind kind);

/// Numbers the beams from the lowest up; beams that fire twice a block keep one number.
void number_rings(std::vector<SpinningBeam>& beams);

}  // namespace saker::lidar
