#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "flight/bus/channels.h"
#include "flight/bus/chunk_joiner.h"
#include "saker/autonomy/plant.h"

/// Registered scans ↔ `_SCAN`: coordinates in the lidar frame quantised to 1 cm and reflectivity to
/// the sensor's byte, 8,500 points a chunk. Cost of a scan of 64×1024: 0.46 MB in eight chunks.
namespace saker::flight {

/// The chunks of a scan, at least one. Points that are not finite or farther than 327 m along an
/// axis are left out, and what is beyond scan_t::MAX_CHUNKS chunks.
[[nodiscard]] std::vector<scan_t> to_lcm(const autonomy::RegisteredScan& scan,
                                         std::int32_t sequence);

/// Chunks → scans, in the order of time. Never throws; memory for two scans.
class ScanJoiner {
 public:
  /// The scan, when this chunk was the last one that was missing.
  [[nodiscard]] std::optional<autonomy::RegisteredScan> add(scan_t chunk);

  /// Whether the last chunk was one at all: what a handler of the bus returns.
  [[nodiscard]] bool accepted() const { return accepted_; }
  [[nodiscard]] const ChunkJoiner<scan_t>::Counters& counters() const { return joiner_.counters(); }

 private:
  ChunkJoiner<scan_t> joiner_;
  bool accepted_ = true;
};

}  // namespace saker::flight
