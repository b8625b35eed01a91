#include "saker/occupancy/distance_field.h"

#include <algorithm>

namespace saker::occupancy {
namespace {

// Squared distances in units of half a cell: from a cell's centre to a face they are odd numbers.
using Squared = std::uint16_t;
constexpr double kMostCells = 90;  // (2 · 90)² twice still fits in 16 bits

/// What a cube `cells` away along an axis adds.
int weight(int cells) { return cells == 0 ? 0 : (2 * cells - 1) * (2 * cells - 1); }

void lower(Squared* out, const Squared* in, int add, int count) {
  for (int i = 0; i < count; ++i)
    out[i] = std::min(out[i], static_cast<Squared>(in[i] + static_cast<Squared>(add)));
}

/// The three passes, each over rows of x.
class Transform {
 public:
  Transform(const Eigen::Vector3i& size, int cap)
      : size_(size), cap_(cap), from_(cells()), to_(cells(), static_cast<Squared>(cap)) {
    while (weight(reach_ + 1) < cap_) ++reach_;
  }

  [[nodiscard]] std::vector<Squared>& values() { return from_; }

  void along_x() {
    std::vector<Squared> row(static_cast<std::size_t>(size_.x() + 2 * reach_),
                             static_cast<Squared>(cap_));
    for (int z = 0; z < size_.z(); ++z)
      for (int y = 0; y < size_.y(); ++y) {
        std::copy_n(&from_[at(y, z)], size_.x(), &row[static_cast<std::size_t>(reach_)]);
        for (int k = -reach_; k <= reach_; ++k)
          lower(&to_[at(y, z)], &row[static_cast<std::size_t>(reach_ + k)], weight(std::abs(k)),
                size_.x());
      }
    swap();
  }

  void along_y() {
    for (int z = 0; z < size_.z(); ++z)
      for (int y = 0; y < size_.y(); ++y)
        for (int k = std::max(-reach_, -y); k <= std::min(reach_, size_.y() - 1 - y); ++k)
          lower(&to_[at(y, z)], &from_[at(y + k, z)], weight(std::abs(k)), size_.x());
    swap();
  }

  void along_z() {
    for (int z = 0; z < size_.z(); ++z)
      for (int y = 0; y < size_.y(); ++y)
        for (int k = std::max(-reach_, -z); k <= std::min(reach_, size_.z() - 1 - z); ++k)
          lower(&to_[at(y, z)], &from_[at(y, z + k)], weight(std::abs(k)), size_.x());
    swap();
  }

 private:
  [[nodiscard]] std::size_t cells() const {
    return static_cast<std::size_t>(size_.x()) * size_.y() * size_.z();
  }
  [[nodiscard]] std::size_t at(int y, int z) const {
    return (static_cast<std::size_t>(z) * size_.y() + y) * size_.x();
  }
  void swap() {
    from_.swap(to_);
    std::fill(to_.begin(), to_.end(), static_cast<Squared>(cap_));
  }

  Eigen::Vector3i size_;
  int cap_;
  int reach_ = 0;
  std::vector<Squared> from_, to_;
};

/// What lies beyond the grid's faces is a cube too, next to the outermost cells.
void lower_by_faces(std::vector<Squared>& values, const Eigen::Vector3i& size) {
  const auto face = [](int i, int count) { return weight(std::min({i, count - 1 - i, 90}) + 1); };
  std::size_t at = 0;
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y) {
      const int nearest = std::min(face(z, size.z()), face(y, size.y()));
      for (int x = 0; x < size.x(); ++x, ++at)
        values[at] =
            std::min(values[at], static_cast<Squared>(std::min(nearest, face(x, size.x()))));
    }
}

}  // namespace

DistanceField::DistanceField(const OccupancyGrid& grid, double max_distance_m, UnknownCells unknown)
    : max_distance_m_(std::min(max_distance_m, kMostCells * grid.resolution_m)),
      outside_m_(unknown == UnknownCells::occupied ? 0 : max_distance_m_) {
  geometry_.stamp = grid.stamp;
  geometry_.resolution_m = grid.resolution_m;
  geometry_.origin = grid.origin;
  geometry_.size = grid.size;
  if (grid.cells.empty()) return;

  const double halves = 2 * max_distance_m_ / grid.resolution_m;
  const int cap = static_cast<int>(std::ceil(halves * halves));
  Transform transform(grid.size, cap);
  std::transform(grid.cells.begin(), grid.cells.end(), transform.values().begin(), [&](Cell cell) {
    const bool blocked =
        cell == Cell::occupied || (cell == Cell::unknown && unknown == UnknownCells::occupied);
    return static_cast<Squared>(blocked ? 0 : cap);
  });
  transform.along_x();
  transform.along_y();
  transform.along_z();
  if (unknown == UnknownCells::occupied) lower_by_faces(transform.values(), grid.size);

  std::vector<float> metres(static_cast<std::size_t>(cap) + 1);
  for (std::size_t i = 0; i < metres.size(); ++i)
    metres[i] = static_cast<float>(
        std::min(max_distance_m_, std::sqrt(static_cast<double>(i)) * grid.resolution_m / 2));
  distance_m_.resize(grid.cells.size());
  std::transform(transform.values().begin(), transform.values().end(), distance_m_.begin(),
                 [&](Squared value) { return metres[value]; });
}

double DistanceField::at(const Eigen::Vector3d& p) const {
  if (!p.allFinite() || distance_m_.empty()) return outside_m_;
  const Eigen::Vector3i cell = geometry_.index_of(p);
  if (!geometry_.contains(cell)) return outside_m_;
  const double to_centre = (p - geometry_.centre_of(cell)).norm();
  return std::max(0.0, of_cell(cell) - to_centre);  // a distance grows no faster than one goes
}

}  // namespace saker::occupancy
