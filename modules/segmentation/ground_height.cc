#include "saker/segmentation/ground_height.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace saker::segmentation {
namespace {

constexpr float kCell = 1.5F;    // m
constexpr int kCells = 128;      // a side; beyond 96 m the border's cell answers
constexpr float kSlope = 0.25F;  // of the ground, at most
constexpr float kBelow = 1.0F;   // m below the usual level, and …
constexpr float kFall = 0.08F;   // … this share of the distance: lower points are reflections
constexpr float kPit = 0.4F;     // m that a cell's lowest point is under those around it
constexpr int kFew = 12;         // one stray point among so many is dropped
constexpr float kFar = 1e6F;     // height of a cell without points
constexpr int kEnoughNormals = 100;
constexpr std::array<float, 3> kConeCosine = {0.5F, 0.866F, 0.966F};  // 60°, 30°, 15°

float median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

int cell_of(float v) {
  return std::clamp(static_cast<int>(std::floor(v / kCell)) + kCells / 2, 0, kCells - 1);
}

/// Whether two pixels are close enough to lie on one surface; rows are far apart on the ground.
bool joined(float range_a, float range_b, float share) {
  return range_a > 0 && range_b > 0 && std::abs(range_a - range_b) < 0.3F + share * range_a;
}

/// What is the farthest on pixel i's surface of the pixels at `steps`, half of it … 1 times `by`
/// from it; i where none is.
template <class At>
std::size_t on_surface(const RangeImage& image, std::size_t i, int steps, float share, At&& at) {
  for (; steps > 0; steps /= 2) {
    const std::size_t other = at(steps);
    if (joined(image.range[i], image.range[other], share)) return other;
  }
  return i;
}

}  // namespace

void GroundHeight::find_normals(const RangeImage& image, const BeamSpacing& spacing) {
  normals_.assign(image.size(), Eigen::Vector3f::Zero());
  const int width = image.columns;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!image.valid(i)) continue;
    const int row = static_cast<int>(i) / width, column = static_cast<int>(i) % width;
    const int side = spacing.columns(image.range[i], kBaseline) % width;
    const auto in_row = [&](int d) {
      return static_cast<std::size_t>(row * width + (column + d + width) % width);
    };
    const auto in_column = [&](int d) {
      return static_cast<std::size_t>((row + d) * width + column);
    };
    const auto left = on_surface(image, i, side, 0.05F, [&](int d) { return in_row(-d); });
    const auto right = on_surface(image, i, side, 0.05F, in_row);
    if (left == right) continue;
    const int up = row - spacing.row_above(row, image.range[i], kBaseline);
    const int down = spacing.row_below(row, image.range[i], kBaseline) - row;
    const auto above = on_surface(image, i, up, 0.3F, [&](int d) { return in_column(-d); });
    const auto below = on_surface(image, i, down, 0.3F, in_column);
    if (above == below) continue;
    const Eigen::Vector3f normal =
        (image.points[right] - image.points[left]).cross(image.points[below] - image.points[above]);
    const float length = normal.norm();
    if (!(length > 1e-6F)) continue;
    const float facing = normal.dot(image.points[i]) > 0 ? -1.0F : 1.0F;
    normals_[i] = normal * (facing / length);
  }
}

void GroundHeight::find_up() {
  up_ = mounted_up_;
  for (const float cosine : kConeCosine) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    int count = 0;
    for (const Eigen::Vector3f& normal : normals_) {
      if (normal.dot(up_) < cosine) continue;
      sum += normal;
      ++count;
    }
    if (count < kEnoughNormals) return;
    up_ = sum.normalized();
  }
}

void GroundHeight::level(const RangeImage& image) {
  const Eigen::Matrix3f turn =
      Eigen::Quaternionf::FromTwoVectors(up_, Eigen::Vector3f::UnitZ()).toRotationMatrix();
  level_.assign(image.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (image.valid(i)) level_[i] = turn * image.points[i];
  }
}

/// Median height of the surfaces that look up; most of them are ground.
float GroundHeight::usual_level() {
  scratch_.clear();
  for (std::size_t i = 0; i < normals_.size(); ++i) {
    if (normals_[i].dot(up_) > kConeCosine.back()) scratch_.push_back(level_[i].z());
  }
  return scratch_.empty() ? -kFar : median(scratch_);
}

void GroundHeight::sort_into_cells(const RangeImage& image) {
  const float usual = usual_level();
  const std::size_t columns = image.columns;
  cell_.assign(image.size(), -1);
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!image.valid(i)) continue;
    if (level_[i].z() < usual - kBelow - kFall * level_[i].head<2>().norm()) continue;
    const std::size_t next = i % columns + 1 < columns ? i + 1 : i + 1 - columns;
    if (!joined(image.range[i], image.range[next], 0.03F)) continue;
    cell_[i] = cell_of(level_[i].y()) * kCells + cell_of(level_[i].x());
  }
}

