#include "saker/occupancy/scan_box.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace saker::occupancy {
namespace {

constexpr int kBrick = 8;  // cells: a row of it is one word
constexpr int kLanes = 4;
using Doubles = double __attribute__((vector_size(kLanes * sizeof(double))));
using Longs = std::int64_t __attribute__((vector_size(kLanes * sizeof(std::int64_t))));

Doubles where(Longs mask, Doubles value) {
  return reinterpret_cast<Doubles>(mask & reinterpret_cast<Longs>(value));
}

Doubles lesser(Doubles a, Doubles b) { return a < b ? a : b; }

/// The bits of all bytes of a word.
template <class Word>
std::uint8_t fold(Word word) {
  for (unsigned shift = 4 * sizeof(Word); shift >= 8; shift /= 2)
    word = static_cast<Word>(word | word >> shift);
  return static_cast<std::uint8_t>(word);
}

template <class Word>
Word word_at(const std::uint8_t* first) {
  Word word;
  std::memcpy(&word, first, sizeof(word));
  return word;
}

/// Bits of a cube as wide as a word, in a box of `edge`.
template <class Word>
std::uint8_t fold_cube(const std::uint8_t* first, int edge) {
  Word sum = 0;
  for (std::size_t z = 0; z < sizeof(Word); ++z)
    for (std::size_t y = 0; y < sizeof(Word); ++y)
      sum = static_cast<Word>(sum | word_at<Word>(first + (z * edge + y) * edge));
  return fold(sum);
}

}  // namespace

/// Rays that go through the box together; a lane that is not running marks nothing.
struct ScanBox::Rays {
  int count = 0;
  Longs running = {};
  Longs cell = {}, end = {};
  Longs step[3] = {};
  Doubles wall[3] = {};     // distance along the ray to the next wall across each axis
  Doubles between[3] = {};  // two such walls
  Doubles length = {};
};

ScanBox::ScanBox(double resolution_m, double range_m)
    : resolution_m_(resolution_m),
      range_m_(range_m),
      half_(static_cast<int>(std::ceil(range_m / resolution_m)) + 2),
      edge_((2 * half_ + 1 + 2 * (kBrick - 1)) / kBrick * kBrick) {
  const auto cells = static_cast<std::size_t>(edge_) * edge_ * edge_;
  cells_.resize(cells);
  bricks_.resize(cells / (kBrick * kBrick * kBrick));
}

bool ScanBox::fits(const octomap::OcTree& tree, const octomap::point3d& origin) const {
  octomap::OcTreeKey key;
  if (!tree.coordToKeyChecked(origin, key)) return false;
  constexpr int kKeys = 1 << 16;
  for (unsigned i = 0; i < 3; ++i)
    if (key[i] < edge_ || key[i] >= kKeys - edge_) return false;
  return true;
}

void ScanBox::collect(const octomap::OcTree& tree, const octomap::point3d& origin,
                      std::span<const Beam> beams) {
  begin(tree, origin);
  Rays rays;
  for (const auto& [end, from_m] : beams) {
    if ((end - origin).norm() <= range_m_) {
      hits_.push_back(index_of(tree.coordToKey(end)));
      aim(tree, origin_, end, rays);
    } else if (from_m < range_m_) {
      const octomap::point3d direction = (end - origin).normalized();
      const octomap::point3d last = origin + direction * static_cast<float>(range_m_);
      aim(tree, from_m > 0 ? start_at(tree, origin + direction * from_m) : origin_, last, rays);
    }
    if (rays.count == kLanes) march(rays);
  }
  march(rays);
  cells_[0] = kUnseen;  // where lanes that are done leave their marks: no ray gets to the corner
  for (const int hit : hits_) cells_[static_cast<std::size_t>(hit)] = kOccupied;
  summarise();
}

void ScanBox::begin(const octomap::OcTree& tree, const octomap::point3d& origin) {
  origin_ = start_at(tree, origin);
  for (unsigned i = 0; i < 3; ++i)
    corner_[i] = static_cast<octomap::key_type>((origin_.key[i] - half_) / kBrick * kBrick);
  hits_.clear();
  std::fill(cells_.begin(), cells_.end(), kUnseen);
}

ScanBox::Start ScanBox::start_at(const octomap::OcTree& tree, const octomap::point3d& point) const {
  Start start{point, tree.coordToKey(point)};
  for (unsigned i = 0; i < 3; ++i) {
    const double centre = tree.keyToCoord(start.key[i]);
    start.wall[i][0] = centre + static_cast<float>(-resolution_m_ * 0.5);
    start.wall[i][1] = centre + static_cast<float>(resolution_m_ * 0.5);
  }
  return start;
}

