#include "fuzz.h"
#include "saker/lidar/ouster_stream.h"

namespace saker::lidar {

/// The first byte chooses the profile; packets and inertial packets follow one another.
void fuzz::run(ByteView input) {
  Cursor cursor(input);
  const auto& profiles = packet_profiles();
  OusterStream stream(sensor(profiles[cursor.number<std::uint8_t>() % profiles.size()]), true);
  while (cursor.left() > 0) {
    const bool imu = cursor.number<std::uint8_t>() % 4 == 0;
    stream.add(cursor.take_at_most(imu ? 48 : stream.packet_bytes()));
  }
  stream.finish();
  while (const auto item = stream.take()) expect_consistent(item->frame);
}

}  // namespace saker::lidar
