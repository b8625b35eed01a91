#pragma once

#include <array>
#include <span>
#include <vector>

#include "saker/detection/face_fitter.h"
#include "saker/detection/size_prior.h"

/// Parts of face_fitter.h: one face's density on a grid, and two of them with a size's prior.
namespace saker::detection {

inline constexpr double kCell = 0.03;  // m, of all grids

/// The outermost layer of a strip across a face.
struct Strip {
  double across = 0;   ///< m, middle of the strip, along the other axis
  double outward = 0;  ///< m, along the face's outward normal
};

/// Of two opposite faces.
struct FaceStrips {
  std::vector<Strip> low, high;
  double low_reach = 0, high_reach = 0;  ///< m along the axis, where most strips reach to
};

/// \param places along the plan's axes
/// \param axis   0: strips of the ends, 1: of the sides
[[nodiscard]] FaceStrips strips_along(const Places& places, int axis, const FaceConfig& config);

/// How well strips lie on one line, wherever that is, log-likelihood.
[[nodiscard]] double log_flat(const std::vector<Strip>& strips, const FaceConfig& config);

/// Unnormalised probability of where a face lies, a cell each.
struct FaceDensity {
  double first = 0;                 ///< m, outward place of the first cell
  std::vector<double> probability;  ///< the largest is 1
  double log_scale = 0;             ///< log of what they are to be multiplied with
};

struct FaceView {
  std::vector<Strip> strips;
  double hits = 0;        ///< m, outward place beyond which it lies
  double middle = 0;      ///< m, of the face, along the other axis
  double half_width = 0;  ///< m
  bool end = false;       ///< of the vehicle; else a side
  double seen = 0;        ///< probability that the hits show the face
  double corner = 0;      ///< probability, below 1, that hits beside it, else, end at its corner
  double alone = 1;       ///< share of the points about it that are the vehicle's
  double range = 0;       ///< m
};

/// Place beyond which the second outermost strip shows that the face lies, m.
[[nodiscard]] double outermost(const std::vector<Strip>& strips);

/// \param free_m  outward place where beams come nearest; infinite where none does
[[nodiscard]] FaceDensity face_density(const FaceView& view, double free_m,
                                       const FaceConfig& config);

/// Two opposite faces without a prior of their distance: sums over cells of equal size.
class SizeDensity {
 public:
  SizeDensity(const FaceDensity& low, const FaceDensity& high);

  /// Of [low, high] as outward places, with the prior of their sum.
  struct Moments {
    double log_evidence = 0;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();  ///< E[x xᵀ]
  };
  [[nodiscard]] Moments with(const Normal& prior) const;

 private:
  double first_size_;
  double log_scale_;
  std::vector<std::array<double, 3>> sums_;  ///< of p, p·low, p·low² over cells of that size
};

/// ln of the sum of what these are the logarithms of.
[[nodiscard]] double log_sum(double a, double b);
[[nodiscard]] double log_sum(std::span<const double> values);

}  // namespace saker::detection