int ScanBox::index_of(const octomap::OcTreeKey& key) const {
  return ((key[2] - corner_[2]) * edge_ + key[1] - corner_[1]) * edge_ + key[0] - corner_[0];
}

/// As OctoMap's computeRayKeys begins, floats and doubles where it has them.
void ScanBox::aim(const octomap::OcTree& tree, const Start& start, const octomap::point3d& end,
                  Rays& rays) {
  const octomap::OcTreeKey end_key = tree.coordToKey(end);
  if (end_key == start.key) return;
  octomap::point3d direction = end - start.point;
  const auto length = static_cast<float>(direction.norm());
  direction /= length;

  const int lane = rays.count++;
  rays.running[lane] = -1;
  rays.cell[lane] = index_of(start.key);
  rays.end[lane] = index_of(end_key);
  rays.length[lane] = length;
  const int strides[3] = {1, edge_, edge_ * edge_};
  for (unsigned i = 0; i < 3; ++i) {
    const int sign = direction(i) > 0 ? 1 : direction(i) < 0 ? -1 : 0;
    rays.step[i][lane] = sign * strides[i];
    constexpr double kNever = std::numeric_limits<double>::max();
    rays.wall[i][lane] =
        sign == 0 ? kNever
                  : (start.wall[i][sign > 0] - static_cast<double>(start.point(i))) / direction(i);
    rays.between[i][lane] =
        sign == 0 ? kNever : resolution_m_ / std::fabs(static_cast<double>(direction(i)));
  }
}

/// Steps across the nearest wall (of equal ones z before y before x, as OctoMap) until the end.
void ScanBox::march(Rays& rays) {
  std::uint8_t* const cells = cells_.data();
  Doubles x = rays.wall[0], y = rays.wall[1], z = rays.wall[2];
  Longs cell = rays.cell, running = rays.running;
  for (Longs marked = running & cell; (marked[0] | marked[1] | marked[2] | marked[3]) != 0;
       marked = running & cell) {
    for (int lane = 0; lane < kLanes; ++lane) cells[marked[lane]] = kFree;
    const Longs over_x = (x < y) & (x < z);
    const Longs over_y = ~(x < y) & (y < z);
    const Longs over_z = ~(over_x | over_y);
    cell += (over_x & rays.step[0]) | (over_y & rays.step[1]) | (over_z & rays.step[2]);
    x += where(over_x, rays.between[0]);
    y += where(over_y, rays.between[1]);
    z += where(over_z, rays.between[2]);
    running &= (cell != rays.end) & (lesser(lesser(x, y), z) <= rays.length);
  }
  rays.running = Longs{};
  rays.count = 0;
}

void ScanBox::summarise() {
  const int bricks = edge_ / kBrick;
  std::fill(bricks_.begin(), bricks_.end(), kUnseen);
  const std::uint8_t* row = cells_.data();
  for (int z = 0; z < edge_; ++z)
    for (int y = 0; y < edge_; ++y) {
      std::uint8_t* brick =
          &bricks_[(static_cast<std::size_t>(z / kBrick) * bricks + y / kBrick) * bricks];
      for (int b = 0; b < bricks; ++b, row += kBrick)
        brick[b] = static_cast<std::uint8_t>(brick[b] | fold(word_at<std::uint64_t>(row)));
    }
}

std::uint8_t ScanBox::seen(const KeyCube& cube) const {
  const int x = cube.x - corner_[0], y = cube.y - corner_[1], z = cube.z - corner_[2];
  if (cube.edge < kBrick) {
    const auto outside = [this](int i) { return i < 0 || i >= edge_; };
    if (outside(x) || outside(y) || outside(z)) return kUnseen;
    const std::uint8_t* first = &cells_[(static_cast<std::size_t>(z) * edge_ + y) * edge_ + x];
    if (cube.edge == 1) return *first;
    return cube.edge == 2 ? fold_cube<std::uint16_t>(first, edge_)
                          : fold_cube<std::uint32_t>(first, edge_);
  }
  const int bricks = edge_ / kBrick;
  const auto low = [](int i) { return std::max(i, 0) / kBrick; };
  const auto high = [&](int i) { return std::min(i + cube.edge, edge_) / kBrick; };
  std::uint8_t sum = kUnseen;
  for (int bz = low(z); bz < high(z); ++bz)
    for (int by = low(y); by < high(y); ++by)
      for (int bx = low(x); bx < high(x); ++bx)
        sum = static_cast<std::uint8_t>(
            sum | bricks_[(static_cast<std::size_t>(bz) * bricks + by) * bricks + bx]);
  return sum;
}

}  // namespace saker::occupancy
