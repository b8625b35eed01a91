#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "flight/bus/channels.h"
#include "flight/bus/chunk_joiner.h"
#include "saker/occupancy/grid.h"

/// Local occupancy ↔ `_OCCUPANCY`: runs of equal cells (lcmtypes/occupancy_t.lcm), so that a block
/// of 160³ cells, 4 MB, is some 0.1 MB.
namespace saker::flight {

/// The chunks of a block, each decodable alone. Nothing for a block that is no block (size and
/// cells disagree, more than occupancy_t::MAX_CELLS) or does not fit into occupancy_t::MAX_CHUNKS
/// chunks.
[[nodiscard]] std::vector<occupancy_t> to_lcm(const occupancy::OccupancyGrid& grid,
                                              std::int32_t sequence);

/// Chunks → blocks, in the order of time. Never throws; memory for two blocks of runs and one of
/// cells.
class OccupancyJoiner {
 public:
  /// The block, when this chunk was the last one that was missing and all of them make one.
  [[nodiscard]] std::optional<occupancy::OccupancyGrid> add(occupancy_t chunk);

  /// Whether the last chunk was one at all: what a handler of the bus returns.
  [[nodiscard]] bool accepted() const { return accepted_; }
  [[nodiscard]] const ChunkJoiner<occupancy_t>::Counters& counters() const {
    return joiner_.counters();
  }

 private:
  ChunkJoiner<occupancy_t> joiner_;
  bool accepted_ = true;
};

}  // namespace saker::flight