void GroundHeight::find_lowest() {
  lowest_.assign(static_cast<std::size_t>(kCells) * kCells, kFar);
  for (std::size_t i = 0; i < cell_.size(); ++i) {
    if (cell_[i] >= 0) lowest_[cell_[i]] = std::min(lowest_[cell_[i]], level_[i].z());
  }
}

/// Whether the cell's lowest point lies under the lowest points of most cells around it.
bool GroundHeight::is_pit(int cell) {
  if (lowest_[cell] >= kFar) return false;
  const int row = cell / kCells, column = cell % kCells;
  scratch_.clear();
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, kCells - 1); ++r) {
    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, kCells - 1); ++c) {
      const int other = r * kCells + c;
      if (other != cell && lowest_[other] < kFar) scratch_.push_back(lowest_[other]);
    }
  }
  return scratch_.size() >= 3 && lowest_[cell] < median(scratch_) - kPit;
}

/// Takes the few lowest points out of cells that are pits because of them: mirrored by a car's
/// side.
void GroundHeight::drop_strays() {
  pit_.assign(lowest_.size(), false);
  for (std::size_t k = 0; k < lowest_.size(); ++k) pit_[k] = is_pit(static_cast<int>(k));
  auto in_pit = [this](std::size_t i) { return cell_[i] >= 0 && pit_[cell_[i]]; };
  auto low = [this](std::size_t i) { return level_[i].z() < lowest_[cell_[i]] + kPit; };
  strays_.assign(lowest_.size(), 0);  // positive: the low ones are few
  for (std::size_t i = 0; i < cell_.size(); ++i) {
    if (in_pit(i)) strays_[cell_[i]] += low(i) ? -kFew : 1;
  }
  for (std::size_t i = 0; i < cell_.size(); ++i) {
    if (in_pit(i) && strays_[cell_[i]] > 0 && low(i)) cell_[i] = -1;
  }
}

void GroundHeight::limit_slope() {
  constexpr float kStep = kSlope * kCell, kDiagonal = kStep * 1.41421F;
  auto at = [this](int row, int column) -> float& {
    return lowest_[static_cast<std::size_t>(row) * kCells + column];
  };
  auto lower = [&](int row, int column, int d_row, int d_column, float step) {
    const int r = row + d_row, c = column + d_column;
    if (r < 0 || c < 0 || r >= kCells || c >= kCells) return;
    at(row, column) = std::min(at(row, column), at(r, c) + step);
  };
  auto sweep = [&](int row, int column, int way) {
    lower(row, column, 0, -way, kStep);
    lower(row, column, -way, -1, kDiagonal);
    lower(row, column, -way, 0, kStep);
    lower(row, column, -way, 1, kDiagonal);
  };
  for (int row = 0; row < kCells; ++row) {
    for (int column = 0; column < kCells; ++column) sweep(row, column, 1);
  }
  for (int row = kCells - 1; row >= 0; --row) {
    for (int column = kCells - 1; column >= 0; --column) sweep(row, column, -1);
  }
}

/// Between the centres of four cells.
float GroundHeight::ground_at(float x, float y) const {
  const float half = kCells / 2.0F - 0.5F;
  const float u = std::clamp(x / kCell + half, 0.0F, kCells - 1.001F);
  const float v = std::clamp(y / kCell + half, 0.0F, kCells - 1.001F);
  const int column = static_cast<int>(u), row = static_cast<int>(v);
  const float fu = u - static_cast<float>(column), fv = v - static_cast<float>(row);
  const float* corner = &lowest_[static_cast<std::size_t>(row) * kCells + column];
  return (1 - fv) * ((1 - fu) * corner[0] + fu * corner[1]) +
         fv * ((1 - fu) * corner[kCells] + fu * corner[kCells + 1]);
}

void GroundHeight::estimate(const RangeImage& image, const BeamSpacing& spacing) {
  find_normals(image, spacing);
  find_up();
  level(image);
  sort_into_cells(image);
  find_lowest();
  drop_strays();
  find_lowest();
  limit_slope();
  height_.assign(image.size(), 0.0F);
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (!image.valid(i)) continue;
    height_[i] = level_[i].z() - ground_at(level_[i].x(), level_[i].y());
    if (std::abs(height_[i]) > 1e3F) height_[i] = 0;  // no ground was seen at all
  }
}

}  // namespace saker::segmentation
