#include "fuzz.h"
#include "saker/lidar/imu_packet.h"

namespace saker::lidar {

void fuzz::run(ByteView input) {
  const SensorInfo info = sensor(PacketProfile::kLegacy);
  Frame frame;
  frame.fault = "no scan";
  frame.imu = decode_imu(input, info);
  expect_consistent(frame);
}

}  // namespace saker::lidar
