#include "flight/bus/occupancy_messages.h"
#include "flight/bus/scan_messages.h"
#include "fuzz.h"
#include "lcm_bytes.h"

/// What comes in chunks, scans and occupancy: of each chunk a byte that says which it is of, two of
/// its length, and the message.
namespace saker {

void lidar::fuzz::run(ByteView input) {
  flight::ScanJoiner scans;
  flight::OccupancyJoiner grids;
  Cursor cursor(input);
  while (cursor.left() > 0) {
    const bool scan = cursor.number<std::uint8_t>() % 2 == 0;
    const ByteView body = cursor.take_at_most(cursor.number<std::uint16_t>());
    if (scan) {
      const auto chunk = decoded<scan_t>(body);
      const auto whole = chunk ? scans.add(*chunk) : std::nullopt;
      if (whole) {
        for (const Eigen::Vector3f& point : *whole->points) expect(point.allFinite());
      }
    } else {
      const auto chunk = decoded<occupancy_t>(body);
      const auto whole = chunk ? grids.add(*chunk) : std::nullopt;
      if (whole) expect(!flight::to_lcm(*whole, 0).empty());
    }
  }
}

}  // namespace saker
