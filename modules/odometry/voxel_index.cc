#include "saker/odometry/voxel_index.h"

#include <bit>

namespace saker::odometry {

// At most half full, so that a probe ends after a slot or two.
VoxelIndex::VoxelIndex(std::size_t most_voxels)
    : slots_(std::bit_ceil(2 * most_voxels + 2)),
      mask_(slots_.size() - 1),
      most_(most_voxels),
      shift_(64 - std::countr_zero(slots_.size())) {}

void VoxelIndex::clear() {
  size_ = 0;
  if (++generation_ != 0) return;
  for (Slot& slot : slots_) slot.generation = 0;  // once in 2³² scans
  generation_ = 1;
}

}  // namespace saker::odometry
