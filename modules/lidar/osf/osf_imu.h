#pragma once

#include <vector>

#include "saker/lidar/osf/flat_table.h"
#include "saker/lidar/scan.h"
#include "saker/lidar/sensor_info.h"

namespace saker::lidar {

/// The inertial samples that firmware 3.2 and its tools keep in a scan: fields IMU_TIMESTAMP (ns),
/// IMU_STATUS (bit 0: valid), IMU_ACC (g) and IMU_GYRO (degrees a second; both n × 3). In the lidar
/// frame, in their order in the file; none where a field is missing, damaged or of another size.
/// \param scan  the scan's message
[[nodiscard]] std::vector<ImuSample> osf_imu_samples(const FlatTable& scan, const SensorInfo& info);

}  // namespace saker::lidar
