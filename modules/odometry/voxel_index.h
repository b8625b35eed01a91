#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

namespace saker::odometry {

/// A cell of a grid as one number: 21 bits an axis, so ±1,048,576 cells about the origin.
using VoxelKey = std::uint64_t;

[[nodiscard]] inline VoxelKey voxel_key(const Eigen::Vector3i& cell) {
  constexpr std::uint64_t kMask = (1u << 21) - 1;
  return (static_cast<std::uint64_t>(cell.x()) & kMask) << 42 |
         (static_cast<std::uint64_t>(cell.y()) & kMask) << 21 |
         (static_cast<std::uint64_t>(cell.z()) & kMask);
}

/// Cell of a finite point whose coordinates are within the grid.
[[nodiscard]] inline Eigen::Vector3i voxel_cell(const Eigen::Vector3d& point, double voxels_per_m) {
  return {static_cast<int>(std::floor(point.x() * voxels_per_m)),
          static_cast<int>(std::floor(point.y() * voxels_per_m)),
          static_cast<int>(std::floor(point.z() * voxels_per_m))};
}

/// Hash table from voxel to a number, by linear probing: of a fixed size, so that nothing is
/// allocated after construction, and emptied in constant time (each slot carries the generation in
/// which it was written).
class VoxelIndex {
 public:
  static constexpr std::uint32_t kNone = ~0u;

  explicit VoxelIndex(std::size_t most_voxels);

  void clear();
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t most() const { return most_; }

  /// The number stored for the voxel, kNone when there is none.
  [[nodiscard]] std::uint32_t find(VoxelKey key) const {
    for (std::size_t i = home(key);; i = (i + 1) & mask_) {
      const Slot& slot = slots_[i];
      if (slot.generation != generation_) return kNone;
      if (slot.key == key) return slot.value;
    }
  }

  /// The number of the voxel: the one stored before, or `value`, which is stored now; kNone when
  /// the table is full.
  std::uint32_t find_or_insert(VoxelKey key, std::uint32_t value) {
    std::size_t i = home(key);
    for (; slots_[i].generation == generation_; i = (i + 1) & mask_) {
      if (slots_[i].key == key) return slots_[i].value;
    }
    if (size_ == most_) return kNone;
    slots_[i] = {key, value, generation_};
    ++size_;
    return value;
  }

 private:
  struct Slot {
    VoxelKey key = 0;
    std::uint32_t value = 0;
    std::uint32_t generation = 0;
  };

  /// Fibonacci hashing (Knuth, vol. 3, 6.4) of the block of 2 × 2 × 2 voxels, whose slots lie side
  /// by side: who looks for a voxel looks for its neighbours too.
  [[nodiscard]] std::size_t home(VoxelKey key) const {
    constexpr VoxelKey kOdd = VoxelKey{1} << 42 | VoxelKey{1} << 21 | 1;
    const std::size_t in_block = (key >> 40 & 4) | (key >> 20 & 2) | (key & 1);
    return ((key & ~kOdd) * 0x9E3779B97F4A7C15ull >> (shift_ + 3)) << 3 | in_block;
  }

  std::vector<Slot> slots_;
  std::size_t mask_ = 0;
  std::size_t most_ = 0;
  std::size_t size_ = 0;
  int shift_ = 0;
  std::uint32_t generation_ = 1;
};

}  // namespace saker::odometry
