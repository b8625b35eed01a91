#pragma once

#include <filesystem>

#include "saker/lidar/spinning/spinning_model.h"

namespace saker::lidar {

/// A unit's own angles, as its maker gives them: Velodyne's `db.xml` (degrees and centimetres), the
/// same as YAML (ROS; radians and metres), Hesai's CSV (Channel,Elevation,Azimuth).
/// Throws Error when the file is none of these, or of another number of beams, or when an angle is
/// none.
void read_calibration(const std::filesystem::path& file, SpinningModel& model);

/// The file of a capture that may hold it: NAME.xml, .yaml, .yml or .csv, or db.xml beside it;
/// empty where there is none.
[[nodiscard]] std::filesystem::path find_calibration(const std::filesystem::path& capture);

}  // namespace saker::lidar
