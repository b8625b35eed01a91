#pragma once

#include <optional>
#include <string>
#include <vector>

#include "saker/core/time.h"
#include "saker/lidar/cursor.h"
#include "saker/lidar/spinning/spinning_model.h"

/// Packets of Velodyne's and Hesai's spinning LiDARs, told by their content: length, flags of the
/// blocks, the maker's bytes. Source: the makers' user manuals.
namespace saker::lidar {

/// All beams once (a VLP-16's twice; half of an HDL-64E's).
struct SpinningBlock {
  double azimuth_deg = 0;     ///< of the rotor at the block's time, clockwise from above, 0 … 360
  double turning_deg_us = 0;  ///< how fast it turns, by the azimuths of the packet's blocks
  double time_us = 0;         ///< after the packet's clock
  std::size_t first_beam = 0;  ///< of `SpinningModel::beams`
  ByteView returns;            ///< range (two bytes), reflectivity and what else there is
  ByteView others;             ///< the second return of each beam, where there are two; or empty
};

struct SpinningPacket {
  SpinningKind kind = SpinningKind::kVlp16;
  Time clock = 0;         ///< of the sensor
  Time clock_period = 0;  ///< it begins anew after that; 0: it counts from 1970
  double range_unit_m = 0;
  std::size_t return_bytes = 3;
  std::vector<SpinningBlock> blocks;
};

/// Nothing for any other bytes, and where blocks contradict one another.
[[nodiscard]] std::optional<SpinningPacket> read_spinning_packet(ByteView bytes);

/// What the packet would be of, where it is Velodyne's or Hesai's and not read: "VLS-128"; empty
/// otherwise.
[[nodiscard]] std::string unread_spinning_packet(ByteView bytes);

}  // namespace saker::lidar
