#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "saker/objects/class_table.h"
#include "saker/segmentation/pieces.h"

namespace saker::segmentation {

/// Objects whose pixels decide together what they are.
enum class PieceFamily { cylinders, vehicles };
inline constexpr std::array kPieceFamilies = {PieceFamily::cylinders, PieceFamily::vehicles};

struct PieceFamilyInfo {
  const char* name;                       ///< of its weights in the network's description
  std::span<const char* const> kinds;     ///< what a piece may be, beside neither
  std::span<const char* const> features;  ///< what tells them apart
};
[[nodiscard]] const PieceFamilyInfo& info_of(PieceFamily family);

/// Index of the class's kind, or −1: neither. Cylinders are crowned (trunks) or bare (poles).
[[nodiscard]] int kind_of(PieceFamily family, const objects::ObjectClass& c);

inline constexpr int kMostPieceFeatures = 11;
using PieceFeatures = Eigen::Matrix<float, Eigen::Dynamic, 1, 0, kMostPieceFeatures, 1>;

/// Probabilities of a piece: ln(P(kind) / P(neither)) = weights(kind) · features.
struct PieceModel {
  std::vector<PieceFeatures> kinds;
};

/// Measures pieces of pixels that are likely the family's; keeps its memory between calls. p is a
/// probability of the network; extents are between percentiles, with half of what a pixel covers.
///
/// Cylinders: one; crowned_to_bare, mean of ln(p of trunks / p of poles); cylinder, mean of
/// ln(p / (1 − p)) of both; width, ln of that across the line of sight, and width_squared, with it
/// a log-normal of widths; height; pixels, ln of their number.
/// Vehicles: one; vehicle, mean of ln(p / (1 − p)); pixels; length, width (horizontal, along
/// principal axes) and height, ln of each and its square; range, ln; length_width, the product of
/// both logarithms. The fit reads the same code (`saker evaluate --pieces`).
class PieceMeter {
 public:
  explicit PieceMeter(PieceFamily family) : family_(family) {}

  /// \param up     unit, lidar frame
  /// \param kinds  classes of each kind
  [[nodiscard]] PieceFeatures measure(const std::vector<std::int32_t>& piece,
                                      const RangeImage& image, const Eigen::Vector3f& up,
                                      std::span<const std::vector<int>> kinds,
                                      const PixelProbabilities& pixels);

 private:
  [[nodiscard]] PieceFeatures of_cylinder(const std::vector<std::int32_t>& piece,
                                          const RangeImage& image, const Eigen::Vector3f& up,
                                          std::span<const std::vector<int>> kinds,
                                          const PixelProbabilities& pixels);
  [[nodiscard]] PieceFeatures of_vehicle(const std::vector<std::int32_t>& piece,
                                         const RangeImage& image, const Eigen::Vector3f& up,
                                         const std::vector<int>& vehicles,
                                         const PixelProbabilities& pixels);
  /// Between the percentile and its counterpart, along a unit direction.
  [[nodiscard]] float extent(const Eigen::Vector3f& direction, float percentile,
                             const std::vector<std::int32_t>& piece, const RangeImage& image);

  PieceFamily family_;
  std::vector<float> scratch_;
};

}  // namespace saker::segmentation
