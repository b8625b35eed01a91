#include "flight/bus/occupancy_messages.h"

#include "flight/bus/fields.h"
#include "flight/bus/messages.h"

namespace saker::flight {
namespace {

using occupancy::Cell;
using occupancy::OccupancyGrid;

// A run's first byte: state, five bits of length − 1, more follow; then seven bits a byte.
constexpr int kStateBits = 2;
constexpr int kFirstBits = 5;
constexpr int kNextBits = 7;
constexpr std::uint8_t kMore = 0x80;
constexpr std::uint8_t kStateMask = (1 << kStateBits) - 1;
constexpr std::uint8_t kFirstMask = (1 << kFirstBits) - 1;
constexpr std::uint8_t kNextMask = (1 << kNextBits) - 1;
constexpr std::size_t kLongestRun = 5;  // bytes: 5 + 4 · 7 bits hold more than MAX_CELLS

void append_run(std::vector<std::uint8_t>& bytes, Cell state, std::size_t length) {
  std::size_t rest = length - 1;
  auto byte = static_cast<std::uint8_t>(static_cast<std::uint8_t>(state) | (rest & kFirstMask)
                                                                               << kStateBits);
  rest >>= kFirstBits;
  while (rest > 0) {
    bytes.push_back(byte | kMore);
    byte = static_cast<std::uint8_t>(rest & kNextMask);
    rest >>= kNextBits;
  }
  bytes.push_back(byte);
}

/// Appends `count` cells; false when the runs are not exactly that.
bool expand(const std::vector<std::uint8_t>& bytes, std::size_t count, std::vector<Cell>& cells) {
  for (std::size_t i = 0; i < bytes.size();) {
    const std::uint8_t state = bytes[i] & kStateMask;
    std::size_t rest = bytes[i] >> kStateBits & kFirstMask;
    const std::size_t begin = i;
    for (int shift = kFirstBits; bytes[i++] & kMore; shift += kNextBits) {
      if (i == bytes.size() || i - begin == kLongestRun) return false;
      rest |= static_cast<std::size_t>(bytes[i] & kNextMask) << shift;
    }
    if (state > static_cast<std::uint8_t>(Cell::occupied) || rest >= count) return false;
    cells.insert(cells.end(), rest + 1, static_cast<Cell>(state));
    count -= rest + 1;
  }
  return count == 0;
}

/// 0 where it is no size of a block.
std::size_t cells_of(const std::int32_t* size) {
  std::int64_t cells = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] < 1 || size[axis] > occupancy_t::MAX_CELLS) return 0;
    cells *= size[axis];
    if (cells > occupancy_t::MAX_CELLS) return 0;
  }
  return static_cast<std::size_t>(cells);
}

occupancy_t empty_chunk(const OccupancyGrid& grid, std::int32_t sequence, std::size_t first_cell) {
  occupancy_t chunk{};
  chunk.utime = to_utime(grid.stamp);
  chunk.sequence = sequence;
  chunk.resolution_m = grid.resolution_m;
  write_field(grid.origin, chunk.origin);
  write_field(grid.size, chunk.size);
  chunk.first_cell = static_cast<std::int32_t>(first_cell);
  return chunk;
}

bool is_whole(const occupancy_t& chunk) {
  const std::size_t cells = cells_of(chunk.size);
  return cells > 0 && chunk.resolution_m > 0 && std::isfinite(chunk.resolution_m) &&
         vector_of(chunk.origin).allFinite() && chunk.first_cell >= 0 && chunk.num_cells >= 0 &&
         static_cast<std::size_t>(chunk.first_cell) + chunk.num_cells <= cells &&
         chunk.runs.size() <= occupancy_t::MAX_BYTES;
}

bool same_block(const occupancy_t& a, const occupancy_t& b) {
  return std::equal(a.size, a.size + 3, b.size) && std::equal(a.origin, a.origin + 3, b.origin) &&
         a.resolution_m == b.resolution_m;
}

std::optional<OccupancyGrid> joined(const std::vector<occupancy_t>& chunks) {
  const occupancy_t& first = chunks.front();
  OccupancyGrid grid{.stamp = from_utime(first.utime),
                     .resolution_m = first.resolution_m,
                     .origin = vector_of(first.origin),
                     .size = {first.size[0], first.size[1], first.size[2]},
                     .cells = {}};
  grid.cells.reserve(cells_of(first.size));
  for (const occupancy_t& chunk : chunks) {
    const bool fits = same_block(first, chunk) &&
                      static_cast<std::size_t>(chunk.first_cell) == grid.cells.size() &&
                      expand(chunk.runs, static_cast<std::size_t>(chunk.num_cells), grid.cells);
    if (!fits) return std::nullopt;
  }
  if (grid.cells.size() != cells_of(first.size)) return std::nullopt;
  return grid;
}

}  // namespace

std::vector<occupancy_t> to_lcm(const OccupancyGrid& grid, std::int32_t sequence) {
  const std::vector<Cell>& cells = grid.cells;
  if (cells.empty() || cells_of(grid.size.data()) != cells.size()) return {};
  std::vector<occupancy_t> chunks = {empty_chunk(grid, sequence, 0)};
  for (std::size_t begin = 0, end = 0; begin < cells.size(); begin = end) {
    while (end < cells.size() && cells[end] == cells[begin]) ++end;
    if (chunks.back().runs.size() + kLongestRun > occupancy_t::MAX_BYTES) {
      if (chunks.size() == occupancy_t::MAX_CHUNKS) return {};
      chunks.push_back(empty_chunk(grid, sequence, begin));
    }
    append_run(chunks.back().runs, cells[begin], end - begin);
    chunks.back().num_cells += static_cast<std::int32_t>(end - begin);
  }
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    chunks[i].chunk = static_cast<std::int16_t>(i);
    chunks[i].num_chunks = static_cast<std::int16_t>(chunks.size());
    chunks[i].num_bytes = static_cast<std::int32_t>(chunks[i].runs.size());
  }
  return chunks;
}

std::optional<OccupancyGrid> OccupancyJoiner::add(occupancy_t chunk) {
  accepted_ = is_whole(chunk);
  if (!accepted_) return std::nullopt;
  const long refused = joiner_.counters().refused;
  const auto chunks = joiner_.add(std::move(chunk));
  accepted_ = joiner_.counters().refused == refused;
  if (!chunks) return std::nullopt;
  auto grid = joined(*chunks);
  accepted_ = grid.has_value();
  return grid;
}

}  // namespace saker::flight
