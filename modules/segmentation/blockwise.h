#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>

namespace saker::segmentation {

/// What one instruction takes.
using Block = Eigen::Array<float, 8, 1>;

/// Calls `take(block)` for every eight values, which it may change. Of a longer array Eigen takes
/// the first and the last values one by one, as many as its place in memory says, and their
/// logarithms differ in the last bit: so the same values would not always give the same bytes.
template <class Take>
void for_each_block(float* values, std::size_t count, const Take& take) {
  constexpr std::size_t kBlock = Block::SizeAtCompileTime;
  std::size_t i = 0;
  for (; i + kBlock <= count; i += kBlock) {
    Block block = Eigen::Map<const Block>(values + i);
    take(block);
    Eigen::Map<Block>(values + i) = block;
  }
  if (i == count) return;
  Block rest = Block::Ones();
  std::copy(values + i, values + count, rest.data());
  take(rest);
  std::copy_n(rest.data(), count - i, values + i);
}

}  // namespace saker::segmentation
