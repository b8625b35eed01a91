#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "saker/multirobot/constellation.h"

/// How well two maps agree once one is laid over the other.
namespace saker::multirobot {

/// An object as constellations see it.
struct Star {
  int id = -1;
  objects::ClassId class_id = 0;
  bool cuboid = false;
  Eigen::Vector3d place = Eigen::Vector3d::Constant(NAN);
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< of a cylinder: radius, 0, 0
  double heading = 0;                              ///< of a cuboid, modulo π
  double sd = NAN;                                 ///< of its place along one axis, m
};

[[nodiscard]] std::vector<Star> stars(const objects::ObjectMap& map,
                                      const ConstellationConfig& config);

/// Angle modulo π, in [−π/2, π/2].
[[nodiscard]] double half_turn(double angle);

/// Indices into a and b.
struct Match {
  int a = -1, b = -1;
};

/// Squared error over variance of what a match says apart from its place in x-y: sizes, and, laid
/// over each other by a turn of `yaw`, headings. `height` is that of b over a.
[[nodiscard]] double unlikeness(const Star& a, const Star& b, double yaw, double height,
                                const ConstellationConfig& config);

/// Yaw and translation that lay the matched places of b on those of a, with its covariance.
[[nodiscard]] slam::PosePrior fit(const std::vector<Star>& a, const std::vector<Star>& b,
                                  const std::vector<Match>& matches,
                                  const ConstellationConfig& config);

/// Two sky maps and what can be said about laying b over a.
class Comparison {
 public:
  Comparison(const Survey& a, const Survey& b, const ConstellationConfig& config);

  [[nodiscard]] const std::vector<Star>& a() const { return a_; }
  [[nodiscard]] const std::vector<Star>& b() const { return b_; }

  struct Hypothesis {
    slam::PosePrior T_a_b;
    std::vector<Match> matches;
    double log_likelihood_ratio = 0;
    double log_odds = 0;  ///< against two unrelated maps
  };
  /// The alignment that explains most near the one that `seed` gives.
  [[nodiscard]] Hypothesis grown(const std::vector<Match>& seed,
                                 const std::optional<AlignmentBounds>& bounds) const;

 private:
  [[nodiscard]] std::vector<Match> matches(const SE3& T_a_b, double* gain) const;
  [[nodiscard]] double match_gain(const Star& a, const Star& b_in_a, double commonness) const;
  [[nodiscard]] double commonness(const Star& b, const Star& b_in_a) const;
  [[nodiscard]] double missing(const SE3& T_a_b, const std::vector<Match>& matches) const;
  [[nodiscard]] double log_prior_volume(const std::optional<AlignmentBounds>& bounds) const;

  ConstellationConfig config_;
  std::vector<Star> a_, b_;
  std::vector<Eigen::Vector3d> path_a_, path_b_;
};

}  // namespace saker::multirobot
