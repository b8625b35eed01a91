#include "saker/segmentation/piece_features.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace saker::segmentation {
namespace {

constexpr std::array kCylinderKinds = {"crowned", "bare"};
constexpr std::array kVehicleKinds = {"vehicle"};
constexpr std::array kCylinderFeatures = {"one",           "crowned_to_bare", "cylinder", "width",
                                          "width_squared", "height",          "pixels"};
constexpr std::array kVehicleFeatures = {
    "one",           "vehicle", "pixels",         "length", "length_squared", "width",
    "width_squared", "height",  "height_squared", "range",  "length_width"};
static_assert(kVehicleFeatures.size() == kMostPieceFeatures);

constexpr float kLeastProbability = 1e-3F;  // of single pixels: nothing is surer
constexpr float kSurest = 0.998F;  // of a vehicle's pixels: near ones are surer, whatever it is
constexpr float kThin = 0.1F;      // m, added to extents of vehicles: a wall has some

/// Linear between the order statistics; reorders the values.
float value_at(std::vector<float>& values, float percentile) {
  const float place = percentile * static_cast<float>(values.size() - 1);
  const auto low = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), low, values.end());
  const float next = low + 1 == values.end() ? *low : *std::min_element(low + 1, values.end());
  return *low + (place - std::floor(place)) * (next - *low);
}

float log_ratio(float a, float b) {
  return std::log(std::max(a, kLeastProbability) / std::max(b, kLeastProbability));
}

Eigen::Vector3f mean_of(const std::vector<std::int32_t>& piece, const RangeImage& image) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const std::int32_t i : piece) sum += image.points[i];
  return sum / static_cast<float>(piece.size());
}

float half_pixel(float distance, const RangeImage& image) {
  return std::max(distance, lidar::kMinRange) * std::numbers::pi_v<float> /
         static_cast<float>(image.columns);
}

/// Horizontal, of the largest spread.
Eigen::Vector3f long_axis(const std::vector<std::int32_t>& piece, const RangeImage& image,
                          const Eigen::Vector3f& up, const Eigen::Vector3f& mean) {
  const Eigen::Vector3f first = up.unitOrthogonal(), second = up.cross(first);
  Eigen::Matrix2f spread = Eigen::Matrix2f::Zero();
  for (const std::int32_t i : piece) {
    const Eigen::Vector3f from = image.points[i] - mean;
    const Eigen::Vector2f flat(first.dot(from), second.dot(from));
    spread += flat * flat.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2f> solver;
  solver.computeDirect(spread);
  const Eigen::Vector2f axis = solver.eigenvectors().col(1);
  return axis.x() * first + axis.y() * second;
}

}  // namespace

const PieceFamilyInfo& info_of(PieceFamily family) {
  static constexpr PieceFamilyInfo kCylinders{"cylinders", kCylinderKinds, kCylinderFeatures};
  static constexpr PieceFamilyInfo kVehicles{"vehicles", kVehicleKinds, kVehicleFeatures};
  return family == PieceFamily::cylinders ? kCylinders : kVehicles;
}

int kind_of(PieceFamily family, const objects::ObjectClass& c) {
  if (family == PieceFamily::vehicles) return c.shape == objects::Shape::cuboid ? 0 : -1;
  if (c.shape != objects::Shape::cylinder) return -1;
  return c.crowned ? 0 : 1;
}

float PieceMeter::extent(const Eigen::Vector3f& direction, float percentile,
                         const std::vector<std::int32_t>& piece, const RangeImage& image) {
  scratch_.clear();
  for (const std::int32_t i : piece) scratch_.push_back(direction.dot(image.points[i]));
  const float low = value_at(scratch_, percentile);
  return value_at(scratch_, 1 - percentile) - low;
}

PieceFeatures PieceMeter::measure(const std::vector<std::int32_t>& piece, const RangeImage& image,
                                  const Eigen::Vector3f& up,
                                  std::span<const std::vector<int>> kinds,
                                  const PixelProbabilities& pixels) {
  return family_ == PieceFamily::cylinders ? of_cylinder(piece, image, up, kinds, pixels)
                                           : of_vehicle(piece, image, up, kinds[0], pixels);
}

PieceFeatures PieceMeter::of_cylinder(const std::vector<std::int32_t>& piece,
                                      const RangeImage& image, const Eigen::Vector3f& up,
                                      std::span<const std::vector<int>> kinds,
                                      const PixelProbabilities& pixels) {
  float crowned_to_bare = 0, cylinder = 0;
  for (const std::int32_t i : piece) {
    const float* pixel = pixels.at(static_cast<std::size_t>(i));
    const float with_crown = sum_of(kinds[0], pixel), without = sum_of(kinds[1], pixel);
    crowned_to_bare += log_ratio(with_crown, without);
    cylinder += log_ratio(with_crown + without, 1 - with_crown - without);
  }
  const auto count = static_cast<float>(piece.size());
  const Eigen::Vector3f across = up.cross(mean_of(piece, image));
  const float half = half_pixel(across.norm(), image);
  const float width = std::log(extent(across.normalized(), 0.1F, piece, image) + half);
  const float height = std::log(height_of(piece, image, up) + half);
  PieceFeatures features(static_cast<Eigen::Index>(kCylinderFeatures.size()));
  features << 1, crowned_to_bare / count, cylinder / count, width, width * width, height,
      std::log(count);
  return features;
}

PieceFeatures PieceMeter::of_vehicle(const std::vector<std::int32_t>& piece,
                                     const RangeImage& image, const Eigen::Vector3f& up,
                                     const std::vector<int>& vehicles,
                                     const PixelProbabilities& pixels) {
  constexpr float kPercentile = 0.05F;  // antennas, and what was taken for a vehicle beside one
  float vehicle = 0;
  for (const std::int32_t i : piece) {
    const float p = std::min(sum_of(vehicles, pixels.at(static_cast<std::size_t>(i))), kSurest);
    vehicle += log_ratio(p, 1 - p);
  }
  const auto count = static_cast<float>(piece.size());
  const Eigen::Vector3f mean = mean_of(piece, image);
  const Eigen::Vector3f along = long_axis(piece, image, up, mean);
  const float added = half_pixel(mean.norm(), image) + kThin;
  const auto log_extent = [&](const Eigen::Vector3f& direction) {
    return std::log(extent(direction, kPercentile, piece, image) + added);
  };
  const float length = log_extent(along), width = log_extent(up.cross(along));
  const float height = log_extent(up);
  PieceFeatures features(static_cast<Eigen::Index>(kVehicleFeatures.size()));
  features << 1, vehicle / count, std::log(count), length, length * length, width, width * width,
      height, height * height, std::log(std::max(mean.norm(), lidar::kMinRange)), length * width;
  return features;
}

}  // namespace saker::segmentation
